// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_blocks_block_measures_h
#define keyblock_blocks_block_measures_h

#include <keyblock/blocks/blocks.h>

namespace Keyblock
{
  /**
   * Measure the blocks as the planes of the scene bound them, whatever the cut
   * of joints into the mesh bent: fills Block::exact where a block of the mesh
   * and one between the planes have more than half of each other. A joint on
   * which only one of the two has a face has an area of zero for the other. On
   * meshes that are exact all of this is what the mesh has.
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
