// SPDX-License-Identifier: LGPL-2.1-or-later
// On which side of a plane (in 2D of a line) others meet, without error. Places
// and distances have no unit: they are those of a domain in the box [-1, 1].
#ifndef keyblock_base_exact_sign_h
#define keyblock_base_exact_sign_h

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace Keyblock
{
  using dealii::Point;
  using dealii::Tensor;

  /** The plane n.x + d = 0. Its coefficients (n, d) are multiples of 2^-52, so
   * that doubles and integers hold them without error; the length of n is 1
   * within 1e-15, and |d| is below 2. */
  template <int dim>
  struct ExactPlane
  {
    std::array<std::int64_t, dim + 1> multiples; ///< of 2^-52: n, d
    Tensor<1, dim> normal;                       ///< n
    double offset = 0.;                          ///< d

    /** Signed distance of a point in the box; its error is below 1e-15. */
    double
    distance(const Point<dim> &p) const
    {
      return normal * p + offset;
    }

    /** Whether the plane has a point in common with the box [-1, 1]. */
    bool meets_box() const;

    /** The same for any two planes with the same points: coefficients without
     * a common divisor, of which the first that is not zero is positive. */
    std::array<std::int64_t, dim + 1> key() const;
  };

  /** The plane through a point with a normal of any length but zero, rounded to
   * multiples of 2^-52. The plane must have a distance below 2 from the origin
   * (tested in Debug). */
  template <int dim>
  ExactPlane<dim> make_exact_plane(const Point<dim> &point,
                                   const Tensor<1, dim> &normal);

  /** The point in the box where as many planes meet as space has dimensions. */
  template <int dim>
  struct ExactVertex
  {
    Point<dim> x;                         ///< rounded
    double error = 0.;                    ///< of each coordinate, at most
    std::array<unsigned int, dim> planes; ///< indices into a list of planes
    int orientation = 0; ///< sign of the determinant of their normals
  };

  /** Where planes of a list meet. They must meet in one point of the box. */
  template <int dim>
  ExactVertex<dim> intersect(const std::vector<ExactPlane<dim>> &planes,
                             const std::array<unsigned int, dim> &indices);

  /** Side of a plane on which a vertex lies (-1, 0, +1), by integers alone. */
  template <int dim>
  int side_by_integers(const std::vector<ExactPlane<dim>> &planes,
                       const ExactVertex<dim> &vertex,
                       const unsigned int plane);

  /** Side by doubles alone; 0 where their error does not let them decide. */
  template <int dim>
  int
  side_by_doubles(const ExactPlane<dim> &plane, const ExactVertex<dim> &vertex)
  {
    // (the sum of the absolute values of a unit normal is below 1.8)
    const double distance = plane.distance(vertex.x),
                 bound    = 1.8 * vertex.error + 1e-15;
    return distance > bound ? 1 : distance < -bound ? -1 : 0;
  }

  /** Side of plane @p plane of a list on which a vertex of planes of the same
   * list lies: -1, 0 (on the plane) or +1 (where its normal points to). */
  template <int dim>
  int
  side_of(const std::vector<ExactPlane<dim>> &planes,
          const ExactVertex<dim> &vertex,
          const unsigned int plane)
  {
    for (const unsigned int p : vertex.planes)
      if (p == plane)
        return 0;
    const int side = side_by_doubles(planes[plane], vertex);
    return side != 0 ? side : side_by_integers(planes, vertex, plane);
  }
} // namespace Keyblock

#endif
