// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_blocks_solid_parts_h
#define keyblock_blocks_solid_parts_h

#include <keyblock/blocks/convex_cells.h>
#include <keyblock/scene/solid.h>

#include <vector>

namespace Keyblock
{
  /** Convex bodies that together are a solid, each by its half spaces: itself
   * if it is convex, else the cells that the planes of its faces cut it into.
   * Empty if these do not give its volume. */
  std::vector<std::vector<HalfSpace<3>>> convex_parts(const Solid &solid);
} // namespace Keyblock

#endif
