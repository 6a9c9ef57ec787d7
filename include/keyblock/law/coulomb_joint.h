// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_law_coulomb_joint_h
#define keyblock_law_coulomb_joint_h

#include <keyblock/law/joint_law.h>

namespace Keyblock
{
  /** Mohr-Coulomb with a tension cut-off. Intact: peak cohesion and tensile
   * strength. Slid: residual cohesion. Opened: friction alone. */
  JointLawKind coulomb_joint();
} // namespace Keyblock

#endif
