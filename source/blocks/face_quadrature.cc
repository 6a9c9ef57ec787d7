// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/blocks/face_quadrature.h>

#include <cmath>

namespace Keyblock
{
  template <int dim>
  std::vector<FacePart<dim>>
  FacePart<dim>::children() const
  {
    std::vector<FacePart> parts(1 << (dim - 1), *this);
    for (unsigned int i = 0; i < parts.size(); ++i)
      {
        parts[i].size = 0.5 * size;
        for (unsigned int d = 0; d < dim - 1; ++d)
          if (i & (1 << d))
            parts[i].low[d] += 0.5 * size;
      }
    return parts;
  }



  namespace
  {
    /** Places and weights of a rule between 0 and 1. */
    using Rule = std::vector<std::pair<double, double>>;

    template <int dim>
    std::vector<FacePoint<dim>>
    points_of(const Rule &rule,
              const FaceCorners<dim> &corners,
              const FacePart<dim> &part)
    {
      std::vector<FacePoint<dim>> points;
      if constexpr (dim == 2)
        {
          const Tensor<1, dim> normal =
            -cross_product_2d(corners[1] - corners[0]);
          for (const auto &[a, weight] : rule)
            {
              const double s = part.low[0] + a * part.size;
              points.push_back(
                {Point<dim>((1. - s) * corners[0] + s * corners[1]),
                 {{1. - s, s}},
                 weight * part.size * normal});
            }
        }
      else
        for (const auto &[a, weight_a] : rule)
          for (const auto &[b, weight_b] : rule)
            {
              const double s = part.low[0] + a * part.size,
                           t = part.low[1] + b * part.size;
              FacePoint<dim> point;
              for (unsigned int v = 0; v < corners.size(); ++v)
                {
                  point.shape[v] =
                    ((v & 1) ? s : 1. - s) * ((v & 2) ? t : 1. - t);
                  point.place += point.shape[v] * corners[v];
                }
              point.area =
                weight_a * weight_b * part.size * part.size *
                cross_product_3d((1. - t) * (corners[1] - corners[0]) +
                                   t * (corners[3] - corners[2]),
                                 (1. - s) * (corners[2] - corners[0]) +
                                   s * (corners[3] - corners[1]));
              points.push_back(point);
            }
      return points;
    }
  } // namespace



  template <int dim>
  std::vector<FacePoint<dim>>
  gauss_points(const FaceCorners<dim> &corners, const FacePart<dim> &part)
  {
    const double g = 0.5 / std::sqrt(3.);
    return points_of({{0.5 - g, 0.5}, {0.5 + g, 0.5}}, corners, part);
  }



  template <int dim>
  std::vector<FacePoint<dim>>
  simpson_points(const FaceCorners<dim> &corners, const FacePart<dim> &part)
  {
    return points_of({{0., 1. / 6.}, {0.5, 4. / 6.}, {1., 1. / 6.}},
                     corners,
                     part);
  }



  template <int dim>
  FaceCorners<dim>
  face_corners(const Mesh<dim> &mesh,
               const unsigned int cell,
               const unsigned int face)
  {
    const auto vertices = mesh.face_vertices(cell, face);
    FaceCorners<dim> corners;
    for (unsigned int v = 0; v < vertices.size(); ++v)
      corners[v] = mesh.vertices[vertices[v]];
    return corners;
  }



  template <int dim>
  void
  turn_outward(std::vector<FacePoint<dim>> &points,
               const Tensor<1, dim> &outward)
  {
    Tensor<1, dim> sum;
    for (const FacePoint<dim> &point : points)
      sum += point.area;
    if (sum * outward < 0.)
      for (FacePoint<dim> &point : points)
        point.area *= -1.;
  }



  template <int dim>
  std::vector<FaceCorners<dim>>
  faces_of(const std::vector<Point<dim>> &polygon)
  {
    if constexpr (dim == 2)
      return {{{polygon[0], polygon[1]}}};
    else
      {
        std::vector<FaceCorners<dim>> faces;
        for (unsigned int i = 2; i < polygon.size(); ++i)
          faces.push_back(
            {{polygon[0], polygon[i - 1], polygon[i], polygon[i]}});
        return faces;
      }
  }

#define INSTANTIATE(dim)                                                       \
  template struct FacePart<dim>;                                               \
  template std::vector<FacePoint<dim>> gauss_points(const FaceCorners<dim> &,  \
                                                    const FacePart<dim> &);    \
  template std::vector<FacePoint<dim>> simpson_points(                         \
    const FaceCorners<dim> &, const FacePart<dim> &);                          \
  template FaceCorners<dim> face_corners(const Mesh<dim> &,                    \
                                         const unsigned int,                   \
                                         const unsigned int);                  \
  template void turn_outward(std::vector<FacePoint<dim>> &,                    \
                             const Tensor<1, dim> &);                          \
  template std::vector<FaceCorners<dim>> faces_of(                             \
    const std::vector<Point<dim>> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock
