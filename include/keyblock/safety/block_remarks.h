// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_safety_block_remarks_h
#define keyblock_safety_block_remarks_h

#include <keyblock/safety/block_statics.h>

#include <string>

namespace Keyblock
{
  /** Add to @p statics of a block (index), which has all but them, the remarks:
   * what is special about its @p motion at @p time [s], and what was left out.
   */
  template <int dim>
  void add_remarks(const Ground<dim> &ground,
                   const FreeFaces<dim> &free,
                   const Blocks<dim> &blocks,
                   const unsigned int block,
                   const double time,
                   const SupportedMotion<dim> &motion,
                   BlockStatics<dim> &statics);

  /** Those on its support, and on what it asks for besides. */
  template <int dim>
  std::vector<std::string>
  list_support_remarks(const Ground<dim> &ground,
                       const Blocks<dim> &blocks,
                       const BlockStatics<dim> &statics);
} // namespace Keyblock

#endif
