// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_blocks_block_measures_h
#define keyblock_blocks_block_measures_h

#include <keyblock/blocks/plane_blocks.h>

namespace Keyblock
{
  /**
   * Number the blocks of a mesh like those between planes, and the other way
   * round. They are the same where each has more than half of the other, and
   * both are finite. The finite blocks between the planes come first, with what
   * the planes say of them in Block::exact and of when they are exposed; those
   * that the mesh has not have no cells. Other blocks of the mesh come after
   * them, and last what is infinite. Fills Blocks::comparison.
   * @param blocks of the mesh
   * @param exact of the planes, in their order
   * @param block_of_cell of a mesh between the planes: index into @p exact,
   * which becomes one into @p blocks
   */
  template <int dim>
  void number_like_planes(Blocks<dim> &blocks,
                          const Mesh<dim> &mesh,
                          const PlaneBlocks<dim> &planes,
                          const Blocks<dim> &exact,
                          std::vector<unsigned int> &block_of_cell);

  /** Weight of a mass in the scene, at its origin and time zero; in a scene
   * without gravity standard gravity [m/s2]. */
  template <int dim>
  double weight_per_mass(const Scene<dim> &scene);
} // namespace Keyblock

#endif
