// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/output/monitors.h>

#include <algorithm>
#include <iomanip>
#include <sstream>

namespace Keyblock
{
  namespace
  {
    std::string
    without_unit(const std::string &column)
    {
      return column.substr(0, column.find(" ["));
    }
  } // namespace



  bool
  History::has(const std::string &name) const
  {
    return std::any_of(columns.begin(), columns.end(), [&](const auto &column) {
      return without_unit(column) == name;
    });
  }



  std::vector<double>
  History::column(const std::string &name, const unsigned int begin) const
  {
    unsigned int index = 0;
    while (index < columns.size() && without_unit(columns[index]) != name)
      ++index;
    Assert(index < columns.size(), dealii::ExcMessage("no column " + name));
    std::vector<double> values;
    for (unsigned int r = begin; r < rows.size(); ++r)
      values.push_back(rows[r][index]);
    return values;
  }



  double
  History::last(const std::string &name) const
  {
    return column(name, rows.size() - 1)[0];
  }



  template <int dim>
  Monitors<dim>::Monitors(const Scene<dim> &scene,
                          const SplitMesh<dim> &split,
                          const Blocks<dim> &blocks,
                          const Numbering<dim> &numbering,
                          const CellArrays<dim> &cells,
                          const Fields<dim> &fields,
                          const Contact<dim> *contact)
    : baseline(fields.displacement)
    , scene(scene)
    , split(split)
    , blocks(blocks)
    , numbering(numbering)
    , cells(cells)
    , fields(fields)
    , contact(contact)
  {
    cell_volume.assign(split.mesh.n_cells(), 0.);
    for (const unsigned int c : numbering.mesh_cell)
      cell_volume[c] = split.mesh.cell_volume(c);
    block_of_node.assign(numbering.n_local(), none);
    for (unsigned int c = 0; c < split.mesh.n_cells(); ++c)
      for (const unsigned int v : split.mesh.cells[c])
        if (numbering.local_node(v) != none)
          if (split.block_of_cell[c] != none)
            block_of_node[numbering.local_node(v)] = split.block_of_cell[c];
    for (const auto &monitor : scene.monitors)
      find_target(*monitor);
    name_columns();
  }



  template <int dim>
  void
  Monitors<dim>::name_columns()
  {
    const std::vector<std::string> axes = {"x", "y", "z"};
    std::vector<std::string> &columns   = history.columns;
    columns                             = {"stage [-]", "step [-]", "time [s]"};
    for (const auto &monitor : scene.monitors)
      {
        const auto add_vector = [&](const std::string &quantity,
                                    const std::string &unit) {
          for (unsigned int d = 0; d < dim; ++d)
            columns.push_back(monitor->name + "." + quantity + "_" + axes[d] +
                              " [" + unit + "]");
        };
        const auto add_scalars = [&](const std::vector<std::string> &names) {
          for (const std::string &name : names)
            columns.push_back(monitor->name + "." + name);
        };
        if (monitor->kind == MonitorKind::joint)
          {
            add_scalars({"normal_force [N]", "shear_force [N]"});
            add_vector("force", "N");
            add_vector("center", "m");
            add_scalars(
              {"open [-]", "sliding [-]", "sticking [-]", "intact [-]"});
            add_scalars({"slip [m]", "opening [m]"});
            continue;
          }
        if (monitor->kind == MonitorKind::support)
          {
            add_vector("reaction", "N");
            continue;
          }
        add_vector("u", "m");
        add_vector("v", "m/s");
        if (monitor->kind == MonitorKind::block)
          add_scalars({"rotation [rad]",
                       "angular_momentum [N m s]",
                       "mean_stress_trace [Pa]",
                       "slip [m]",
                       "largest_slip [m]",
                       "opening [m]"});
      }
    for (unsigned int i = 0; i < n_recorded_energies; ++i)
      columns.push_back("energy." + Energies::terms()[i].name + " [J]");
    columns.push_back("energy.residual [J]");
    columns.push_back("unbalanced_ratio [-]");
  }



  template <int dim>
  void
  Monitors<dim>::reset_baseline()
  {
    baseline = fields.displacement;
  }



  template <int dim>
  std::vector<double>
  Monitors<dim>::make_row(const ExplicitStep<dim> &step,
                          const unsigned int stage)
  {
    std::vector<double> row = {double(stage), double(step.n_steps), step.time};
    for (unsigned int m = 0; m < scene.monitors.size(); ++m)
      {
        const Monitor<dim> &monitor = *scene.monitors[m];
        if (monitor.kind == MonitorKind::joint)
          sample_joint(monitor, row);
        else if (monitor.kind == MonitorKind::block)
          {
            sample_block(block_of_monitor[m], row);
            sample_block_motion(block_of_monitor[m], row);
          }
        else if (monitor.kind == MonitorKind::support)
          sample_support(monitor, row);
        else if (monitor.kind == MonitorKind::region)
          sample_nodes(nodes_of_monitor[m], row);
        else
          sample_nodes(node_of_monitor[m] == none
                         ? std::vector<unsigned int>()
                         : std::vector<unsigned int>{node_of_monitor[m]},
                       row);
      }
    for (unsigned int i = 0; i < n_recorded_energies; ++i)
      row.push_back(step.energies.*Energies::terms()[i].value);
    row.push_back(step.energies.residual());
    row.push_back(step.unbalanced_ratio);
    return row;
  }



  template <int dim>
  void
  Monitors<dim>::sample_start(const ExplicitStep<dim> &step)
  {
    const std::vector<double> row = make_row(step, 0);
    if (numbering.communicator.is_root())
      history.rows.push_back(row);
  }



  template <int dim>
  void
  Monitors<dim>::sample(const ExplicitStep<dim> &step, const unsigned int stage)
  {
    const std::vector<double> row = make_row(step, stage);
    while (history.stage_begin.size() <= stage)
      history.stage_begin.push_back(history.rows.size());
    if (numbering.communicator.is_root())
      history.rows.push_back(row);
  }



  namespace
  {
    /** Rows from @p first on; before row 0 the names of the columns. */
    void
    write_rows(const History &history,
               const std::size_t first,
               std::ostream &out)
    {
      if (first == 0)
        {
          for (unsigned int c = 0; c < history.columns.size(); ++c)
            out << (c ? "," : "") << history.columns[c];
          out << '\n';
        }
      out << std::setprecision(12);
      for (std::size_t i = first; i < history.rows.size(); ++i)
        {
          const std::vector<double> &row = history.rows[i];
          for (unsigned int c = 0; c < row.size(); ++c)
            out << (c ? "," : "") << row[c];
          out << '\n';
        }
    }
  } // namespace



  template <int dim>
  void
  Monitors<dim>::write_csv(const std::string &file_name) const
  {
    if (!numbering.communicator.is_root())
      return numbering.communicator.assert_written(true, file_name);
    std::ofstream out(file_name);
    write_rows(history, 0, out);
    numbering.communicator.assert_written(bool(out.flush()), file_name);
  }



  template <int dim>
  void
  Monitors<dim>::append_csv(const std::string &file_name)
  {
    if (!numbering.communicator.is_root())
      return;
    std::ofstream out(file_name,
                      n_appended > 0 ? std::ios::app : std::ios::trunc);
    // at once: a run that is killed meanwhile leaves no half a line
    std::ostringstream rows;
    write_rows(history, n_appended, rows);
    out << rows.str() << std::flush;
    n_appended = history.rows.size();
  }

  template class Monitors<2>;
  template class Monitors<3>;
} // namespace Keyblock
