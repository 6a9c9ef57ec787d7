// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/law/coulomb_joint.h>

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

    class CoulombJoint : public JointLaw
    {
    public:
      CoulombJoint(const JointStrength &entries)
        : static_tangent(tangent_of(entries.friction_angle))
        , kinetic_tangent(entries.kinetic_friction_angle < 0.
                            ? static_tangent
                            : tangent_of(entries.kinetic_friction_angle))
        , cohesion(entries.cohesion)
        , residual_cohesion(entries.cohesion_of_sliding())
        , tensile_strength(entries.tensile_strength)
      {}

      StrengthEnvelope
      envelope(const JointPointState &state) const override
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

    private:
      double static_tangent, kinetic_tangent;               ///< tan(phi) [-]
      double cohesion, residual_cohesion, tensile_strength; ///< [Pa]
    };
  } // namespace



  JointLawKind
  coulomb_joint()
  {
    return {"coulomb",
            "constant friction and cohesion",
            {},
            [](const JointStrength &entries, const std::string &) {
              return std::make_shared<const CoulombJoint>(entries);
            }};
  }
} // namespace Keyblock
