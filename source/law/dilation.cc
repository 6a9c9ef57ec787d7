// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/angle.h>
#include <keyblock/law/dilation.h>

#include <limits>

namespace Keyblock
{
  Dilation::Dilation(const JointStrength &entries)
    : tangent(tangent_of(entries.value_of("Dilation angle")))
    , limit(entries.value_of("Dilation slip"))
  {
    if (limit <= 0.)
      limit = std::numeric_limits<double>::max();
  }



  std::vector<JointLawEntry>
  dilation_entries()
  {
    return {
      {"Dilation angle",
       0.,
       0.,
       60.,
       "deg",
       "Angle by which the joint opens while it slips, whichever way, also "
       "back [deg]; 0: it does not."},
      {"Dilation slip",
       0.,
       0.,
       std::numeric_limits<double>::max(),
       "m",
       "Slip after which the joint opens no further [m]; 0: no limit."}};
  }
} // namespace Keyblock
