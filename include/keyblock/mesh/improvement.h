// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_mesh_improvement_h
#define keyblock_mesh_improvement_h

#include <keyblock/mesh/simplex_mesh.h>

#include <random>
#include <utility>
#include <vector>

namespace Keyblock
{
  /**
   * Mends the worst cells of a simplex mesh: flips and removals of edges,
   * collapses and moves of vertices, each done only if the least quality of
   * the cells concerned rises (SimplexMesh::quality). Vertices stay on the
   * surfaces that they are bound to, marked facets stay facets of the mesh,
   * and the surfaces of the model stay exact; those of joints may bend by
   * a bounded part of the target size. The same mesh gives the same result on
   * every machine (Klingner and Shewchuk 2007 describe the operations).
   */
  template <int dim>
  class MeshImprovement
  {
  public:
    using CellVertices = typename SimplexMesh<dim>::CellVertices;
    using Facet        = typename SimplexMesh<dim>::Facet;
    using Mark         = typename SimplexMesh<dim>::Mark;

    /** @p allowed_bend: how far a collapse may lead the surface of a joint off
     * a vertex that goes, over the target size [-]. */
    MeshImprovement(SimplexMesh<dim> &mesh, const double allowed_bend);

    /** Work on cells below @p wanted_quality, from number @p first_cell on,
     * the worst first, in up to @p n_passes passes. */
    void improve(const double wanted_quality,
                 const unsigned int n_passes,
                 const unsigned int first_cell = 0);

    /** The same, but vertices, other than those in @p fixed, may also leave the
     * planes of their joints, as far as @p allowed_bend (over the target size)
     * in all [-]. */
    void improve_by_bending(const double wanted_quality,
                            const unsigned int n_passes,
                            const double allowed_bend,
                            const std::vector<unsigned int> &fixed);

    /** Put vertices back into the planes of their joints where no cell falls
     * below @p least_quality for it (or all around become better). */
    void flatten(const double least_quality);

    /** The same of some @p vertices. */
    void flatten(const double least_quality,
                 const std::vector<unsigned int> &vertices);

  private:
    /** An operation counts as better if the quality rises by this factor. */
    static constexpr double gain = 1.001;

    bool mend(const unsigned int cell);

    // by moving a vertex
    bool smooth(const unsigned int vertex);
    Tensor<1, dim> away_from(const unsigned int cell,
                             const unsigned int vertex) const;
    Tensor<1, dim> random_direction();

    // by joining two vertices
    bool collapse(const unsigned int gone, const unsigned int kept);
    bool is_better_without(const unsigned int gone,
                           const unsigned int kept) const;
    bool keeps_topology(const unsigned int gone, const unsigned int kept) const;
    bool keeps_surfaces(const unsigned int gone, const unsigned int kept) const;
    bool keeps_area(const unsigned int gone,
                    const unsigned int kept,
                    const unsigned int surface) const;
    bool merges_marks(const unsigned int gone, const unsigned int kept) const;
    void merge(const unsigned int gone, const unsigned int kept);

    // by other cells between the same vertices
    bool flip_in_2d(const unsigned int cell);
    bool remove_edge(const unsigned int a, const unsigned int b);
    std::vector<unsigned int>
    ring_around(const unsigned int a,
                const unsigned int b,
                const std::vector<unsigned int> &cells) const;
    bool exchange_facet(const unsigned int cell);

    /** The marked facets at a vertex with their marks, ascending. */
    std::vector<std::pair<Facet, std::vector<Mark>>>
    marks_at(const unsigned int vertex) const;

    /** Put one vertex back into the planes of its joints, see flatten(). */
    void flatten_at(const unsigned int vertex, const double least_quality);

    /** Whether a vertex is no farther from its joints than it may be. */
    bool is_near_its_joints(const unsigned int vertex) const;

    SimplexMesh<dim> &mesh;
    double allowed_bend;
    std::vector<bool> may_leave_joints; ///< by vertex; empty: none may
    std::mt19937 bits;
  };
} // namespace Keyblock

#endif
