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
   * The mesh says which planes meet in which vertices of a block's surface;
   * moved to where these planes intersect, the faces become plane and the
   * volume follows from the divergence theorem. A block whose surface is not
   * made of planes alone, or with a vertex at which more planes meet in the
   * mesh than in space, gets none. On meshes that are exact all of this is what
   * the mesh has.
   */
  template <int dim>
  void measure_exactly(Blocks<dim> &blocks, const Mesh<dim> &mesh);

  /** Weight of a mass in the scene, at its origin and time zero; in a scene
   * without gravity standard gravity [m/s2]. */
  template <int dim>
  double weight_per_mass(const Scene<dim> &scene);
} // namespace Keyblock

#endif
