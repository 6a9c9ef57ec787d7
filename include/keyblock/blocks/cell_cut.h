// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_blocks_cell_cut_h
#define keyblock_blocks_cell_cut_h

#include <keyblock/blocks/convex_cells.h>

#include <array>
#include <vector>

namespace Keyblock
{
  /** Number of edges of a facet: its corners are a loop, in 2D two ends. */
  template <int dim>
  unsigned int
  n_edges(const unsigned int n_corners)
  {
    return dim == 2 ? 1 : n_corners;
  }

  /** Set the box around a cell. */
  template <int dim>
  void fit_box(typename ConvexCells<dim>::Cell &cell);

  /** A cell that is being cut into two. */
  template <int dim>
  class CellCut
  {
  public:
    using Cells  = ConvexCells<dim>;
    using Corner = typename Cells::Cell::LoopCorner;

    /** @param signs of the cell's vertices: sides of the plane */
    CellCut(const typename Cells::Cell &cell,
            const std::vector<ExactPlane<dim>> &planes,
            const std::vector<int> &signs,
            const unsigned int plane)
      : cell(cell)
      , planes(planes)
      , signs(signs)
      , plane(plane)
      , points(cell.vertices)
    {
      for (auto &part : parts)
        {
          part.facets.reserve(cell.facets.size() + 1);
          part.loops.reserve(cell.loops.size() + 12);
        }
      for (const auto &facet : cell.facets)
        divide(facet);
    }

    /** Add the section to both parts as a facet that a node has made. */
    void close(const unsigned int node);

    std::array<typename Cells::Cell, 2> parts; // minus, plus

  private:
    bool
    lies_on_plane(const unsigned int point) const
    {
      return point >= signs.size() || signs[point] == 0;
    }

    void divide(const typename Cells::Facet &facet);
    void add_facet(const unsigned int part,
                   const typename Cells::Facet &facet,
                   const std::vector<Corner> &loop);
    unsigned int crossing(const unsigned int v,
                          const unsigned int w,
                          const unsigned int facet_plane,
                          const unsigned int edge);

    const typename Cells::Cell &cell;
    const std::vector<ExactPlane<dim>> &planes;
    const std::vector<int> &signs;
    const unsigned int plane;
    std::vector<ExactVertex<dim>> points; // vertices, then crossings

    struct Crossing
    {
      unsigned int v, w, point;
    };
    std::vector<Crossing> crossings;

    /** Edges of the section of the plus part. In 2D the section is one. */
    struct SectionEdge
    {
      unsigned int from, to, plane;
    };
    std::vector<SectionEdge> section;

    std::array<std::vector<Corner>, 2> loop; // of a facet, on both sides
  };

  /** Parts polygons (in 2D segments) by planes, as fast as memory that is kept
   * allows. */
  template <int dim>
  class PolygonCut
  {
  public:
    using Polygon = typename ConvexCells<dim>::Polygon;

    /** Part a polygon on plane @p own_plane of a list by another one. Returns
     * whether it lies on both sides; then the part on the plus side stays, and
     * the other one is in `minus`. If not, `side` is that on which it lies. */
    bool cut(const std::vector<ExactPlane<dim>> &planes,
             const unsigned int own_plane,
             const unsigned int plane,
             Polygon &polygon);

    Polygon minus;
    int side = 0;

  private:
    Polygon plus;
    std::vector<int> signs;
  };
} // namespace Keyblock

#endif
