// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/patterns.h>

#include <keyblock/base/errors.h>
#include <keyblock/law/joint_law.h>

#include <array>

namespace Keyblock
{
  JointStrength::JointStrength()
    : law(joint_law_kinds().front().name)
  {
    for (const JointLawEntry &entry : joint_law_entries())
      law_values.push_back(entry.value);
  }



  double
  JointStrength::value_of(const std::string &entry) const
  {
    const std::vector<JointLawEntry> &entries = joint_law_entries();
    for (unsigned int i = 0; i < entries.size(); ++i)
      if (entries[i].name == entry)
        return law_values[i];
    AssertThrow(false,
                dealii::ExcMessage("No joint law has the entry " + entry));
    return 0.;
  }



  bool
  JointStrength::is_weaker_than(const JointStrength &other) const
  {
    // by the tangent of its strength under common pressure, since friction
    // falls with pressure by some laws
    constexpr double common_pressure = 1e6; // [Pa]
    const auto strength_of           = [](const JointStrength &joint) {
      JointPointState state;
      state.pressure                  = common_pressure;
      const StrengthEnvelope strength = make_joint_law(joint)->envelope(state);
      return std::array<double, 2>{
        {strength.static_tangent, strength.cohesion}};
    };
    return strength_of(*this) < strength_of(other);
  }



  void
  JointStrength::declare_strength(dealii::ParameterHandler &prm)
  {
    using dealii::Patterns::Double;
    const Double not_negative(0.);
    std::string names, descriptions;
    for (const JointLawKind &kind : joint_law_kinds())
      {
        names += (names.empty() ? "" : "|") + kind.name;
        descriptions += (descriptions.empty() ? "" : "; ") + kind.name + ": " +
                        kind.description;
      }
    prm.add_parameter("Law",
                      law,
                      "Law of the joint's strength. " + descriptions + ".",
                      dealii::Patterns::Selection(names));
    prm.add_parameter("Friction angle",
                      friction_angle,
                      "Static friction angle [deg].",
                      Double(0., 89.9));
    prm.add_parameter("Kinetic friction angle",
                      kinetic_friction_angle,
                      "Friction angle while sliding [deg]; -1: the static one.",
                      Double(-1., 89.9));
    prm.add_parameter("Cohesion", cohesion, "Cohesion [Pa].", not_negative);
    prm.add_parameter("Tensile strength",
                      tensile_strength,
                      "Tensile strength [Pa], at most cohesion / tan(friction "
                      "angle).",
                      not_negative);
    prm.add_parameter("Residual cohesion",
                      residual_cohesion,
                      "Cohesion left where the joint has slid [Pa]; -1: as "
                      "'Cohesion'. Below it the joint is brittle. Where it has "
                      "opened there is none, nor tensile strength.",
                      Double(-1.));
    for (unsigned int i = 0; i < law_values.size(); ++i)
      {
        const JointLawEntry &entry = joint_law_entries()[i];
        prm.add_parameter(entry.name,
                          law_values[i],
                          entry.description,
                          Double(entry.lowest, entry.highest));
      }
    prm.add_parameter("Water pressure",
                      water_pressure,
                      "A formula in x, y (z) and t: pressure of water in the "
                      "joint, which pushes both sides apart [Pa]; where it is "
                      "negative there is none (no suction); empty: that below "
                      "Water level.");
    prm.add_parameter("Water level",
                      water_level,
                      "Elevation of the water that stands in the joint, a "
                      "formula in x, y (z), t, as in a crack that has filled "
                      "[m]; none: it is dry; empty: Water/Level, or that of "
                      "the stage.");
  }
} // namespace Keyblock
