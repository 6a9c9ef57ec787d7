// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_blocks_block_measures_h
#define keyblock_blocks_block_measures_h

#include <keyblock/blocks/blocks.h>

namespace Keyblock
{
  /**
   * Measure the blocks as their planes bound them, whatever the cut of joints
   * into the mesh bent: fills Block::exact.
   *
   * Between infinite joints and plane outlines a block is the convex body that
   * the planes leave around its centroid (PlaneArrangement), whatever corners
   * the mesh has lost: of a joint that cuts one off, and has no face of the
   * block in the mesh, Measures::joint_area has the area and
   * Measures::bent_area zero. Of other blocks the mesh says which planes meet
   * in which vertices of their surface; moved to where these planes intersect,
   * the faces become plane and the volume follows from the divergence theorem.
   * A block whose surface is not made of planes alone, with a vertex at which
   * more planes meet in the mesh than in space, or that a joint goes through,
   * gets none. On meshes that are exact all of this is what the mesh has.
   */
  template <int dim>
  void measure_exactly(Blocks<dim> &blocks,
                       const Mesh<dim> &mesh,
                       const Scene<dim> &scene);

  /** Volume between the planes, if it is known, or else that of the mesh
   * [m^dim]. */
  template <int dim>
  double
  best_volume(const Block<dim> &block)
  {
    return block.exact.is_known ? block.exact.volume : block.volume;
  }

  /** Weight of a mass in the scene, at its origin and time zero; in a scene
   * without gravity standard gravity [m/s2]. */
  template <int dim>
  double weight_per_mass(const Scene<dim> &scene);
} // namespace Keyblock

#endif
