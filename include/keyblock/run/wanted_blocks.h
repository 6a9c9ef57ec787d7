// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_run_wanted_blocks_h
#define keyblock_run_wanted_blocks_h

#include <keyblock/blocks/blocks.h>

#include <string>

namespace Keyblock
{
  /** Throw InputError if @p wanted, which is Safety factor/Blocks, names a
   * block that is none, or cannot move. */
  template <int dim>
  void check_wanted_blocks(const std::string &wanted,
                           const Blocks<dim> &blocks);
} // namespace Keyblock

#endif
