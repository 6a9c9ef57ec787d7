// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_law_joint_stiffness_h
#define keyblock_law_joint_stiffness_h

#include <keyblock/law/joint_law.h>

namespace Keyblock
{
  /** How far a joint yields elastically before it slips or opens; rigid unless
   * the scene gives stiffnesses. */
  struct JointStiffness
  {
    /** Read it from the entries of a joint. Throws InputError, beginning with
     * @p section, if one stiffness is given without the other. */
    explicit JointStiffness(const JointStrength &entries,
                            const std::string &section = "Joints");

    bool
    is_compliant() const
    {
      return normal > 0.;
    }

    double normal; ///< normal stress over closure [Pa/m]; 0: rigid
    double shear;  ///< shear stress over elastic slip [Pa/m]; 0: rigid
  };

  /** Whether one of @p joints, pointers to JointStrength, is compliant. */
  template <typename Joints>
  bool
  are_any_compliant(const Joints &joints)
  {
    for (const auto &joint : joints)
      if (JointStiffness(*joint).is_compliant())
        return true;
    return false;
  }

  /** The entries it is read from, which joints of all laws have. */
  std::vector<JointLawEntry> stiffness_entries();
} // namespace Keyblock

#endif
