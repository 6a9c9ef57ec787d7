// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/bounding_box.h>

#include <keyblock/mesh/excavation_region.h>
#include <keyblock/scene/section_axis.h>
#include <keyblock/scene/solid.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Keyblock
{
  namespace
  {
    double
    depth_inside_polygon(const std::vector<Point<2>> &corners,
                         const Point<2> &p)
    {
      bool is_inside  = false;
      double distance = std::numeric_limits<double>::max();
      for (unsigned int i = 0; i < corners.size(); ++i)
        {
          const Point<2> &a       = corners[i];
          const Point<2> &b       = corners[(i + 1) % corners.size()];
          const Tensor<1, 2> edge = b - a;
          const double s = std::clamp((p - a) * edge / (edge * edge), 0., 1.);
          distance       = std::min(distance, p.distance(a + s * edge));
          if ((a[1] > p[1]) != (b[1] > p[1]) &&
              p[0] < a[0] + (p[1] - a[1]) / edge[1] * edge[0])
            is_inside = !is_inside;
        }
      return is_inside ? distance : -distance;
    }
  } // namespace



  template <int dim>
  double
  depth_inside(const Excavation<dim> &excavation, const Point<dim> &p)
  {
    if (excavation.shape == ExcavationShape::circle)
      return excavation.radius -
             excavation.center.distance(Point<2>(p[0], p[1]));
    if (excavation.shape == ExcavationShape::polygon)
      return depth_inside_polygon(excavation.vertices, Point<2>(p[0], p[1]));
    if constexpr (dim == 3)
      if (excavation.shape == ExcavationShape::extruded_polygon)
        {
          const Point<3> q = to_section(excavation, p);
          return std::min(
            {depth_inside_polygon(excavation.vertices, Point<2>(q[0], q[2])),
             q[1] - excavation.from,
             excavation.to - q[1]});
        }
    if constexpr (dim == 3)
      if (excavation.shape == ExcavationShape::file)
        {
          double depth = -std::numeric_limits<double>::max();
          for (const auto &solid : excavation.solids)
            depth = std::max(depth, solid->depth_inside(p));
          return depth;
        }
    double depth = std::numeric_limits<double>::max();
    for (unsigned int d = 0; d < dim; ++d)
      depth = std::min({depth,
                        p[d] - excavation.corner[d],
                        excavation.corner[d] + excavation.size[d] - p[d]});
    return depth;
  }

  template <int dim>
  double
  narrowest_side(const Excavation<dim> &excavation)
  {
    if (!excavation.has_outline())
      return 1e300;
    if (excavation.shape == ExcavationShape::circle)
      return 2. * excavation.radius;
    if (excavation.shape == ExcavationShape::box)
      return *std::min_element(excavation.size.begin(), excavation.size.end());
    if (excavation.shape == ExcavationShape::file)
      {
        double side = std::numeric_limits<double>::max();
        for (const auto &solid : excavation.solids)
          for (unsigned int d = 0; d < 3; ++d)
            side = std::min(side, solid->high[d] - solid->low[d]);
        return side;
      }
    const dealii::BoundingBox<2> box(excavation.vertices);
    const double side = std::min(box.side_length(0), box.side_length(1));
    return excavation.shape == ExcavationShape::extruded_polygon
             ? std::min(side, excavation.to - excavation.from)
             : side;
  }

  template double depth_inside(const Excavation<2> &, const Point<2> &);
  template double depth_inside(const Excavation<3> &, const Point<3> &);
  template double narrowest_side(const Excavation<2> &);
  template double narrowest_side(const Excavation<3> &);
} // namespace Keyblock
