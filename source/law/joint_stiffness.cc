// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/errors.h>
#include <keyblock/law/joint_stiffness.h>

#include <limits>

namespace Keyblock
{
  JointStiffness::JointStiffness(const JointStrength &entries,
                                 const std::string &section)
    : normal(entries.value_of("Normal stiffness"))
    , shear(entries.value_of("Shear stiffness"))
  {
    const std::string given   = normal > 0. ? "Normal" : "Shear",
                      missing = normal > 0. ? "Shear" : "Normal";
    AssertThrow((normal > 0.) == (shear > 0.),
                InputError("'" + section + "/" + given +
                           " stiffness' is given, but '" + missing +
                           " stiffness' is 0, which stands for a rigid joint; "
                           "give both in Pa/m, or neither."));
  }



  std::vector<JointLawEntry>
  stiffness_entries()
  {
    constexpr double any = std::numeric_limits<double>::max();
    return {{"Normal stiffness",
             0.,
             0.,
             any,
             "Pa/m",
             "Normal stress over the elastic closure of the joint [Pa/m], as "
             "in UDEC and 3DEC, of all laws; 0: the joint is rigid, as is "
             "'Shear stiffness' then."},
            {"Shear stiffness",
             0.,
             0.,
             any,
             "Pa/m",
             "Shear stress over the elastic slip of the joint, before it slips "
             "for good [Pa/m], of all laws; 0: the joint is rigid, as is "
             "'Normal stiffness' then."}};
  }
} // namespace Keyblock
