// SPDX-License-Identifier: LGPL-2.1-or-later
// A second joint law, for tests only: what it takes to add one is this file and
// the line that compiles it into a program.
#include <deal.II/base/numbers.h>

#include <keyblock/base/errors.h>
#include <keyblock/law/joint_law.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace
{
  using namespace Keyblock;

  double
  tangent_of(const double degrees)
  {
    return std::tan(degrees * dealii::numbers::PI / 180.);
  }

  /** Friction that falls along a straight line from its peak to its residual
   * value over a slip distance; no cohesion. */
  class SlipWeakening : public JointLaw
  {
  public:
    SlipWeakening(const JointStrength &entries)
      : peak(tangent_of(entries.friction_angle))
      , residual(tangent_of(entries.value_of("Residual friction angle")))
      , distance(entries.value_of("Slip distance"))
    {}

    StrengthEnvelope
    envelope(const JointPointState &state) const override
    {
      const double done = std::min(1., state.history.slip / distance);
      StrengthEnvelope strength;
      strength.static_tangent = strength.kinetic_tangent =
        peak + done * (residual - peak);
      return strength;
    }

    bool
    has_memory() const override
    {
      return true;
    }

  private:
    double peak, residual, distance;
  };

  const JointLawRegistration registration(
    {"slip weakening",
     "friction falls with slip to its residual value",
     {{"Slip distance",
       0.,
       0.,
       std::numeric_limits<double>::max(),
       "m",
       "Slip after which friction is residual [m]."},
      {"Residual friction angle",
       0.,
       0.,
       89.9,
       "deg",
       "Friction angle after that slip [deg]."}},
     [](const JointStrength &entries, const std::string &section) {
       AssertThrow(entries.value_of("Slip distance") > 0.,
                   InputError("'" + section +
                              "/Slip distance' is 0; give the slip in metres "
                              "over which friction falls."));
       return std::make_shared<const SlipWeakening>(entries);
     }});
} // namespace
