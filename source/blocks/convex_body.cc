// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/blocks/convex_body.h>

#include <algorithm>
#include <cmath>

namespace Keyblock
{
  namespace
  {
    /** Points of a convex section, each once, in 3D in order around it. */
    template <int dim>
    std::vector<Point<dim>>
    in_order(const std::vector<Point<dim>> &points,
             const Tensor<1, dim> &normal,
             const double tolerance)
    {
      std::vector<Point<dim>> once;
      for (const Point<dim> &p : points)
        if (std::none_of(once.begin(), once.end(), [&](const Point<dim> &q) {
              return p.distance(q) <= tolerance;
            }))
          once.push_back(p);
      if (once.size() < dim)
        return {};
      if constexpr (dim == 3)
        {
          Point<dim> middle;
          for (const Point<dim> &p : once)
            middle += p / double(once.size());
          const Tensor<1, dim> first  = once[0] - middle,
                               second = cross_product_3d(normal, first);
          std::vector<std::pair<double, Point<dim>>> turned;
          turned.reserve(once.size());
          for (const Point<dim> &p : once)
            turned.emplace_back(std::atan2((p - middle) * second,
                                           (p - middle) * first),
                                p);
          std::sort(turned.begin(),
                    turned.end(),
                    [](const auto &a, const auto &b) {
                      return a.first < b.first;
                    });
          for (unsigned int i = 0; i < once.size(); ++i)
            once[i] = turned[i].second;
        }
      return once;
    }

    /** The part of a face behind a plane; what of it lies on the plane is put
     * into @p on_plane. */
    template <int dim>
    std::vector<Point<dim>>
    behind(const std::vector<Point<dim>> &corners,
           const Point<dim> &point,
           const Tensor<1, dim> &outward,
           const double tolerance,
           std::vector<Point<dim>> &on_plane)
    {
      std::vector<Point<dim>> kept;
      for (unsigned int i = 0; i < corners.size(); ++i)
        {
          const Point<dim> &a = corners[i],
                           &b = corners[(i + 1) % corners.size()];
          const double from = outward * (a - point), to = outward * (b - point);
          if (std::abs(from) <= tolerance)
            on_plane.push_back(a);
          if (from <= tolerance)
            kept.push_back(a);
          // (an edge of a polygon has no way back)
          if (dim == 2 && i == 1)
            break;
          if ((from < -tolerance && to > tolerance) ||
              (from > tolerance && to < -tolerance))
            {
              const Point<dim> p(a + from / (from - to) * (b - a));
              on_plane.push_back(p);
              kept.push_back(p);
            }
        }
      return kept;
    }
  } // namespace



  template <int dim>
  ConvexBody<dim>::ConvexBody(const Point<dim> &low,
                              const Point<dim> &high,
                              const double tolerance)
    : tolerance(tolerance)
  {
    for (unsigned int d = 0; d < dim; ++d)
      for (const double sign : {-1., 1.})
        {
          Face face;
          face.name            = of_box;
          face.outward[d]      = sign;
          Point<dim> p         = low;
          p[d]                 = sign < 0. ? low[d] : high[d];
          const unsigned int a = (d + 1) % dim, b = (d + 2) % dim;
          face.corners = {p};
          p[a]         = high[a];
          face.corners.push_back(p);
          if (dim == 3)
            {
              p[b] = high[b];
              face.corners.push_back(p);
              p[a] = low[a];
              face.corners.push_back(p);
            }
          faces.push_back(face);
        }
  }



  template <int dim>
  ConvexBody<dim>::ConvexBody(const std::array<Point<dim>, dim + 1> &corners,
                              const double tolerance)
    : tolerance(tolerance)
  {
    for (unsigned int opposite = 0; opposite <= dim; ++opposite)
      {
        Face face;
        face.name = of_box;
        for (unsigned int i = 0; i <= dim; ++i)
          if (i != opposite)
            face.corners.push_back(corners[i]);
        if constexpr (dim == 2)
          face.outward = cross_product_2d(face.corners[1] - face.corners[0]);
        else
          face.outward = cross_product_3d(face.corners[1] - face.corners[0],
                                          face.corners[2] - face.corners[0]);
        face.outward /= face.outward.norm();
        if (face.outward * (corners[opposite] - face.corners[0]) > 0.)
          face.outward = -face.outward;
        faces.push_back(face);
      }
  }



