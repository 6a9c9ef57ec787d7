// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_scene_box_sides_h
#define keyblock_scene_box_sides_h

#include <keyblock/base/expression.h>
#include <keyblock/scene/boundary_names.h>
#include <keyblock/scene/scene.h>

#include <algorithm>
#include <string>
#include <vector>

namespace Keyblock
{
  /** Places on a side of the box, none of them on its edges. */
  template <int dim>
  std::vector<Point<dim>>
  places_on(const Domain<dim> &box, const std::string &side)
  {
    constexpr unsigned int n_along        = 16;
    const std::vector<std::string> &sides = boundary_names<dim>();
    const unsigned int s =
      std::find(sides.begin(), sides.end(), side) - sides.begin();
    const unsigned int n = dim == 2 ? n_along : n_along * n_along;
    std::vector<Point<dim>> places;
    for (unsigned int i = 0; i < n; ++i)
      {
        Point<dim> place;
        unsigned int rest = i;
        for (unsigned int d = 0; d < dim; ++d)
          {
            double share = s % 2;
            if (d != s / 2)
              {
                share = (rest % n_along + 0.5) / n_along;
                rest /= n_along;
              }
            place[d] = box.corner[d] + share * box.size[d];
          }
        places.push_back(place);
      }
    return places;
  }

  /** Whether a support or a traction is on a side: it names it, or its
   * region has a part of it. */
  template <int dim, typename Item>
  bool
  is_on_side(const Item &item,
             const std::string &section,
             const Domain<dim> &box,
             const std::string &side)
  {
    for (const std::string &name : item.boundaries)
      if (name == side || name == "all")
        return true;
    if (item.region.empty())
      return false;
    const Expression<dim> inside(item.region,
                                 1,
                                 section + "/" + item.name + "/Region");
    const std::vector<Point<dim>> places = places_on(box, side);
    return std::any_of(places.begin(), places.end(), [&](const auto &place) {
      return inside.value(place, 0., 0) > 0.;
    });
  }

  /** Vertical stress at an elevation @p z [m] by the entries for stress that
   * grows with depth, compression positive [Pa]. */
  template <int dim>
  double
  vertical_stress_at(const InitialState<dim> &state, const double z)
  {
    return state.surface_stress +
           state.vertical_stress_gradient * (state.surface_elevation - z);
  }
} // namespace Keyblock

#endif
