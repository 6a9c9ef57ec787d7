// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/angle.h>
#include <keyblock/base/errors.h>
#include <keyblock/base/number_text.h>
#include <keyblock/law/dilation.h>
#include <keyblock/law/slip_weakening.h>

#include <algorithm>
#include <limits>

namespace Keyblock
{
  namespace
  {
    class SlipWeakening : public JointLaw
    {
    public:
      SlipWeakening(const JointStrength &entries)
        : peak_tangent(tangent_of(entries.friction_angle))
        , residual_tangent(
            tangent_of(entries.value_of("Residual friction angle")))
        , peak_cohesion(entries.cohesion)
        , residual_cohesion(entries.cohesion_of_sliding())
        , tensile_strength(entries.tensile_strength)
        , distance(entries.value_of("Slip distance"))
        , dilation(entries)
      {}

      StrengthEnvelope
      envelope(const JointPointState &state) const override
      {
        const double done = std::min(1., state.history.slip / distance);
        StrengthEnvelope strength;
        strength.static_tangent = strength.kinetic_tangent =
          peak_tangent + done * (residual_tangent - peak_tangent);
        if (!state.has_opened)
          strength.cohesion =
            peak_cohesion + done * (residual_cohesion - peak_cohesion);
        if (state.is_intact)
          strength.tensile_strength = tensile_strength;
        strength.dilation_tangent = dilation.tangent_at(state.history.slip);
        return strength;
      }

      bool
      has_memory() const override
      {
        return true;
      }

      JointHistory
      advance(JointHistory history,
              const double slip,
              const double /*pressure*/) const override
      {
        return dilation.advance(history, slip);
      }

    private:
      double peak_tangent, residual_tangent;   ///< tan(phi) [-]
      double peak_cohesion, residual_cohesion; ///< [Pa]
      double tensile_strength;                 ///< [Pa]
      double distance;                         ///< [m]
      Dilation dilation;
    };

    std::shared_ptr<const JointLaw>
    make_slip_weakening(const JointStrength &entries,
                        const std::string &section)
    {
      AssertThrow(entries.value_of("Slip distance") > 0.,
                  InputError("'" + section +
                             "/Slip distance' is 0; give the slip in metres "
                             "over which strength falls to its residual "
                             "value."));
      AssertThrow(entries.value_of("Residual friction angle") >= 0.,
                  InputError("'" + section +
                             "/Residual friction angle' is not given; the law "
                             "slip weakening needs it in degrees."));
      AssertThrow(entries.kinetic_friction_angle < 0.,
                  InputError("'" + section +
                             "/Kinetic friction angle' is given, but the law "
                             "slip weakening has 'Residual friction angle' in "
                             "its place; remove it."));
      AssertThrow(
        entries.value_of("Residual friction angle") <= entries.friction_angle,
        InputError("'" + section + "/Residual friction angle' is " +
                   text_of(entries.value_of("Residual friction angle")) +
                   " degrees, above 'Friction angle', from which the law slip "
                   "weakening falls to it; give a smaller one."));
      return std::make_shared<const SlipWeakening>(entries);
    }
  } // namespace



  JointLawEntry
  residual_friction_entry()
  {
    return {"Residual friction angle",
            -1.,
            -1.,
            89.9,
            "deg",
            "Friction angle of the smooth or worn joint [deg], for the laws "
            "slip weakening and barton-bandis; -1: not given."};
  }



  JointLawKind
  slip_weakening_joint()
  {
    std::vector<JointLawEntry> entries = dilation_entries();
    entries.push_back(residual_friction_entry());
    entries.push_back(
      {"Slip distance",
       0.,
       0.,
       std::numeric_limits<double>::max(),
       "m",
       "Slip over which strength falls to its residual value [m], for the law "
       "slip weakening."});
    return {"slip weakening",
            "friction and cohesion fall along straight lines from their peak "
            "to their residual values over Slip distance",
            entries,
            make_slip_weakening};
  }
} // namespace Keyblock
