// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_blocks_convex_cells_h
#define keyblock_blocks_convex_cells_h

#include <deal.II/base/bounding_box.h>

#include <keyblock/base/exact_sign.h>

#include <functional>
#include <map>
#include <utility>
#include <vector>

namespace Keyblock
{
  using dealii::BoundingBox;

  /** All points on one side of a plane; in 2D of a line. */
  template <int dim>
  struct HalfSpace
  {
    Point<dim> point;       ///< on the plane [m]
    Tensor<1, dim> outward; ///< normal of any length, away from the half space
  };

  /**
   * Convex cells that planes cut out of a convex domain. A cut goes through a
   * whole cell and leaves two convex cells; cells beside it stay as they are,
   * so that a face of a cell may have several neighbours. The cuts make a
   * binary tree: each node is a plane, its branches lead to the cells on both
   * sides.
   *
   * A vertex is the planes that meet there. On which side of another plane it
   * lies is decided without error (side_of()), and nothing else decides how
   * cells are cut and which ones touch. In 2D planes are lines, and facets are
   * edges of two corners.
   *
   * Coordinates within the class have no unit: the domain lies in the box
   * [-1, 1] (to_unit()). Planes are rounded to multiples of 2^-52 there.
   */
  template <int dim>
  class ConvexCells
  {
  public:
    /** What is not there, in place of an index. */
    static constexpr unsigned int nothing =
      dealii::numbers::invalid_unsigned_int;

    /** A plane of the list, and whether its normal is that which was asked for
     * (+1) or the opposite (-1). If the plane does not meet the box around the
     * domain: `nothing`, and the side of it on which the domain lies. */
    struct PlaneSide
    {
      unsigned int plane;
      int side;
    };

    struct Facet
    {
      unsigned int plane;
      int side;                 ///< of the plane on which the cell lies: -1, +1
      unsigned int node;        ///< of the tree, whose cut made it; or nothing
      unsigned int domain_side; ///< on which it lies; or nothing
      unsigned int begin, size; ///< its corners in Cell::loops
    };

    /** Facets go around their corners counterclockwise as seen from outside; in
     * 2D the cell is to the left. */
    struct Cell
    {
      struct LoopCorner
      {
        unsigned int vertex;
        unsigned int edge; ///< a plane through the edge to the next one (3D)
      };
      std::vector<ExactVertex<dim>> vertices;
      std::vector<Facet> facets;
      std::vector<LoopCorner> loops;
      Point<dim> low, high; ///< corners of the box around it
    };

    struct Corner
    {
      ExactVertex<dim> vertex;
      unsigned int edge; ///< a plane through the edge to the next one (3D)
    };
    using Polygon = std::vector<Corner>; ///< in 2D two ends

    /** Where two cells touch. */
    struct Contact
    {
      unsigned int plane;
      unsigned int minus, plus; ///< cells on both sides of the plane
      const Polygon &polygon;
    };

    struct Measures
    {
      double volume;       ///< [m^dim]
      Point<dim> centroid; ///< [m]
    };

    /** One cell: a box [m]. Sides are numbered as faces of a cell of deal.II.
     */
    explicit ConvexCells(const BoundingBox<dim> &box);

    /** One cell: what half spaces leave of a box [m] that is larger. Its sides
     * have the numbers of the half spaces. Throws InputError if nothing is left
     * or a side of the box is. */
    ConvexCells(const BoundingBox<dim> &box,
                const std::vector<HalfSpace<dim>> &sides);

    Point<dim>
    to_unit(const Point<dim> &p) const
    {
      return Point<dim>((p - center) / unit_length);
    }

    Point<dim>
    to_metres(const Point<dim> &x) const
    {
      return center + unit_length * x;
    }

    /** Length of the unit [m]. */
    double
    length() const
    {
      return unit_length;
    }

    /** Add a plane through a point [m] to the list, if there is none yet that
     * is not farther from it than @p near anywhere in the domain [m]. */
    PlaneSide add_plane(const Point<dim> &point,
                        const Tensor<1, dim> &normal,
                        const double near = 0.);

