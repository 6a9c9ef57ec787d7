// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/utilities.h>

#include <keyblock/base/errors.h>
#include <keyblock/base/number_text.h>
#include <keyblock/output/liner_output.h>
#include <keyblock/scene/network_output.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <sstream>

namespace Keyblock
{
  namespace
  {
    std::string
    liners_file(const unsigned int number)
    {
      return "liners_" + dealii::Utilities::int_to_string(number, 4) + ".vtu";
    }

    template <int dim>
    void
    add_tensor(VtuArray &array, const SymmetricTensor<2, dim> &tensor)
    {
      for (unsigned int d = 0; d < 3; ++d)
        for (unsigned int e = 0; e < 3; ++e)
          array.add(d < dim && e < dim ? tensor[d][e] : 0.);
    }

    /** The eigenvalue of largest size. */
    template <int dim>
    double
    principal(const SymmetricTensor<2, dim> &tensor)
    {
      double largest = 0.;
      for (const double value : eigenvalues(tensor))
        if (std::abs(value) > std::abs(largest))
          largest = value;
      return largest;
    }

    /** Faces as lines or quadrilaterals, and what they bear. */
    template <int dim>
    VtuGrid
    draw(const std::vector<LinerLoads<dim>> &all, const Scene<dim> &scene)
    {
      VtuGrid grid;
      VtuArray moved       = VtuArray::vector("displacement (m)"),
               thrusts     = VtuArray::tensor("thrust (N/m)"),
               moments     = VtuArray::tensor("moment (N m/m)"),
               compression = VtuArray::scalar("principal thrust (N/m)"),
               bending     = VtuArray::scalar("principal moment (N m/m)"),
               shear       = VtuArray::scalar("shear force (N/m)"),
               factor      = VtuArray::scalar("factor of safety"),
               liner       = VtuArray::ids("liner");
      for (const LinerLoads<dim> &loads : all)
        {
          const unsigned int first = grid.n_points();
          for (unsigned int p = 0; p < loads.points.size(); ++p)
            {
              grid.add_point(loads.points[p], dim);
              moved.add_vector(loads.displacement[p], dim);
            }
          for (unsigned int f = 0; f < loads.faces.size(); ++f)
            {
              std::vector<unsigned int> corners;
              for (const unsigned int p : loads.faces[f])
                corners.push_back(first + p);
              grid.add_cell(dim == 2 ? VtuCell::line : VtuCell::quadrilateral,
                            corners);
              const LinerForce<dim> &force = loads.forces[f];
              add_tensor(thrusts, force.thrust);
              add_tensor(moments, force.moment);
              compression.add(principal(force.thrust));
              bending.add(principal(force.moment));
              shear.add(force.shear);
              // a finite number where nothing limits it, for pictures
              factor.add(std::min(loads.checks[f].factor, 1e3));
              liner.add_id(loads.liner);
            }
        }
      grid.point_data = {moved};
      grid.cell_data  = {thrusts, moments, compression, bending};
      if (dim == 2)
        grid.cell_data.push_back(shear);
      grid.cell_data.push_back(factor);
      grid.cell_data.push_back(liner);
      grid.texts.emplace_back("liner names", names_of(scene.liners));
      return grid;
    }
  } // namespace



  template <int dim>
  LinerFigures
  list_figures(const LinerLoads<dim> &loads)
  {
    LinerFigures figures;
    figures.liner = loads.liner;
    for (unsigned int f = 0; f < loads.faces.size(); ++f)
      {
        const LinerForce<dim> &force = loads.forces[f];
        figures.area += loads.areas[f];
        for (const double thrust : eigenvalues(force.thrust))
          {
            figures.largest_compression =
              std::max(figures.largest_compression, -thrust);
            figures.largest_tension = std::max(figures.largest_tension, thrust);
          }
        figures.largest_moment =
          std::max(figures.largest_moment, std::abs(principal(force.moment)));
        figures.largest_shear =
          std::max(figures.largest_shear, std::abs(force.shear));
        if (loads.checks[f].factor < 1.)
          figures.exceeded_area += loads.areas[f];
        if (loads.checks[f].factor < figures.check.factor)
          {
            figures.check = loads.checks[f];
            figures.place.assign(dim, 0.);
            for (const unsigned int p : loads.faces[f])
              for (unsigned int d = 0; d < dim; ++d)
                figures.place[d] += loads.points[p][d] / loads.faces[f].size();
          }
      }
    // what is left of one where there is only the other
    constexpr double round_off = 1e-12;
    if (figures.largest_tension < round_off * figures.largest_compression)
      figures.largest_tension = 0.;
    if (figures.largest_compression < round_off * figures.largest_tension)
      figures.largest_compression = 0.;
    return figures;
  }



