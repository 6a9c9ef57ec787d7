// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_blocks_face_quadrature_h
#define keyblock_blocks_face_quadrature_h

#include <keyblock/mesh/mesh.h>

#include <algorithm>
#include <array>
#include <vector>

// Integrals over faces of cells, and over polygons.
namespace Keyblock
{
  template <int dim>
  using FaceCorners = std::array<Point<dim>, Mesh<dim>::n_face_vertices>;

  /** A point of a quadrature rule on a face. */
  template <int dim>
  struct FacePoint
  {
    Point<dim> place;

    /** Of the corners' shape functions [-]. */
    std::array<double, Mesh<dim>::n_face_vertices> shape;

    Tensor<1, dim> area; ///< normal times weight [m^(dim-1)]
  };

  /** A part of a face: a square of its reference face. */
  template <int dim>
  struct FacePart
  {
    std::array<double, dim - 1> low = {};
    double size                     = 1.;

    /** Its halves (2D) or quarters. */
    std::vector<FacePart> children() const;
  };

  /**
   * Gauss's two points along each axis of a part of a face: exact for products
   * of a shape function and what is linear (quadratic in 2D) over the face. In
   * 2D the normal is to the left of the way from corner 0 to 1, in 3D that of
   * a right-handed turn from 0 over 1 and 3 to 2; corners may coincide.
   */
  template <int dim>
  std::vector<FacePoint<dim>>
  gauss_points(const FaceCorners<dim> &corners,
               const FacePart<dim> &part = FacePart<dim>());

  /** The same by Simpson's rule, with the ends of the part. */
  template <int dim>
  std::vector<FacePoint<dim>> simpson_points(const FaceCorners<dim> &corners,
                                             const FacePart<dim> &part);

  /** The corners of a face of a cell in their order. */
  template <int dim>
  FaceCorners<dim> face_corners(const Mesh<dim> &mesh,
                                const unsigned int cell,
                                const unsigned int face);

  /** Let the normals go to the side that @p outward goes to. */
  template <int dim>
  void turn_outward(std::vector<FacePoint<dim>> &points,
                    const Tensor<1, dim> &outward);

  /** Triangles of a convex polygon, in 2D the segment, as faces. */
  template <int dim>
  std::vector<FaceCorners<dim>>
  faces_of(const std::vector<Point<dim>> &polygon);

  /**
   * Points for the integral of a pressure or traction over a face: Gauss's of
   * its parts, halved where these and Simpson's differ, at kinks (a water
   * table, an edge of a load).
   * @param value called with a point, a double or a Tensor
   */
  template <int dim, typename Function>
  std::vector<FacePoint<dim>>
  adapted_points(const FaceCorners<dim> &corners, const Function &value)
  {
    // halvings at most; error of a part over the load of the face [-]
    constexpr unsigned int deepest = dim == 2 ? 10 : 5;
    constexpr double tolerance     = 1e-7;
    using Value                    = decltype(value(corners[0]));
    const auto size_of             = [](const Value &v) {
      if constexpr (std::is_arithmetic<Value>::value)
        return std::abs(v);
      else
        return v.norm();
    };
    double largest       = 0.;
    const auto shares_of = [&](const std::vector<FacePoint<dim>> &points) {
      std::array<Value, Mesh<dim>::n_face_vertices> sum = {};
      for (const FacePoint<dim> &point : points)
        {
          const Value v = value(point.place);
          largest       = std::max(largest, size_of(v));
          for (unsigned int i = 0; i < sum.size(); ++i)
            sum[i] += point.shape[i] * point.area.norm() * v;
        }
      return sum;
    };
    double area = 0.;
    std::vector<FacePoint<dim>> result;
    std::vector<std::pair<FacePart<dim>, unsigned int>> open = {
      {FacePart<dim>(), 0}};
    while (!open.empty())
      {
        const auto [part, depth] = open.back();
        open.pop_back();
        const auto points = gauss_points<dim>(corners, part);
        if (depth == 0)
          for (const FacePoint<dim> &point : points)
            area += point.area.norm();
        // (a kink between any of their points tells them apart)
        auto difference  = shares_of(points);
        const auto other = shares_of(simpson_points<dim>(corners, part));
        bool is_fine     = depth == deepest;
        if (!is_fine)
          {
            for (unsigned int i = 0; i < difference.size(); ++i)
              difference[i] -= other[i];
            is_fine =
              std::all_of(difference.begin(),
                          difference.end(),
                          [&](const Value &d) {
                            return size_of(d) <= tolerance * largest * area;
                          });
          }
        if (is_fine)
          result.insert(result.end(), points.begin(), points.end());
        else
          for (const FacePart<dim> &child : part.children())
            open.emplace_back(child, depth + 1);
      }
    return result;
  }
} // namespace Keyblock

#endif
