// SPDX-License-Identifier: LGPL-2.1-or-later
// Measures of the box around points, in their unit.
#ifndef keyblock_base_box_h
#define keyblock_base_box_h

#include <deal.II/base/bounding_box.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace Keyblock
{
  using dealii::BoundingBox;
  using dealii::Point;

  /** Diagonal of the box around @p points; zero for none. */
  template <int dim>
  double
  diagonal_of_box(const std::vector<Point<dim>> &points)
  {
    const BoundingBox<dim> box(points);
    const auto &[low, high] = box.get_boundary_points();
    return low.distance(high);
  }

  template <int dim>
  double
  longest_side(const BoundingBox<dim> &box)
  {
    double longest = 0.;
    for (unsigned int d = 0; d < dim; ++d)
      longest = std::max(longest, box.side_length(d));
    return longest;
  }

  /** Largest distance from the origin along an axis. */
  template <int dim>
  double
  farthest_coordinate(const BoundingBox<dim> &box)
  {
    double farthest = 0.;
    for (unsigned int d = 0; d < dim; ++d)
      farthest = std::max(
        {farthest, std::abs(box.lower_bound(d)), std::abs(box.upper_bound(d))});
    return farthest;
  }

  /** Distance of a point from @p box; zero inside. */
  template <int dim>
  double
  distance_from_box(const BoundingBox<dim> &box, const Point<dim> &p)
  {
    const auto &[low, high] = box.get_boundary_points();
    double sum              = 0.;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const double outside = std::max({low[d] - p[d], 0., p[d] - high[d]});
        sum += outside * outside;
      }
    return std::sqrt(sum);
  }
} // namespace Keyblock

#endif
