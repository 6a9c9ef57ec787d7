// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_safety_friction_loss_h
#define keyblock_safety_friction_loss_h

#include <deal.II/base/numbers.h>

#include <keyblock/law/joint_law.h>

#include <cmath>
#include <sstream>

namespace Keyblock
{
  /** tan(phi) of a joint, at rest and sliding after a long way, without
   * pressure [-]. */
  struct FrictionLoss
  {
    double peak, residual;

    explicit FrictionLoss(const JointLaw &law)
    {
      constexpr double long_way = 1e6; // [m]
      JointPointState slid;
      slid.is_intact = false;
      slid.history   = law.advance({}, long_way, 0.);
      peak           = law.envelope({}).static_tangent;
      residual       = law.envelope(slid).kinetic_tangent;
    }

    bool
    is_felt() const
    {
      constexpr double round_off = 1e-9;
      return residual < (1. - round_off) * peak;
    }

    /** What to know where only the peak counts. */
    std::string
    describe(const std::string &joint) const
    {
      std::ostringstream text;
      text << "peak friction of " << joint << ", residual "
           << std::atan(residual) * 180. / dealii::numbers::PI << " degrees";
      return text.str();
    }
  };
} // namespace Keyblock

#endif
