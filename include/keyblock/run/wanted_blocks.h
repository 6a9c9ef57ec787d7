// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_run_wanted_blocks_h
#define keyblock_run_wanted_blocks_h

#include <keyblock/blocks/blocks.h>
#include <keyblock/blocks/interface.h>

#include <string>
#include <vector>

namespace Keyblock
{
  /** Throw InputError if @p wanted, which is Safety factor/Blocks, names a
   * block that is none, or cannot move. */
  template <int dim>
  void check_wanted_blocks(const std::string &wanted,
                           const Blocks<dim> &blocks);

  /** Wanted blocks that have no factor at the end of a stage, because they are
   * one with rock that a later stage digs then, as sentences. */
  template <int dim>
  std::vector<std::string>
  warnings_of_attached_blocks(const Scene<dim> &scene,
                              const SplitMesh<dim> &split,
                              const Blocks<dim> &blocks);
} // namespace Keyblock

#endif
