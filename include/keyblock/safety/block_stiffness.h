// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_safety_block_stiffness_h
#define keyblock_safety_block_stiffness_h

#include <keyblock/blocks/ground.h>

#include <algorithm>

namespace Keyblock
{
  /** Largest @p value_of(material) of a block's cells, zero without any. */
  template <int dim, typename Value>
  double
  largest_in_block(const Ground<dim> &ground,
                   const unsigned int block,
                   const Value &value_of)
  {
    const SplitMesh<dim> &split = ground.split;
    double largest              = 0.;
    for (unsigned int c = 0; c < split.mesh.n_cells(); ++c)
      if (split.block_of_cell[c] == block)
        largest =
          std::max(largest,
                   value_of(*ground.scene.materials[ground.material_of(c)]));
    return largest;
  }

  /** By how much @p load [N] compresses a block, if it goes through all of it:
   * W L^2 / (M V) with the P-wave modulus M [m]; zero of a rigid one.
   * @param block its index, @p shape its size and volume */
  template <int dim>
  double
  compression_of_block(const Ground<dim> &ground,
                       const unsigned int block,
                       const Block<dim> &shape,
                       const double load)
  {
    const double modulus =
      largest_in_block(ground, block, [](const Material<dim> &material) {
        return material.p_wave_modulus();
      });
    return modulus > 0.
             ? load * shape.size * shape.size / (modulus * shape.volume)
             : 0.;
  }
} // namespace Keyblock

#endif
