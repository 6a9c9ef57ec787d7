// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_blocks_plane_mesh_h
#define keyblock_blocks_plane_mesh_h

#include <keyblock/blocks/interface.h>
#include <keyblock/blocks/plane_blocks.h>

namespace Keyblock
{
  /**
   * The rock between planes as a mesh, for all that needs surfaces, volumes
   * and places of blocks: weights, faces, free faces, bolts. It has a pyramid
   * (in 2D a triangle) from the middle of each convex cell to each
   * quadrilateral part of what it touches. Those are cells whose last vertices
   * coincide, with the part as face 4 (in 2D 2); all other faces lie within
   * the convex cell, and have the pyramid itself for a neighbour. Joints part
   * cells as in any split mesh, but there are no pairs. Rock that is gone from
   * the start is left out.
   */
  template <int dim>
  SplitMesh<dim> make_plane_mesh(const PlaneBlocks<dim> &planes,
                                 const Scene<dim> &scene);

  /** The blocks of such a mesh, in the order of @p planes, with mass and width,
   * and rigid blocks told from others. */
  template <int dim>
  Blocks<dim> list_plane_blocks(const PlaneBlocks<dim> &planes,
                                const Scene<dim> &scene,
                                const SplitMesh<dim> &split);
} // namespace Keyblock

#endif
