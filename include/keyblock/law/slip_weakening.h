// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_law_slip_weakening_h
#define keyblock_law_slip_weakening_h

#include <keyblock/law/joint_law.h>

namespace Keyblock
{
  /** Friction and cohesion that fall along straight lines with slip, from peak
   * to residual over a slip distance; tension as in coulomb_joint(). */
  JointLawKind slip_weakening_joint();

  /** The entry that this law shares with others. */
  JointLawEntry residual_friction_entry();
} // namespace Keyblock

#endif
