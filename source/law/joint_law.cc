// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/law/coulomb_joint.h>

#include <algorithm>
#include <stdexcept>

namespace Keyblock
{
  namespace
  {
    /** The laws that users can choose: a new one is a line here. */
    std::vector<JointLawKind> &
    registered_kinds()
    {
      static std::vector<JointLawKind> kinds = {coulomb_joint()};
      return kinds;
    }

    std::vector<JointLawEntry>
    collect_entries()
    {
      std::vector<JointLawEntry> entries;
      for (const JointLawKind &kind : registered_kinds())
        for (const JointLawEntry &entry : kind.entries)
          if (std::none_of(entries.begin(),
                           entries.end(),
                           [&](const JointLawEntry &other) {
                             return other.name == entry.name;
                           }))
            entries.push_back(entry);
      return entries;
    }
  } // namespace



  PointStrength
  StrengthEnvelope::of_point(const double share,
                             const double area,
                             const double kick) const
  {
    PointStrength strength;
    strength.static_friction  = share * static_tangent;
    strength.kinetic_friction = share * kinetic_tangent;
    strength.cohesion         = share * cohesion * area * kick;
    strength.tension          = share * tensile_strength * area * kick;
    return strength;
  }



  JointLawRegistration::JointLawRegistration(const JointLawKind &kind)
  {
    registered_kinds().push_back(kind);
  }



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
    return joint_law_kind(entries.law).make(entries, section);
  }



  std::shared_ptr<const JointLaw>
  make_friction_law(const double angle)
  {
    JointStrength entries;
    entries.friction_angle = angle;
    return make_joint_law(entries);
  }
} // namespace Keyblock