  template <int dim>
  void
  ConvexBody<dim>::cut(const Point<dim> &point,
                       const Tensor<1, dim> &outward,
                       const unsigned int name)
  {
    const auto [least, greatest] = reach(point, outward);
    if (greatest <= tolerance)
      return;
    std::vector<Face> kept;
    std::vector<Point<dim>> on_plane;
    if (least < -tolerance)
      for (Face &face : faces)
        {
          face.corners =
            behind(face.corners, point, outward, tolerance, on_plane);
          if (face.corners.size() >= dim)
            kept.push_back(face);
        }
    const std::vector<Point<dim>> corners =
      in_order(on_plane, outward, tolerance);
    if (!corners.empty())
      kept.push_back({name, outward, corners});
    faces = kept;
  }



  template <int dim>
  std::vector<Point<dim>>
  ConvexBody<dim>::section(const Point<dim> &point,
                           const Tensor<1, dim> &normal) const
  {
    std::vector<Point<dim>> on_plane;
    for (const Face &face : faces)
      behind(face.corners, point, normal, tolerance, on_plane);
    return in_order(on_plane, normal, tolerance);
  }



  template <int dim>
  std::pair<double, double>
  ConvexBody<dim>::reach(const Point<dim> &point,
                         const Tensor<1, dim> &normal) const
  {
    std::pair<double, double> range(1e300, -1e300);
    for (const Face &face : faces)
      for (const Point<dim> &p : face.corners)
        {
          const double distance = normal * (p - point);
          range.first           = std::min(range.first, distance);
          range.second          = std::max(range.second, distance);
        }
    return range;
  }



  template <int dim>
  bool
  ConvexBody<dim>::contains(const Point<dim> &p) const
  {
    return std::all_of(faces.begin(), faces.end(), [&p](const Face &face) {
      return face.outward * (p - face.corners[0]) < 0.;
    });
  }



  template <int dim>
  double
  ConvexBody<dim>::volume() const
  {
    if (is_empty())
      return 0.;
    const Point<dim> &origin = faces[0].corners[0];
    double sum               = 0.;
    for (const Face &face : faces)
      sum += area(face) * (face.outward * (face.corners[0] - origin)) / dim;
    return sum;
  }



  template <int dim>
  Point<dim>
  ConvexBody<dim>::centroid() const
  {
    // cones over the faces, or over the triangles that these are fanned into
    const Point<dim> origin = faces[0].corners[0];
    Tensor<1, dim> moment;
    double sum = 0.;
    for (const Face &face : faces)
      {
        const double height = face.outward * (face.corners[0] - origin);
        for (unsigned int i = dim - 1; i < face.corners.size(); ++i)
          {
            Face part = face;
            part.corners.assign(face.corners.begin() + i - (dim - 2),
                                face.corners.begin() + i + 1);
            part.corners.insert(part.corners.begin(), face.corners[0]);
            const double cone = area(part) * height / dim;
            for (const Point<dim> &p : part.corners)
              moment += cone / (dim + 1) * (p - origin);
            sum += cone;
          }
      }
    return origin + moment / sum;
  }



  template <int dim>
  double
  ConvexBody<dim>::area(const Face &face)
  {
    if constexpr (dim == 2)
      return face.corners[0].distance(face.corners[1]);
    else
      {
        Tensor<1, dim> twice;
        for (unsigned int i = 2; i < face.corners.size(); ++i)
          twice += cross_product_3d(face.corners[i - 1] - face.corners[0],
                                    face.corners[i] - face.corners[0]);
        return 0.5 * twice.norm();
      }
  }

  template <int dim>
  double
  ConvexBody<dim>::area_inside(Face part) const
  {
    std::vector<Point<dim>> on_plane;
    for (const Face &face : faces)
      {
        part.corners = behind(
          part.corners, face.corners[0], face.outward, tolerance, on_plane);
        if (part.corners.size() < dim)
          return 0.;
      }
    return area(part);
  }

  template class ConvexBody<2>;
  template class ConvexBody<3>;
} // namespace Keyblock
