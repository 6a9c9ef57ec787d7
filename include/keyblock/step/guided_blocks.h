// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_step_guided_blocks_h
#define keyblock_step_guided_blocks_h

#include <keyblock/base/communicator.h>
#include <keyblock/rock/fields.h>

namespace Keyblock
{
  /**
   * Blocks (by index) that supports move, or hold so that they cannot shift in
   * any direction: these do not come off, however far rock in them flows
   * (collective).
   * @param nodes of each block, those that this rank owns
   */
  template <int dim>
  std::vector<bool>
  mark_guided_blocks(const Fields<dim> &fields,
                     const std::vector<std::vector<unsigned int>> &nodes,
                     const Communicator &communicator);
} // namespace Keyblock

#endif
