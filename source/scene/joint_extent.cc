// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/numbers.h>

#include <keyblock/scene/joint_extent.h>

#include <algorithm>
#include <cmath>

namespace Keyblock
{
  template <int dim>
  JointExtent<dim>::JointExtent(const Joint<dim> &joint)
    : normal(joint.normal())
    , origin(joint.extent == JointShape::polygon ? joint.vertices[0]
                                                 : joint.point)
    , shape(joint.extent)
    , center(joint.point)
    , radius(joint.radius)
  {
    if (shape == JointShape::polygon)
      for (const Point<dim> &corner : joint.vertices)
        corners.push_back(corner - distance(corner) * normal);
    unsigned int steepest = 0;
    for (unsigned int d = 1; d < dim; ++d)
      if (std::abs(normal[d]) > std::abs(normal[steepest]))
        steepest = d;
    axes[0] = (steepest == 0) ? 1 : 0;
    axes[1] = (steepest == dim - 1) ? dim - 2 : dim - 1;
  }



  template <int dim>
  double
  JointExtent<dim>::depth_inside(const Point<dim> &p) const
  {
    if (shape == JointShape::infinite)
      return 1e300;
    const Point<dim> foot = p - distance(p) * normal;
    if (shape == JointShape::disc)
      return radius - foot.distance(center);
    if constexpr (dim == 2)
      {
        const Tensor<1, dim> along = corners[1] - corners[0];
        const double place         = (foot - corners[0]) * along / along.norm();
        return std::min(place, along.norm() - place);
      }
    const auto [a, b] = axes;
    bool is_inside    = false;
    double least      = 1e300;
    for (unsigned int i = 0; i < corners.size(); ++i)
      {
        const Point<dim> &from    = corners[i];
        const Point<dim> &to      = corners[(i + 1) % corners.size()];
        const Tensor<1, dim> edge = to - from;
        const double part =
          std::clamp((foot - from) * edge / (edge * edge), 0., 1.);
        least = std::min(least, foot.distance(from + part * edge));
        if ((from[b] > foot[b]) != (to[b] > foot[b]) &&
            foot[a] < edge[a] * (foot[b] - from[b]) / edge[b] + from[a])
          is_inside = !is_inside;
      }
    return is_inside ? least : -least;
  }



  template <int dim>
  double
  JointExtent<dim>::distance_to_joint(const Point<dim> &p) const
  {
    const double height = distance(p);
    if (shape == JointShape::infinite)
      return std::abs(height);
    return std::hypot(height, std::min(depth_inside(p), 0.));
  }



  template <int dim>
  double
  JointExtent<dim>::half_width() const
  {
    if (shape == JointShape::infinite)
      return 1e300;
    if (shape == JointShape::disc)
      return radius;
    if constexpr (dim == 2)
      return 0.5 * corners[0].distance(corners[1]);
    else
      {
        Tensor<1, dim> twice_area;
        double perimeter = 0.;
        for (unsigned int i = 0; i < corners.size(); ++i)
          {
            const Point<dim> &from = corners[i];
            const Point<dim> &to   = corners[(i + 1) % corners.size()];
            twice_area += cross_product_3d(from - corners[0], to - corners[0]);
            perimeter += from.distance(to);
          }
        return twice_area.norm() / perimeter;
      }
  }



  template <int dim>
  double
  JointExtent<dim>::area() const
  {
    if constexpr (dim == 2)
      return 2. * half_width();
    else
      {
        if (shape == JointShape::disc)
          return dealii::numbers::PI * radius * radius;
        Tensor<1, dim> twice_area;
        for (unsigned int i = 0; i < corners.size(); ++i)
          twice_area +=
            cross_product_3d(corners[i] - corners[0],
                             corners[(i + 1) % corners.size()] - corners[0]);
        return 0.5 * twice_area.norm();
      }
  }



  template <int dim>
  std::vector<Point<dim>>
  JointExtent<dim>::outermost_points() const
  {
    if (shape == JointShape::polygon)
      return corners;
    std::vector<Point<dim>> points;
    for (unsigned int d = 0; d < dim; ++d)
      {
        Tensor<1, dim> axis;
        axis[d]        = 1.;
        axis           = axis - (axis * normal) * normal;
        const double l = axis.norm();
        if (l < 1e-9)
          continue;
        points.push_back(center + radius / l * axis);
        points.push_back(center - radius / l * axis);
      }
    return points;
  }

  template class JointExtent<2>;
  template class JointExtent<3>;
} // namespace Keyblock
