// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_blocks_material_shares_h
#define keyblock_blocks_material_shares_h

#include <keyblock/blocks/interface.h>

#include <string>

namespace Keyblock
{
  /** Warning of finite blocks whose mass differs by more than half a percent
   * from that of the regions of their materials, as a cell has the material at
   * its centre: one sentence, empty if there are none. Regions count at the
   * middles of many parts of each cell that a boundary crosses. */
  template <int dim>
  std::string warning_of_material_shares(const Scene<dim> &scene,
                                         const SplitMesh<dim> &split,
                                         const Blocks<dim> &blocks);
} // namespace Keyblock

#endif
