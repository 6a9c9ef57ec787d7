// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_blocks_bolt_pattern_h
#define keyblock_blocks_bolt_pattern_h

#include <keyblock/blocks/ground.h>

namespace Keyblock
{
  /**
   * Heads and ends of the bolts of a pattern, @p index in Scene::bolts, on the
   * free faces of its excavations: in 2D along their outline, in 3D along the
   * outlines of sections across their axis. Throws InputError if there is no
   * place for any.
   */
  template <int dim>
  std::vector<Bolt<dim>> set_out_pattern(const BoltSet<dim> &set,
                                         const unsigned int index,
                                         const Ground<dim> &ground);
} // namespace Keyblock

#endif
