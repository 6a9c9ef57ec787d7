// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_blocks_plane_extent_h
#define keyblock_blocks_plane_extent_h

#include <keyblock/blocks/convex_cells.h>

#include <utility>
#include <vector>

namespace Keyblock
{
  /** A plane part of a joint: all of it, or a facet of one that is bent. */
  template <int dim>
  struct JointPiece
  {
    enum class Shape
    {
      unbounded,
      disc,   ///< in 2D a segment
      polygon ///< convex; in 2D a segment
    };
    unsigned int joint = 0; ///< index; pieces of one joint have the same
    Shape shape        = Shape::unbounded;
    Point<dim> point;      ///< on the plane; centre of a disc [m]
    Tensor<1, dim> normal; ///< of any length, from the minus to the plus side
    double radius = 0.;    ///< of a disc [m]
    std::vector<Point<dim>> corners; ///< on the plane, around a polygon [m]
  };

  /** Whether a polygon, in 2D a segment, is not wider than @p width: twice its
   * area over its perimeter is not larger, in 2D its length. */
  template <int dim>
  bool is_narrow(const std::vector<Point<dim>> &polygon, const double width);

  /** Area of a plane polygon, in 2D the length of a segment. */
  template <int dim>
  double
  area_of_outline(const std::vector<Point<dim>> &corners)
  {
    if constexpr (dim == 2)
      return corners[0].distance(corners[1]);
    else
      {
        Tensor<1, dim> sum;
        for (unsigned int i = 2; i < corners.size(); ++i)
          sum += cross_product_3d(corners[i - 1] - corners[0],
                                  corners[i] - corners[0]);
        return 0.5 * sum.norm();
      }
  }

  /**
   * How far a piece of a joint reaches in its plane, in the units of
   * ConvexCells. It reaches beyond its rim by @p bridging. Answers are those of
   * doubles; where nothing else is said they are right but within 1e-12 of the
   * rim, where they are yes.
   */
  template <int dim>
  class PlaneExtent
  {
  public:
    /** @param bridging [m] */
    PlaneExtent(const JointPiece<dim> &piece,
                const ConvexCells<dim> &cells,
                const double bridging);

    unsigned int joint = 0;
    typename ConvexCells<dim>::PlaneSide plane;
    double tolerance; ///< by which it reaches beyond its rim

    /** Whether it has points within the box of the domain, as far as one can
     * tell from a box around it. */
    bool meets_box() const;

    /** Radius of a sphere that holds it; 1e300 if it is unbounded. */
    double
    size() const
    {
      return is_unbounded ? 1e300 : radius;
    }

    /** Whether it has points on a side (-1, +1) of a plane. */
    bool reaches(const ExactPlane<dim> &other, const int side) const;

    /** Whether it overlaps the convex hull of points on its plane. May say yes
     * where the hull lies in a cell whose planes keep the extent out. */
    bool overlaps(const std::vector<Point<dim>> &section) const;

    /** Whether all corners of a polygon on its plane lie in it. */
    bool covers(const std::vector<Point<dim>> &polygon) const;

    /** Whether two extents have common points; yes if they are near and nearly
     * parallel. */
    bool crosses(const PlaneExtent &other, const ConvexCells<dim> &cells) const;

    /** Half planes (3D) or rays (2D) that bound it within its plane, by outward
     * normal and offset. Of a disc: those of a polygon within it. */
    std::vector<std::pair<Tensor<1, dim>, double>> inner_rim() const;

    /** The box around it along the first axis. */
    double
    lowest_x() const
    {
      return low[0];
    }
    double
    highest_x() const
    {
      return high[0];
    }

  private:
    void make_rim();
    void make_box();
    std::pair<double, double> interval(const Point<dim> &p,
                                       const Tensor<1, dim> &u) const;

    bool is_unbounded, is_disc; // (in 2D discs are segments)
    Tensor<1, dim> normal;
    Point<dim> center;
    double radius = 0.;   ///< around the center
    Point<dim> low, high; ///< corners of the box around it
    std::vector<Point<dim>> corners;
    std::vector<std::pair<Tensor<1, dim>, double>> rim; ///< of a polygon
  };

  /** Whether extents on one plane cover a polygon together, but for parts that
   * are_narrow(). Discs count as polygons within them, unless one covers all.
   */
  template <int dim>
  bool cover_together(const std::vector<const PlaneExtent<dim> *> &extents,
                      const std::vector<Point<dim>> &polygon,
                      const double narrow);
} // namespace Keyblock

#endif
