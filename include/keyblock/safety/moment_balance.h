// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_safety_moment_balance_h
#define keyblock_safety_moment_balance_h

#include <keyblock/safety/block_faces.h>

namespace Keyblock
{
  /**
   * Whether forces of the @p faces on a block can balance @p forces, all others
   * that act on it, with their moments: at the corners of each face (its convex
   * hull), pressing, within the friction cone, and by cohesion along the face
   * as much as it has in all, with the strength of faces that are reduced
   * divided by @p factor. If they cannot, a rigid block does not stay. Solved
   * as non-negative least squares, whose columns are forces at the corners that
   * balance most of what is left.
   * @param at_most more that act, each as much as this or less: bolts
   * @param way which the block would take (unit vector, or zero): balances with
   * all friction against it are found without rounding
   */
  template <int dim>
  bool can_balance(const std::vector<BlockFace<dim>> &faces,
                   const std::vector<PointForce<dim>> &forces,
                   const std::vector<PointForce<dim>> &at_most,
                   const Tensor<1, dim> &way,
                   const double factor);
} // namespace Keyblock

#endif
