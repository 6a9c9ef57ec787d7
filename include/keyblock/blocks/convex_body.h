// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_blocks_convex_body_h
#define keyblock_blocks_convex_body_h

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <utility>
#include <vector>

namespace Keyblock
{
  using dealii::Point;
  using dealii::Tensor;

  /** A convex polygon (2D) or polyhedron (3D) that planes are cut off from, one
   * after the other. */
  template <int dim>
  class ConvexBody
  {
  public:
    /** The name of the faces of the box that a body starts as. */
    static constexpr unsigned int of_box = static_cast<unsigned int>(-1);

    struct Face
    {
      unsigned int name; ///< of the plane that made it
      Tensor<1, dim> outward;
      std::vector<Point<dim>> corners; ///< two in 2D, around the face in 3D
    };

    /** A box. @param tolerance distance of a corner from a plane up to which it
     * counts as on it [m] */
    ConvexBody(const Point<dim> &low,
               const Point<dim> &high,
               const double tolerance);

    /** A triangle or tetrahedron. */
    ConvexBody(const std::array<Point<dim>, dim + 1> &corners,
               const double tolerance);

    /** Keep what lies behind a plane. Planes that leave all of it cut nothing
     * and make no face; one that leaves nothing empties the body.
     * @param outward its unit normal, out of what is kept */
    void cut(const Point<dim> &point,
             const Tensor<1, dim> &outward,
             const unsigned int name);

    /** Corners of the body on a plane, in 3D around the section; nothing if
     * fewer than dim. */
    std::vector<Point<dim>> section(const Point<dim> &point,
                                    const Tensor<1, dim> &normal) const;

    /** Least and greatest signed distance of the corners from a plane [m]. */
    std::pair<double, double> reach(const Point<dim> &point,
                                    const Tensor<1, dim> &normal) const;

    bool
    is_empty() const
    {
      return faces.size() <= dim;
    }

    /** Whether a point lies inside, not on the surface. */
    bool contains(const Point<dim> &p) const;

    double volume() const;       ///< [m^dim]
    Point<dim> centroid() const; ///< of the volume [m]

    static double area(const Face &face); ///< [m^(dim-1)]

    /** Area of the part of a convex face that lies in the body or on its
     * surface [m^(dim-1)]. */
    double area_inside(Face face) const;

    const std::vector<Face> &
    get_faces() const
    {
      return faces;
    }

    const double tolerance;

  private:
    std::vector<Face> faces;
  };
} // namespace Keyblock

#endif
