// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/errors.h>
#include <keyblock/law/barton_bandis.h>
#include <keyblock/law/coulomb_joint.h>
#include <keyblock/law/joint_stiffness.h>
#include <keyblock/law/slip_weakening.h>

#include <algorithm>
#include <stdexcept>

namespace Keyblock
{
  namespace
  {
    /** The laws that users can choose: a new one is a line here. */
    const std::vector<JointLawKind> &
    registered_kinds()
    {
      static const std::vector<JointLawKind> kinds = {coulomb_joint(),
                                                      slip_weakening_joint(),
                                                      barton_bandis_joint()};
      return kinds;
    }

    bool
    has_entry(const std::vector<JointLawEntry> &entries,
              const std::string &name)
    {
      return std::any_of(entries.begin(),
                         entries.end(),
                         [&](const JointLawEntry &entry) {
                           return entry.name == name;
                         });
    }

    std::vector<JointLawEntry>
    collect_entries()
    {
      std::vector<JointLawEntry> entries;
      for (const JointLawKind &kind : registered_kinds())
        for (const JointLawEntry &entry : kind.entries)
          if (!has_entry(entries, entry.name))
            entries.push_back(entry);
      for (const JointLawEntry &entry : stiffness_entries())
        entries.push_back(entry);
      return entries;
    }
  } // namespace



  const std::vector<JointLawKind> &
  joint_law_kinds()
  {
    return registered_kinds();
  }



  const std::vector<JointLawEntry> &
  joint_law_entries()
  {
    static const std::vector<JointLawEntry> entries = collect_entries();
    return entries;
  }



  const JointLawKind &
  joint_law_kind(const std::string &name)
  {
    for (const JointLawKind &kind : joint_law_kinds())
      if (kind.name == name)
        return kind;
    throw std::out_of_range("There is no joint law called " + name);
  }



  std::shared_ptr<const JointLaw>
  make_joint_law(const JointStrength &entries, const std::string &section)
  {
    const JointLawKind &kind = joint_law_kind(entries.law);
    for (unsigned int i = 0; i < joint_law_entries().size(); ++i)
      {
        const JointLawEntry &entry = joint_law_entries()[i];
        AssertThrow(entries.law_values[i] == entry.value ||
                      has_entry(kind.entries, entry.name) ||
                      has_entry(stiffness_entries(), entry.name),
                    InputError("'" + section + "/" + entry.name +
                               "' is given, but the joint's law is '" +
                               kind.name +
                               "', which does not use it; remove it or choose "
                               "another 'Law'."));
      }
    const JointStiffness stiffness(entries, section);
    return kind.make(entries, section);
  }



  std::shared_ptr<const JointLaw>
  make_friction_law(const double angle)
  {
    JointStrength entries;
    entries.friction_angle = angle;
    return make_joint_law(entries);
  }
} // namespace Keyblock
