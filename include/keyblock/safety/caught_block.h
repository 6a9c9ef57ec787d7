// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_safety_caught_block_h
#define keyblock_safety_caught_block_h

#include <keyblock/blocks/free_faces.h>
#include <keyblock/contact/contact.h>

namespace Keyblock
{
  /** A block has left its place when it has moved by this fraction of its size,
   * and by this multiple of its compression by its load [-]. */
  constexpr double size_of_place = 1e-3, compressions_of_place = 50.;

  /**
   * Whether a block (by index) has left its place and now lies on faces that it
   * does not touch there: those of other joints, and free ones. Neither its
   * joints nor its support have held it, whatever catches it.
   * @param time of the run [s]
   * @param distance by which it has moved against the rock around it [m]
   * @param load its own [N]
   * @param sums ContactReport::sum_over_block() of it
   */
  template <int dim>
  bool is_caught_elsewhere(const Ground<dim> &ground,
                           const Blocks<dim> &blocks,
                           const unsigned int block,
                           const double time,
                           const double distance,
                           const double load,
                           const std::vector<JointSums<dim>> &sums);
} // namespace Keyblock

#endif
