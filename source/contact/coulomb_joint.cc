// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/contact/coulomb_joint.h>

#include <deal.II/base/numbers.h>

#include <cmath>

namespace Keyblock
{
  namespace
  {
    double
    tangent_of(const double degrees)
    {
      return std::tan(degrees * dealii::numbers::PI / 180.);
    }
  } // namespace



  CoulombJoint::CoulombJoint(const JointStrength &entries)
    : static_tangent(tangent_of(entries.friction_angle))
    , kinetic_tangent(entries.kinetic_friction_angle < 0.
                        ? static_tangent
                        : tangent_of(entries.kinetic_friction_angle))
    , cohesion(entries.cohesion)
    , residual_cohesion(entries.cohesion_of_sliding())
    , tensile_strength(entries.tensile_strength)
  {}



  StrengthEnvelope
  CoulombJoint::envelope(const JointPointState &state) const
  {
    StrengthEnvelope strength;
    strength.static_tangent  = static_tangent;
    strength.kinetic_tangent = kinetic_tangent;
    if (state.is_intact)
      {
        strength.cohesion         = cohesion;
        strength.tensile_strength = tensile_strength;
      }
    else if (!state.has_opened)
      strength.cohesion = residual_cohesion;
    return strength;
  }
} // namespace Keyblock
