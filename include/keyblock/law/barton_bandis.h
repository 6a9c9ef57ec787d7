// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_law_barton_bandis_h
#define keyblock_law_barton_bandis_h

#include <keyblock/law/joint_law.h>

namespace Keyblock
{
  /**
   * Rough joints: tau = s tan(phi_r + JRC log10(JCS / s)) under the normal
   * stress s, the angle being at most 70 degrees and at least phi_r (Barton and
   * Choubey 1977). With a joint length, JRC and JCS are those of 0.1 m scaled
   * to it (Barton and Bandis 1982).
   */
  JointLawKind barton_bandis_joint();
} // namespace Keyblock

#endif
