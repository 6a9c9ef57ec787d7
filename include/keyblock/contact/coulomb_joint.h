// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_contact_coulomb_joint_h
#define keyblock_contact_coulomb_joint_h

#include <keyblock/contact/joint_law.h>

namespace Keyblock
{
  /**
   * Mohr-Coulomb with a tension cut-off. Intact: peak cohesion and tensile
   * strength. Slid: residual cohesion. Opened: friction alone.
   */
  class CoulombJoint : public JointLaw
  {
  public:
    CoulombJoint(const JointStrength &entries);

    StrengthEnvelope envelope(const JointPointState &state) const override;

  private:
    double static_tangent, kinetic_tangent;               ///< tan(phi) [-]
    double cohesion, residual_cohesion, tensile_strength; ///< [Pa]
  };
} // namespace Keyblock

#endif
