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

    /** History after a further @p slip [m]. */
    JointHistory
    advance(JointHistory history, const double slip) const
    {
      history.slip += slip;
      history.dilation =
        tangent * (history.slip < limit ? history.slip : limit);
      return history;
    }

  private:
    double tangent; ///< tan(psi) [-]
    double limit;   ///< [m]
  };

  /** The entries it is read from. */
  std::vector<JointLawEntry> dilation_entries();
} // namespace Keyblock

#endif
