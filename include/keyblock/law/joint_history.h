// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_law_joint_history_h
#define keyblock_law_joint_history_h

namespace Keyblock
{
  /** What a law remembers of a place on a joint, from step to step, also when
   * the place finds another partner, and in checkpoints. */
  struct JointHistory
  {
    double slip     = 0.; ///< length of the way slid so far [m]
    double dilation = 0.; ///< opening that slip has made so far [m]
    double damage   = 0.; ///< what a law makes of it [-]
  };
} // namespace Keyblock

#endif
