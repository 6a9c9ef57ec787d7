// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/angle.h>
#include <keyblock/law/coulomb_joint.h>
#include <keyblock/law/dilation.h>

#include <cmath>

namespace Keyblock
{
  namespace
  {
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
        , dilation(entries)
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
        strength.dilation_tangent = dilation.tangent_at(state.history.slip);
        return strength;
      }

      bool
      has_memory() const override
      {
        return dilation.is_any();
      }

      JointHistory
      advance(JointHistory history,
              const double slip,
              const double /*pressure*/) const override
      {
        return dilation.advance(history, slip);
      }

    private:
      double static_tangent, kinetic_tangent;               ///< tan(phi) [-]
      double cohesion, residual_cohesion, tensile_strength; ///< [Pa]
      Dilation dilation;
    };
  } // namespace



  JointLawKind
  coulomb_joint()
  {
    return {"coulomb",
            "constant friction and cohesion, and dilation up to a slip",
            dilation_entries(),
            [](const JointStrength &entries, const std::string &) {
              return std::make_shared<const CoulombJoint>(entries);
            }};
  }
} // namespace Keyblock
