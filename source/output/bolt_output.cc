// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/utilities.h>

#include <keyblock/base/errors.h>
#include <keyblock/output/bolt_output.h>
#include <keyblock/scene/network_output.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace Keyblock
{
  namespace
  {
    std::string
    bolts_file(const unsigned int number)
    {
      return "bolts_" + dealii::Utilities::int_to_string(number, 4) + ".vtu";
    }

    /** Segments that are left as lines, their forces and the slip at their
     * ends. */
    template <int dim>
    VtuGrid
    draw(const std::vector<BoltReport<dim>> &reports, const Scene<dim> &scene)
    {
      VtuGrid lines;
      VtuArray slip  = VtuArray::scalar("bond slip (m)"),
               axial = VtuArray::scalar("axial force (N)"),
               dowel = VtuArray::scalar("dowel force (N)"),
               bolt = VtuArray::ids("bolt"), set = VtuArray::ids("bolt set");
      for (unsigned int b = 0; b < reports.size(); ++b)
        {
          const BoltReport<dim> &r = reports[b];
          const unsigned int first = lines.n_points();
          for (unsigned int j = 0; j < r.slip.size(); ++j)
            {
              lines.add_point(r.bolt->at(r.bolt->places[j]), dim);
              slip.add(r.slip[j]);
            }
          for (unsigned int j = 0; j < r.axial_force.size(); ++j)
            {
              if (r.is_cut[j])
                continue;
              lines.add_lattice_cell({first + j, first + j + 1});
              axial.add(r.axial_force[j]);
              dowel.add(r.dowel_force);
              bolt.add_id(b + 1);
              set.add_id(r.bolt->set);
            }
        }
      lines.point_data = {slip};
      lines.cell_data  = {axial, dowel, bolt, set};
      lines.texts.emplace_back("bolt set names", names_of(scene.bolts));
      lines.is_far = are_far(lines.points);
      return lines;
    }
  } // namespace



  template <int dim>
  std::vector<BoltFigures>
  list_figures(const std::vector<BoltReport<dim>> &reports,
               const Scene<dim> &scene)
  {
    std::vector<BoltFigures> figures;
    for (const BoltReport<dim> &r : reports)
      {
        BoltFigures one;
        one.set = scene.bolts[r.bolt->set]->name;
        for (unsigned int d = 0; d < dim; ++d)
          {
            one.head.push_back(r.bolt->head[d]);
            one.end.push_back(r.bolt->end[d]);
          }
        for (unsigned int j = 0; j < r.axial_force.size(); ++j)
          if (r.axial_force[j] > one.largest_axial_force)
            {
              one.largest_axial_force = r.axial_force[j];
              one.place = 0.5 * (r.bolt->places[j] + r.bolt->places[j + 1]);
            }
        for (const double slip : r.slip)
          one.largest_slip = std::max(one.largest_slip, std::abs(slip));
        one.plate_force = r.plate_force;
        one.dowel_force = r.dowel_force;
        one.n_crossings = r.bolt->crossings.size();
        one.is_broken   = r.is_broken;
        one.cut_length  = r.cut_length;
        one.limit       = r.limit;
        figures.push_back(one);
      }
    return figures;
  }



  template <int dim>
  void
  write_bolts(const std::string &folder,
              const std::vector<VtuRecord> &records,
              const std::vector<BoltReport<dim>> &reports,
              const Scene<dim> &scene)
  {
    if (reports.empty() || records.empty())
      return;
    const std::string last = bolts_file(records.size() / 2 - 1);
    VtuGrid lines          = draw(reports, scene);
    lines.time             = records.back().time;
    lines.texts.emplace_back("stage",
                             std::vector<std::string>{records.back().stage});
    bool is_written = write_vtu(lines, folder + last);
    std::vector<VtuRecord> written;
    for (unsigned int i = 0; i < records.size() / 2; ++i)
      if (std::filesystem::exists(folder + bolts_file(i)))
        written.push_back(
          {records[2 * i].time, bolts_file(i), "", records[2 * i].stage});
    is_written = write_pvd(written, folder + "bolts.pvd") && is_written;
    AssertThrow(is_written,
                ComputationError("The file '" + folder + last +
                                 "' cannot be written; check free space."));
  }


  nlohmann::ordered_json
  bolts_as_json(const std::vector<BoltFigures> &bolts)
  {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const BoltFigures &bolt : bolts)
      {
        list.push_back({{"set", bolt.set},
                        {"head", bolt.head},
                        {"end", bolt.end},
                        {"largest_axial_force", bolt.largest_axial_force},
                        {"place_of_largest", bolt.place},
                        {"plate_force", bolt.plate_force},
                        {"largest_bond_slip", bolt.largest_slip},
                        {"dowel_force", bolt.dowel_force},
                        {"joints_crossed", bolt.n_crossings},
                        {"is_broken", bolt.is_broken},
                        {"cut_length", bolt.cut_length}});
        if (!bolt.limit.empty())
          list.back()["governed_by"] = bolt.limit;
      }
    return list;
  }


#define INSTANTIATE(dim)                                                       \
  template std::vector<BoltFigures> list_figures(                              \
    const std::vector<BoltReport<dim>> &, const Scene<dim> &);                 \
  template void write_bolts(const std::string &,                               \
                            const std::vector<VtuRecord> &,                    \
                            const std::vector<BoltReport<dim>> &,              \
                            const Scene<dim> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock
