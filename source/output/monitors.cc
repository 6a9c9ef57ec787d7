// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/expression.h>
#include <keyblock/output/monitors.h>

#include <algorithm>
#include <iomanip>
#include <limits>
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
  Monitors<dim>::find_target(const Monitor<dim> &monitor)
  {
    unsigned int node = none, block = none;
    std::vector<unsigned int> nodes;
    if (monitor.kind == MonitorKind::point)
      {
        unsigned int nearest = none;
        double least         = std::numeric_limits<double>::max();
        for (unsigned int v = 0; v < split.mesh.vertices.size(); ++v)
          {
            const double d = split.mesh.vertices[v].distance(monitor.location);
            if (d < least)
              {
                least   = d;
                nearest = v;
              }
          }
        look_for_location(monitor, least);
        if (numbering.is_owned(nearest))
          node = numbering.local_node(nearest);
      }
    if (monitor.kind == MonitorKind::block)
      block = find_block(monitor);
    if (monitor.kind == MonitorKind::region)
      {
        const Expression<dim> region(monitor.region,
                                     1,
                                     "Monitors/" + monitor.name + "/Region");
        for (unsigned int i = 0; i < numbering.n_owned(); ++i)
          if (region.value(split.mesh.vertices[numbering.vertex_of_node[i]],
                           0.,
                           0) > 0.)
            nodes.push_back(i);
        const unsigned int n_nodes =
          numbering.communicator.sum(static_cast<unsigned int>(nodes.size()));
        AssertThrow(n_nodes > 0,
                    InputError("The formula of the entry 'Monitors/" +
                               monitor.name +
                               "/Region' is positive at no node; correct it, "
                               "or leave the monitor out."));
      }
    node_of_monitor.push_back(node);
    block_of_monitor.push_back(block);
    nodes_of_monitor.push_back(nodes);
  }



  template <int dim>
  unsigned int
  Monitors<dim>::find_block(const Monitor<dim> &monitor)
  {
    if (monitor.block > 0)
      {
        const unsigned int n_blocks = blocks.blocks.size();
        AssertThrow(monitor.block <= n_blocks,
                    InputError("The monitor '" + monitor.name +
                               "' is of block " +
                               std::to_string(monitor.block) +
                               ", but there are " + std::to_string(n_blocks) +
                               " in the block table; correct 'Monitors/" +
                               monitor.name + "/Block'."));
        return monitor.block - 1;
      }
    // where it lies in a cell, that one's block, however far its centre is
    const unsigned int cell = find_cell_at(monitor.location);
    if (cell != none && split.block_of_cell[cell] != none)
      return split.block_of_cell[cell];
    unsigned int nearest = none;
    double least         = std::numeric_limits<double>::max();
    for (unsigned int c = 0; c < split.mesh.n_cells(); ++c)
      {
        const double d = split.mesh.cell_center(c).distance(monitor.location);
        if (d < least && split.block_of_cell[c] != none)
          {
            least   = d;
            nearest = c;
          }
      }
    look_for_location(monitor, least);
    AssertThrow(nearest != none,
                InputError("The monitor '" + monitor.name +
                           "' is of kind block, but there is no block: all "
                           "rock is excavated later; correct 'Monitors/" +
                           monitor.name + "/Kind'."));
    return split.block_of_cell[nearest];
  }



  template <int dim>
  unsigned int
  Monitors<dim>::find_cell_at(const Point<dim> &location) const
  {
    constexpr double tolerance = 1e-6; // of a cell's size
    const Mesh<dim> &mesh      = split.mesh;
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      {
        const Point<dim> center = mesh.cell_center(c);
        double reach            = 0.;
        for (const unsigned int v : mesh.cells[c])
          reach = std::max(reach, center.distance(mesh.vertices[v]));
        if (center.distance(location) > (1. + tolerance) * reach)
          continue;
        bool is_inside = true;
        for (unsigned int f = 0; f < Mesh<dim>::n_cell_faces; ++f)
          {
            const Tensor<1, dim> area = mesh.face_area_vector(c, f);
            is_inside =
              is_inside && area * (location - mesh.face_center(c, f)) <=
                             tolerance * reach * area.norm();
          }
        if (is_inside)
          return c;
      }
    return none;
  }



  template <int dim>
  void
  Monitors<dim>::look_for_location(const Monitor<dim> &monitor,
                                   const double distance)
  {
    if (find_cell_at(monitor.location) != none)
      return;
    const Mesh<dim> &mesh = split.mesh;
    Point<dim> low = mesh.vertices[0], high = low;
    for (const Point<dim> &p : mesh.vertices)
      for (unsigned int d = 0; d < dim; ++d)
        {
          low[d]  = std::min(low[d], p[d]);
          high[d] = std::max(high[d], p[d]);
        }
    std::ostringstream text;
    text << "The monitor '" << monitor.name << "' is at (" << monitor.location
         << ") m, which is in no rock";
    const std::string remedy =
      "correct 'Monitors/" + monitor.name + "/Location'";
    AssertThrow(distance <= low.distance(high),
                InputError(text.str() + " by far; " + remedy + "."));
    text << "; it follows the nearest "
         << (monitor.kind == MonitorKind::block ? "block, with a cell "
                                                : "node, ")
         << std::setprecision(3) << distance << " m away: " << remedy
         << ", if that is not meant.";
    warnings.push_back(text.str());
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
    write_rows(history, n_appended, out);
    n_appended = history.rows.size();
  }

  template class Monitors<2>;
  template class Monitors<3>;
} // namespace Keyblock
