// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_mesh_simplex_mesh_h
#define keyblock_mesh_simplex_mesh_h

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <keyblock/mesh/surface.h>

#include <array>
#include <cstdint>
#include <limits>
#include <unordered_map>
#include <vector>

namespace Keyblock
{
  /**
   * Triangles (2D) or tetrahedra (3D) into which joints are cut: the cells, the
   * surfaces that facets lie on, and the operations that keep both consistent.
   *
   * A facet (2D: edge, 3D: triangle) that lies on surfaces carries a mark for
   * each; a vertex is bound to the surfaces of the marked facets around it.
   * Cells that were removed stay in the list and are not alive. All vertices
   * of a cell are in the order that gives a positive volume.
   */
  template <int dim>
  class SimplexMesh
  {
  public:
    static constexpr unsigned int n_cell_vertices = dim + 1;
    using CellVertices = std::array<unsigned int, dim + 1>;
    using Facet        = std::array<unsigned int, dim>; ///< sorted vertices

    struct Cell
    {
      CellVertices vertices;
      bool is_alive          = true;
      mutable double quality = unknown; ///< until a vertex moves
    };

    static constexpr double unknown = -std::numeric_limits<double>::infinity();

    /** That a facet lies on a surface. Its positive side is where the
     * right-hand normal of the sorted vertices points to (in 2D the left of the
     * way from the first to the second). */
    struct Mark
    {
      unsigned int surface;
      bool plus_is_positive; ///< the joint's plus side is the positive one
    };

    struct FacetHash
    {
      std::size_t
      operator()(const Facet &facet) const
      {
        std::uint64_t h = 1469598103934665603ull;
        for (const unsigned int v : facet)
          {
            h = (h ^ v) * 0x9E3779B97F4A7C15ull;
            h ^= h >> 29;
          }
        return h;
      }
    };

    std::vector<Surface<dim>> surfaces;
    std::vector<Point<dim>> vertices;
    std::vector<double> target_size; ///< wanted edge length at vertices [m]
    std::vector<bool> is_fixed;      ///< corners of the model
    std::vector<Cell> cells;
    std::unordered_map<Facet, std::vector<Mark>, FacetHash> marks;

    /** Surfaces that each vertex is bound to, by the marked facets. */
    std::vector<std::vector<unsigned int>> bound_to;

    /** Live cells around each vertex. */
    std::vector<std::vector<unsigned int>> cells_at;

    unsigned int add_vertex(const Point<dim> &p, const double size);
    unsigned int add_cell(const CellVertices &cell);
    void remove_cell(const unsigned int cell);

    /** Mark @p facet (sorted) and bind its vertices. */
    void add_mark(const Facet &facet, const Mark &mark);

    /** Bind vertices anew by the marks that are there. */
    void bind_vertices();

    bool
    has(const unsigned int cell, const unsigned int vertex) const
    {
      for (const unsigned int v : cells[cell].vertices)
        if (v == vertex)
          return true;
      return false;
    }

    bool is_bound(const unsigned int vertex, const unsigned int surface) const;

    /** The facet opposite to the cell's vertex number @p i. */
    Facet facet(const unsigned int cell, const unsigned int i) const;

    /** Whether the cell lies on the positive side of that facet. */
    bool is_on_positive_side(const unsigned int cell,
                             const unsigned int i) const;

    /** The live cell across that facet, or no_index. */
    unsigned int neighbor(const unsigned int cell, const unsigned int i) const;

    /** Live cells that hold both vertices. */
    std::vector<unsigned int> cells_at_edge(const unsigned int a,
                                            const unsigned int b) const;

    /** Volume (2D: area), negative if the cell is turned inside out [m^dim]. */
    double volume(const CellVertices &cell) const;

    /**
     * Quality of a cell [-]: its least altitude over that of a regular cell of
     * the target size, in 3D bounded by 1.5 times the least scaled Jacobian of
     * the four hexahedra it will be cut into; not positive if it is turned
     * inside out. It goes with the stable step. A value that is not above
     * @p bound may be too large.
     */
    double quality(const CellVertices &cell, const double bound = -1e300) const;

    /** The same of a cell of the mesh, computed once. */
    double quality_of(const unsigned int cell) const;

    /** Least quality of the cells around a vertex. */
    double least_quality_at(const unsigned int vertex) const;

    /** Cells with their qualities, the worst first: the move of a vertex that
     * is no use mostly shows there. */
    using Qualities = std::vector<std::pair<double, unsigned int>>;

    Qualities qualities_at(const unsigned int vertex) const;

    /** The qualities of these cells after a vertex moved; empty unless all are
     * above the least one of before. */
    Qualities better_qualities(const Qualities &before) const;

    void move(const unsigned int vertex, const Point<dim> &place);

    /** Orthonormal directions in which the vertex must not move: normals of
     * the surfaces it is bound to, those of the model first, and unless it
     * @p may_leave_joints those of joints. */
    std::vector<Tensor<1, dim>>
    locked_directions(const unsigned int v,
                      const bool may_leave_joints = false) const;

    /** @p direction without its part along locked directions. */
    static Tensor<1, dim>
    free_part(Tensor<1, dim> direction,
              const std::vector<Tensor<1, dim>> &locked)
    {
      for (const Tensor<1, dim> &n : locked)
        direction -= (direction * n) * n;
      return direction;
    }

    /** Put a vertex that is bound to circles back on them. */
    void return_to_circles(const unsigned int vertex);

    /** Bisect the edge a-b at @p p and with it all cells and marked facets
     * there; returns the new vertex. */
    unsigned int
    split_edge(const unsigned int a, const unsigned int b, const Point<dim> &p);

    /** @p facet with sorted vertices; sets @p is_odd if that took an odd number
     * of exchanges. */
    static Facet sorted(Facet facet, bool &is_odd);

    static Facet
    sorted(const Facet &facet)
    {
      bool is_odd;
      return sorted(facet, is_odd);
    }

    /** Marked facets in ascending order: the map's own depends on hashes. */
    std::vector<Facet> marked_facets() const;

    /** Move the marks of @p facet, with @p from replaced by @p to, there. */
    void rename_marks(const Facet &facet,
                      const std::vector<Mark> &list,
                      const unsigned int from,
                      const unsigned int to);

    Point<dim> center(const Facet &facet) const;

    /** Length (2D) or area (3D) of a facet [m^(dim-1)]. */
    double measure(const Facet &facet) const;

    /** Mean target size at the vertices of a cell or facet [m]. */
    template <typename Vertices>
    double
    size_at(const Vertices &list) const
    {
      double sum = 0.;
      for (const unsigned int v : list)
        sum += target_size[v];
      return sum / list.size();
    }
  };

  /** The edges (3D) or ends (2D) of a facet. */
  template <int dim, typename Action>
  void
  for_each_ridge(const typename SimplexMesh<dim>::Facet &facet,
                 const Action &action)
  {
    if constexpr (dim == 2)
      for (const unsigned int v : facet)
        action(std::array<unsigned int, 1>{{v}});
    else
      for (unsigned int i = 0; i < 3; ++i)
        action(std::array<unsigned int, 2>{
          {facet[i == 0 ? 1 : 0], facet[i == 2 ? 1 : 2]}});
  }
} // namespace Keyblock

#endif
