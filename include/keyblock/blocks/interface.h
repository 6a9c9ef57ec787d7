// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_blocks_interface_h
#define keyblock_blocks_interface_h

#include <keyblock/blocks/blocks.h>
#include <keyblock/blocks/bolt.h>
#include <keyblock/blocks/laid_liner.h>

#include <memory>

namespace Keyblock
{
  /** Two nodes at one place on the two sides of a joint, or, without an area,
   * of two blocks that meet there on no joint and are held together by rock
   * that is excavated later. */
  template <int dim>
  struct Pair
  {
    unsigned int minus, plus; ///< vertices of the split mesh
    unsigned int joint;       ///< index into Scene::joints
    Tensor<1, dim> normal;    ///< unit, from minus to plus
    double area      = 0.;    ///< sums to the joint's area [m^(dim-1)]
    double face_size = 0.;    ///< of the largest face beside it [m]

    /** Sum of the mesh's nodal areas, as vectors from minus to plus: along the
     * normal but for faces that the mesh has bent [m^(dim-1)]. */
    Tensor<1, dim> area_vector;

    /** Excavation stage until which unexcavated rock welds it; 0: not welded.
     */
    unsigned int unwelding_stage = 0;

    /** Whether it is no more than welded: there is nothing in it after that. */
    bool
    is_tie() const
    {
      return area == 0.;
    }
  };

  /** A face of a joint with the cells on its two sides. */
  struct JointFace
  {
    unsigned int minus_cell, minus_face, plus_cell, plus_face, joint;
  };

  /** A face on the surface of a block after splitting. */
  template <int dim>
  struct SurfaceFace
  {
    typename Mesh<dim>::FaceVertices vertices; ///< outward by right-hand rule
    unsigned int cell, face;
    unsigned int block;
    unsigned int joint; ///< or `none`
  };

  /** Where blocks meet: the same on every rank. */
  template <int dim>
  struct Interface
  {
    std::vector<Pair<dim>> pairs;
    std::vector<JointFace> joint_faces;
    std::vector<SurfaceFace<dim>> surface;

    /** Groups of vertices that were one vertex before the split, only those
     * with a pair: first index into group_vertices, one more than groups. */
    std::vector<unsigned int> group_begin, group_vertices;

    /** Pairs of each group, the same way; pairs are sorted by group. */
    std::vector<unsigned int> group_pairs_begin;

    unsigned int
    n_groups() const
    {
      return group_begin.size() - 1;
    }
  };

  /** The mesh that is computed on: cells that are there at the start, nodes on
   * active joints duplicated. */
  template <int dim>
  struct SplitMesh
  {
    Mesh<dim> mesh;

    /** Index into Blocks::blocks; `none` for cells that are excavated later. */
    std::vector<unsigned int> block_of_cell;
    Interface<dim> interface;

    /** Vertices of smaller cells in the middle of larger ones' edges and faces;
     * they carry no mass and are in no pair. */
    std::vector<HangingVertex> hanging;

    bool is_between_planes = false; ///< made by make_plane_mesh()

    /** The same rock as the planes of the scene bound it, with the same numbers
     * of blocks (make_plane_mesh()); null: the scene has no planes. */
    std::shared_ptr<const SplitMesh<dim>> between_planes;

    /** What limit equilibrium is asked of. */
    const SplitMesh<dim> &
    rigid() const
    {
      return between_planes ? *between_planes : *this;
    }

    std::vector<Bolt<dim>> bolts;       ///< of the scene, see lay_out_bolts()
    std::vector<LaidLiner<dim>> liners; ///< the same, see lay_out_liners()

    /** Call @p action(vertex, weight) for each vertex that carries what acts at
     * @p vertex: itself, or its masters if it hangs. */
    template <typename Action>
    void
    for_each_carrier(const unsigned int vertex, const Action &action) const
    {
      const auto found =
        std::lower_bound(hanging.begin(),
                         hanging.end(),
                         vertex,
                         [](const HangingVertex &h, const unsigned int v) {
                           return h.vertex < v;
                         });
      if (found == hanging.end() || found->vertex != vertex)
        action(vertex, 1.);
      else
        for (const auto &[master, weight] : found->masters)
          action(master, weight);
    }

    bool
    is_hanging(const unsigned int vertex) const
    {
      return std::binary_search(hanging.begin(),
                                hanging.end(),
                                HangingVertex{vertex, {}},
                                [](const auto &a, const auto &b) {
                                  return a.vertex < b.vertex;
                                });
    }
  };

  /**
   * Give every vertex one copy per cluster of cells around it that are joined
   * through faces on no active joint, and list the pairs this makes. The
   * copies of joint tips stay one vertex. Cells excavated before the first
   * stage are dropped; joints inside rock that is excavated later are welded,
   * and so are the pairs on its outline until it is excavated.
   */
  template <int dim>
  SplitMesh<dim> split_mesh(const Mesh<dim> &mesh,
                            const Blocks<dim> &blocks,
                            const Scene<dim> &scene);
} // namespace Keyblock

#endif
