// SPDX-License-Identifier: LGPL-2.1-or-later
// What is allowed and probably not meant of sets of joints.
#include <keyblock/base/number_text.h>
#include <keyblock/scene/joint_sets.h>
#include <keyblock/scene/section_axis.h>

#include <algorithm>
#include <limits>
#include <set>

namespace Keyblock
{
  namespace
  {
    /** So many discs are meshed in some minutes. */
    constexpr unsigned int many_discs = 500;

    /** The region, twice as large as what is dug and about its middle, by its
     * least and greatest coordinates; the first are greater where what is dug
     * has no box by its entries. */
    std::pair<Point<3>, Point<3>>
    region_around(
      const std::vector<std::unique_ptr<Excavation<3>>> &excavations)
    {
      constexpr double all = std::numeric_limits<double>::max();
      Point<3> lower(all, all, all), upper(-all, -all, -all);
      const auto add = [&](const Point<3> &corner) {
        for (unsigned int d = 0; d < 3; ++d)
          {
            lower[d] = std::min(lower[d], corner[d]);
            upper[d] = std::max(upper[d], corner[d]);
          }
      };
      for (const auto &excavation : excavations)
        {
          for (const Point<2> &vertex : excavation->vertices)
            for (const double y : {excavation->from, excavation->to})
              add(from_section(*excavation, Point<3>(vertex[0], y, vertex[1])));
          if (excavation->shape == ExcavationShape::box &&
              excavation->size.size() == 3)
            {
              Point<3> end = excavation->corner;
              for (unsigned int d = 0; d < 3; ++d)
                end[d] += excavation->size[d];
              add(excavation->corner);
              add(end);
            }
        }
      if (lower[0] > upper[0])
        return {lower, upper};
      const Tensor<1, 3> half = 0.5 * (upper - lower);
      return {lower - half, upper + half};
    }
  } // namespace



  template <int dim>
  std::vector<std::string>
  warnings_of_sets(const Scene<dim> &scene)
  {
    if (dim == 2 || scene.network.is_resolved)
      return {};
    std::set<std::string> names;
    std::string list;
    for (const auto &set : scene.joint_sets)
      if (set->is_made() && set->region_size.empty() &&
          set->radius_law != RadiusDistribution::infinite)
        {
          names.insert(set->name);
          list += (list.empty() ? "" : "', '") + set->name;
        }
    unsigned int n_discs = 0, n_near = 0;
    std::string region;
    if constexpr (dim == 3)
      {
        const auto [lower, upper] = region_around(scene.excavations);
        for (const auto &joint : scene.joints)
          if (names.count(joint->set) > 0)
            {
              ++n_discs;
              bool is_near = true;
              for (unsigned int d = 0; d < 3; ++d)
                is_near = is_near && joint->point[d] >= lower[d] &&
                          joint->point[d] <= upper[d];
              n_near += is_near;
            }
        if (lower[0] <= upper[0])
          for (unsigned int d = 0; d < 3; ++d)
            region += (d ? ", " : "") + text_of(upper[d] - lower[d], 3);
      }
    if (n_discs <= many_discs)
      return {};
    return {"The sets '" + list + "' fill the whole domain with " +
            std::to_string(n_discs) +
            " joints, which may take many minutes to mesh; 'Region corner' and "
            "'Region size' of a set keep it to the rock around what is dug" +
            (region.empty()
               ? ""
               : " (" + std::to_string(n_near) +
                   " have their centre in twice its size, " + region + " m)") +
            "."};
  }

  template std::vector<std::string> warnings_of_sets(const Scene<2> &);
  template std::vector<std::string> warnings_of_sets(const Scene<3> &);
} // namespace Keyblock
