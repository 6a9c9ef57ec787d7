// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_safety_standing_block_h
#define keyblock_safety_standing_block_h

#include <keyblock/safety/block_support.h>
#include <keyblock/safety/limit_equilibrium.h>

#include <set>

namespace Keyblock
{
  /**
   * Whether a block on @p faces is seated: the line of the resultant of
   * @p forces passes between the vertices of those that it is @p pressed on
   * (indices), seen along that line, and clearly so.
   */
  template <int dim>
  bool is_seated(const std::vector<BlockFace<dim>> &faces,
                 const std::set<unsigned int> &pressed,
                 const std::vector<PointForce<dim>> &forces);

  /** Whether @p block (index) stays where it is at @p time [s] without any that
   * have gone from @p ground, by limit equilibrium: at a factor clearly above
   * 1, and seated. */
  template <int dim>
  bool stands_alone(const Ground<dim> &ground,
                    const FreeFaces<dim> &free,
                    const Blocks<dim> &blocks,
                    const unsigned int block,
                    const double time,
                    const BrokenSegments &broken);
} // namespace Keyblock

#endif
