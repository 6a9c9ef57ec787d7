// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_blocks_mesh_fidelity_h
#define keyblock_blocks_mesh_fidelity_h

#include <keyblock/blocks/interface.h>

#include <string>
#include <vector>

namespace Keyblock
{
  /**
   * Warnings about finite blocks that a coarse mesh has changed, one sentence
   * each: faces that lie farther from their joint's plane than half the size of
   * their cell; exposed blocks that only the mesh or only the planes have;
   * volumes that differ by more than 2 % from those between the planes; curved
   * faces of solids; and masses, see warning_of_material_shares(). Empty: none.
   */
  template <int dim>
  std::vector<std::string> warnings_of_coarse_mesh(const Scene<dim> &scene,
                                                   const SplitMesh<dim> &split,
                                                   const Blocks<dim> &blocks);
} // namespace Keyblock

#endif
