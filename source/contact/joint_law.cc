// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/contact/joint_law.h>

#include <keyblock/contact/coulomb_joint.h>

namespace Keyblock
{
  PointStrength
  StrengthEnvelope::of_point(const double share,
                             const double area,
                             const double kick) const
  {
    PointStrength strength;
    strength.static_friction  = share * static_tangent;
    strength.kinetic_friction = share * kinetic_tangent;
    strength.cohesion         = share * cohesion * area * kick;
    strength.tension          = share * tensile_strength * area * kick;
    return strength;
  }



  std::shared_ptr<const JointLaw>
  make_joint_law(const JointStrength &entries)
  {
    return std::make_shared<CoulombJoint>(entries);
  }



  std::shared_ptr<const JointLaw>
  make_friction_law(const double angle)
  {
    JointStrength entries;
    entries.friction_angle = angle;
    return make_joint_law(entries);
  }
} // namespace Keyblock