    const ExactPlane<dim> &
    plane(const unsigned int i) const
    {
      return planes[i];
    }

    unsigned int
    n_planes() const
    {
      return planes.size();
    }

    const Cell &
    cell(const unsigned int i) const
    {
      return cells[i];
    }

    unsigned int
    n_cells() const
    {
      return cells.size();
    }

    /** Side of a plane on which a cell lies: -1, +1; 0 if it lies on both. */
    int side_of_cell(const unsigned int cell, const unsigned int plane);

    /** Cut a cell, if it lies on both sides of the plane. It becomes the part
     * on the plus side. Returns the index of the other part, or `nothing`. */
    unsigned int cut_cell(const unsigned int cell, const unsigned int plane);

    /** Cut the cells for which @p where is true. Where has three functions,
     * that may say yes when in doubt:
     * - `bool reaches(const ExactPlane<dim> &plane, int side)`: whether it has
     *   points on a side of a plane;
     * - `bool enters(unsigned int cell)`: whether the cell may be cut at all;
     * - `bool overlaps(const std::vector<Point<dim>> &section)`: whether it
     *   overlaps the convex hull of points on the plane, in units. */
    template <typename Where>
    void cut(const unsigned int plane, const Where &where);

    /** Call a function with all pairs of cells that have a polygon (in 2D a
     * segment) between them, in the order of the cuts. */
    void
    for_each_contact(const std::function<void(const Contact &)> &visit) const;

    /** The cell with a point [m] of the domain, or one of those that touch it
     * there. */
    unsigned int cell_at(const Point<dim> &point) const;

    Measures measures(const unsigned int cell) const;

    /** Corners of a facet. */
    Polygon
    polygon_of(const Cell &cell, const Facet &facet) const
    {
      Polygon polygon;
      get_polygon(cell, facet, polygon);
      return polygon;
    }

  private:
    /** Branches are nodes, or ~cell. */
    struct Node
    {
      unsigned int plane;
      int minus, plus;
    };

    void set_up(const BoundingBox<dim> &box,
                const std::vector<HalfSpace<dim>> &sides);
    void make_box();
    void fit_domain(const std::vector<HalfSpace<dim>> &sides);
    std::vector<Point<dim>> section(const Cell &cell,
                                    const unsigned int plane) const;
    void
    get_polygon(const Cell &cell, const Facet &facet, Polygon &polygon) const;
    void split(const unsigned int index, const unsigned int plane);
    Point<dim> center;       ///< of the box [m]
    double unit_length = 1.; ///< [m]
    std::vector<ExactPlane<dim>> planes;
    std::map<std::array<std::int64_t, dim + 1>, unsigned int> plane_of_key;
    std::vector<Cell> cells;
    std::vector<Node> nodes;

    /** Where each cell hangs in the tree: node, whether on its plus side. */
    std::vector<std::pair<unsigned int, bool>> branch_of_cell;

    std::vector<int> signs; ///< of the vertices of the cell last asked for
  };



  template <int dim>
  template <typename Where>
  void
  ConvexCells<dim>::cut(const unsigned int plane, const Where &where)
  {
    std::vector<unsigned int> reached;
    std::vector<int> branches(1, nodes.empty() ? ~0 : 0);
    while (!branches.empty())
      {
        const int branch = branches.back();
        branches.pop_back();
        if (branch < 0)
          reached.push_back(~branch);
        else
          {
            const Node &node = nodes[branch];
            if (where.reaches(planes[node.plane], -1))
              branches.push_back(node.minus);
            if (where.reaches(planes[node.plane], +1))
              branches.push_back(node.plus);
          }
      }
    for (const unsigned int c : reached)
      if (where.enters(c) && side_of_cell(c, plane) == 0 &&
          where.overlaps(section(cells[c], plane)))
        split(c, plane);
  }
} // namespace Keyblock

#endif
