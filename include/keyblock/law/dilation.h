// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_law_dilation_h
#define keyblock_law_dilation_h

#include <keyblock/law/joint_law.h>

namespace Keyblock
{
  /** Opening by a constant angle while a joint slips, up to a limit slip. */
  class Dilation
  {
  public:
    explicit Dilation(const JointStrength &entries);

    bool
    is_any() const
    {
      return tangent > 0.;
    }

    /** Opening over slip at @p slip [m]. */
    double
    tangent_at(const double slip) const
    {
      return slip < limit ? tangent : 0.;
    }

    /** Opening that @p slip [m] has made [m]. */
    double
    opening_at(const double slip) const
    {
      return tangent * (slip < limit ? slip : limit);
    }

  private:
    double tangent; ///< tan(psi) [-]
    double limit;   ///< [m]
  };

  /** The entries it is read from. */
  std::vector<JointLawEntry> dilation_entries();
} // namespace Keyblock

#endif
