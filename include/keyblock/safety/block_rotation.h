// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_safety_block_rotation_h
#define keyblock_safety_block_rotation_h

#include <keyblock/safety/block_faces.h>

namespace Keyblock
{
  /** Where the line of the resultant of all that acts on a block that slides on
   * one plane passes its base, and what follows. */
  struct Rotation
  {
    bool is_judged = false; ///< one plane base, whose vertices are known
    double outside = 0.;    ///< distance from the base, 0: within it [m]

    /** In the plane: what keeps the block from turning about the end of its
     * base; empty: nothing. Not looked at in 3D. */
    std::string obstacle;

    /** The block turns at a lower factor than it slides at: above that no
     * forces on its faces balance the moment of what acts, see can_balance().
     */
    bool is_by_moments = false;
  };

  /**
   * A base that cannot pull carries no resultant whose line passes outside it,
   * whatever its strength. In the plane a rigid block then turns about the end
   * of the base nearest to that line, unless that closes another face, or
   * cohesion beside the base or tensile strength on it hold it; @p limit
   * becomes `rotating` with a factor of zero if nothing does. In 3D the
   * distance is that from the convex hull of the base and an indication only:
   * @p limit stays as it is.
   * @param forces all that act on the block, but for its neighbours
   */
  template <int dim>
  Rotation judge_rotation(const std::vector<BlockFace<dim>> &faces,
                          const std::vector<PointForce<dim>> &forces,
                          LimitEquilibrium<dim> &limit);
} // namespace Keyblock

#endif
