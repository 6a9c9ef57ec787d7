// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_mesh_sheet_ridges_h
#define keyblock_mesh_sheet_ridges_h

#include <keyblock/scene/joint_extent.h>

#include <algorithm>
#include <array>
#include <map>
#include <vector>

// Where plane facets of a bent joint meet: see JointSheet.
namespace Keyblock
{
  /** In 2D an end of a segment, in 3D an edge of a polygon: its corners, the
   * lesser first. Corners that facets share are equal. */
  template <int dim>
  using Ridge = std::array<Point<dim>, dim - 1>;

  /** An order of points, and one of ridges. */
  template <int dim>
  bool
  is_before(const Point<dim> &a, const Point<dim> &b)
  {
    return std::lexicographical_compare(a.begin_raw(),
                                        a.end_raw(),
                                        b.begin_raw(),
                                        b.end_raw());
  }

  template <int dim>
  struct RidgeOrder
  {
    bool
    operator()(const Ridge<dim> &a, const Ridge<dim> &b) const
    {
      return std::lexicographical_compare(
        a.begin(), a.end(), b.begin(), b.end(), is_before<dim>);
    }
  };

  template <int dim>
  using FacetsAtRidge =
    std::map<Ridge<dim>, std::vector<unsigned int>, RidgeOrder<dim>>;

  /** The ridges of a facet with these corners, in its order. */
  template <int dim>
  std::vector<Ridge<dim>> ridges_of(const std::vector<Point<dim>> &corners);

  /** Whether the normal of each facet points to the other side than that of the
   * first facet which it is connected to. @p corners and @p ridges: of each. */
  template <int dim>
  std::vector<bool>
  turn_facets_alike(const std::vector<JointExtent<dim>> &facets,
                    const std::vector<std::vector<Point<dim>>> &corners,
                    const std::vector<std::vector<Ridge<dim>>> &ridges,
                    const FacetsAtRidge<dim> &at_ridge);
} // namespace Keyblock

#endif
