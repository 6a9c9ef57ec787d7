// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/output/mesh_json.h>
#include <keyblock/scene/near_misses.h>

#include <string>
#include <vector>

namespace Keyblock
{
  template <int dim>
  Json
  mesh_report_as_json(const MeshReport<dim> &report, const Scene<dim> &scene)
  {
    Json json = {{"way", report.way},
                 {"reason", report.reason},
                 {"largest_shift", report.largest_shift},
                 {"largest_shift_in_cells", report.largest_shift_in_cells},
                 {"percentile_99", report.percentile_99},
                 {"percentile_99_in_cells", report.percentile_99_in_cells},
                 {"area_ratio_of_finite_joints", report.area_ratio},
                 {"area_ratio_of_large_joints", report.area_ratio_of_large},
                 {"passes", report.n_passes},
                 {"welded_blocks", report.n_welded},
                 {"lost_blocks", report.n_lost_blocks},
                 {"largest_lost_volume", report.largest_lost_volume}};
    if (report.n_lost_blocks > 0)
      json["largest_lost_place"] = list_of<dim>(report.largest_lost_place);
    const auto names = [&scene](const std::vector<unsigned int> &joints) {
      std::string text;
      for (const unsigned int j : joints)
        text += (text.empty() ? "" : ", ") + scene.joints[j]->name;
      return text;
    };
    json["joints_lost"]    = names(report.lost);
    json["joints_outside"] = names(report.outside);
    for (const auto &lost : report.lost_parts)
      json["plane_parts_lost"][scene.joints[lost.joint]->surface] = lost.n_lost;
    for (const auto &pair : report.merged)
      json["merged_areas"][scene.joints[pair.joint]->name + " " +
                           scene.joints[pair.other]->name] = pair.area;
    for (const auto &rock : report.thin_rock)
      json["thin_rock"][scene.joints[rock.joint]->name] = rock.thickness;
    return json;
  }



  template <int dim>
  Json
  comparison_as_json(const Blocks<dim> &blocks, const Scene<dim> &scene)
  {
    const BlockComparison<dim> &comparison = blocks.comparison;
    Json json                              = {{"bridging", comparison.bridging},
                                              {"finite", comparison.n_finite},
                                              {"exposed", comparison.n_exposed},
                                              {"gaps", Json::array()},
                                              {"lost", Json::array()},
                                              {"unlike", Json::array()}};
    for (const auto &miss : list_near_misses(scene,
                                             comparison.bridging,
                                             just_beyond * comparison.bridging))
      json["gaps"].push_back({{"joint", scene.joints[miss.joint]->name},
                              {"before", scene.joints[miss.other]->name},
                              {"width", miss.gap}});
    for (const unsigned int b : comparison.lost)
      json["lost"].push_back(
        {{"id", blocks.blocks[b].id},
         {"volume", blocks.blocks[b].exact.volume},
         {"centroid", list_of<dim>(blocks.blocks[b].exact.centroid)}});
    for (const unsigned int b : comparison.unlike)
      json["unlike"].push_back(blocks.blocks[b].id);
    return json;
  }

  template Json mesh_report_as_json(const MeshReport<2> &, const Scene<2> &);
  template Json mesh_report_as_json(const MeshReport<3> &, const Scene<3> &);
  template Json comparison_as_json(const Blocks<2> &, const Scene<2> &);
  template Json comparison_as_json(const Blocks<3> &, const Scene<3> &);
} // namespace Keyblock