  std::string
  describe(const LinerFigures &figures, const Liner &liner)
  {
    std::ostringstream out;
    out << "Liner   " << liner.name << ": " << std::setprecision(4)
        << figures.area << " m2, thrust up to "
        << 1e-3 * figures.largest_compression << " kN/m of compression and "
        << 1e-3 * figures.largest_tension << " of tension, moment up to "
        << 1e-3 * figures.largest_moment << " kN m/m";
    if (std::isfinite(figures.check.factor))
      {
        out << ", factor of safety " << figures.check.factor << " in "
            << (figures.check.is_tension ? "tension" : "compression")
            << " at (";
        for (unsigned int d = 0; d < figures.place.size(); ++d)
          out << (d ? ", " : "") << figures.place[d];
        out << ')';
      }
    out << '\n';
    return out.str();
  }



  std::string
  warning_of(const LinerFigures &figures, const Liner &liner)
  {
    if (!(figures.check.factor < 1.))
      return "";
    return "Thrust and moment of the liner '" + liner.name +
           "' are beyond its strength on " + text_of(figures.exceeded_area, 4) +
           " of " + text_of(figures.area, 4) +
           " m2; it is computed as elastic and holds more there than it can.";
  }



  template <int dim>
  nlohmann::ordered_json
  liners_as_json(const std::vector<LinerReport> &liners,
                 const std::vector<LinerFigures> &structural,
                 const Scene<dim> &scene)
  {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const LinerReport &report : liners)
      {
        list.push_back({{"name", scene.liners[report.liner]->name},
                        {"stage", scene.liners[report.liner]->stage},
                        {"area", report.area},
                        {"trace_length", report.trace_length},
                        {"shear_resistance", report.strength},
                        {"largest_load_ratio", report.largest_load},
                        {"sheared_length", report.sheared}});
        for (const LinerFigures &figures : structural)
          if (figures.liner == report.liner)
            {
              auto &item                  = list.back();
              item["largest_compression"] = figures.largest_compression;
              item["largest_tension"]     = figures.largest_tension;
              item["largest_moment"]      = figures.largest_moment;
              if (dim == 2)
                item["largest_shear_force"] = figures.largest_shear;
              if (std::isfinite(figures.check.factor))
                {
                  item["safety_factor"] = figures.check.factor;
                  item["governed_by"] =
                    figures.check.is_tension ? "tension" : "compression";
                  item["place_of_least_factor"] = figures.place;
                  item["exceeded_area"]         = figures.exceeded_area;
                }
            }
      }
    return list;
  }



  template <int dim>
  void
  write_liners(const std::string &folder,
               const std::vector<VtuRecord> &records,
               const std::vector<LinerLoads<dim>> &loads,
               const Scene<dim> &scene)
  {
    if (loads.empty() || records.empty())
      return;
    const std::string last = liners_file(records.size() / 2 - 1);
    VtuGrid grid           = draw(loads, scene);
    grid.is_far            = are_far(grid.points);
    grid.time              = records.back().time;
    grid.texts.emplace_back("stage",
                            std::vector<std::string>{records.back().stage});
    bool is_written = write_vtu(grid, folder + last);
    std::vector<VtuRecord> written;
    for (unsigned int i = 0; i < records.size() / 2; ++i)
      if (std::filesystem::exists(folder + liners_file(i)))
        written.push_back(
          {records[2 * i].time, liners_file(i), "", records[2 * i].stage});
    is_written = write_pvd(written, folder + "liners.pvd") && is_written;
    AssertThrow(is_written,
                ComputationError("The file '" + folder + last +
                                 "' cannot be written; check free space."));
  }

#define INSTANTIATE(dim)                                                       \
  template LinerFigures list_figures(const LinerLoads<dim> &);                 \
  template nlohmann::ordered_json liners_as_json(                              \
    const std::vector<LinerReport> &,                                          \
    const std::vector<LinerFigures> &,                                         \
    const Scene<dim> &);                                                       \
  template void write_liners(const std::string &,                              \
                             const std::vector<VtuRecord> &,                   \
                             const std::vector<LinerLoads<dim>> &,             \
                             const Scene<dim> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock
