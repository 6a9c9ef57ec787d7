// SPDX-License-Identifier: LGPL-2.1-or-later
// Lets ParameterHandler::add_parameter() take the choices of scene/choices.h.
#ifndef keyblock_scene_choice_patterns_h
#define keyblock_scene_choice_patterns_h

#include <deal.II/base/patterns.h>

#include <keyblock/scene/choices.h>

#include <memory>

namespace Keyblock
{
  /** What dealii::Patterns::Tools::Convert needs of a choice. */
  template <typename E>
  struct ChoiceConversion
  {
    using PatternBase = dealii::Patterns::PatternBase;

    static std::unique_ptr<PatternBase>
    to_pattern()
    {
      std::string words;
      for (const char *name : ChoiceNames<E>::names)
        words += (words.empty() ? "" : "|") + std::string(name);
      return std::make_unique<dealii::Patterns::Selection>(words);
    }

    static std::string
    to_string(const E &choice, const PatternBase & = *to_pattern())
    {
      return name_of(choice);
    }

    static E
    to_value(const std::string &word,
             const PatternBase &pattern = *to_pattern())
    {
      const std::optional<E> choice = choice_called<E>(word);
      AssertThrow(choice,
                  dealii::Patterns::Tools::ExcNoMatch(word,
                                                      pattern.description()));
      return *choice;
    }
  };
} // namespace Keyblock

// One by one: deal.II may have a partial specialisation for all enumerations.
namespace dealii::Patterns::Tools
{
  template <>
  struct Convert<Keyblock::DomainShape>
    : Keyblock::ChoiceConversion<Keyblock::DomainShape>
  {};
  template <>
  struct Convert<Keyblock::MeshGenerator>
    : Keyblock::ChoiceConversion<Keyblock::MeshGenerator>
  {};
  template <>
  struct Convert<Keyblock::ExcavationShape>
    : Keyblock::ChoiceConversion<Keyblock::ExcavationShape>
  {};
  template <>
  struct Convert<Keyblock::RayleighTerms>
    : Keyblock::ChoiceConversion<Keyblock::RayleighTerms>
  {};
  template <>
  struct Convert<Keyblock::StudyLevel>
    : Keyblock::ChoiceConversion<Keyblock::StudyLevel>
  {};
  template <>
  struct Convert<Keyblock::JointForm>
    : Keyblock::ChoiceConversion<Keyblock::JointForm>
  {};
  template <>
  struct Convert<Keyblock::JointShape>
    : Keyblock::ChoiceConversion<Keyblock::JointShape>
  {};
  template <>
  struct Convert<Keyblock::SpacingDistribution>
    : Keyblock::ChoiceConversion<Keyblock::SpacingDistribution>
  {};
  template <>
  struct Convert<Keyblock::RadiusDistribution>
    : Keyblock::ChoiceConversion<Keyblock::RadiusDistribution>
  {};
  template <>
  struct Convert<Keyblock::MaterialModel>
    : Keyblock::ChoiceConversion<Keyblock::MaterialModel>
  {};
  template <>
  struct Convert<Keyblock::CellIntegration>
    : Keyblock::ChoiceConversion<Keyblock::CellIntegration>
  {};
  template <>
  struct Convert<Keyblock::SupportKind>
    : Keyblock::ChoiceConversion<Keyblock::SupportKind>
  {};
  template <>
  struct Convert<Keyblock::Distribution>
    : Keyblock::ChoiceConversion<Keyblock::Distribution>
  {};
  template <>
  struct Convert<Keyblock::Sampling>
    : Keyblock::ChoiceConversion<Keyblock::Sampling>
  {};
  template <>
  struct Convert<Keyblock::HistoryQuantity>
    : Keyblock::ChoiceConversion<Keyblock::HistoryQuantity>
  {};
  template <>
  struct Convert<Keyblock::SupportDirections>
    : Keyblock::ChoiceConversion<Keyblock::SupportDirections>
  {};
  template <>
  struct Convert<Keyblock::InitialEquilibrium>
    : Keyblock::ChoiceConversion<Keyblock::InitialEquilibrium>
  {};
  template <>
  struct Convert<Keyblock::ContactMethod>
    : Keyblock::ChoiceConversion<Keyblock::ContactMethod>
  {};
  template <>
  struct Convert<Keyblock::Kinematics>
    : Keyblock::ChoiceConversion<Keyblock::Kinematics>
  {};
  template <>
  struct Convert<Keyblock::StageKind>
    : Keyblock::ChoiceConversion<Keyblock::StageKind>
  {};
  template <>
  struct Convert<Keyblock::MonitorKind>
    : Keyblock::ChoiceConversion<Keyblock::MonitorKind>
  {};
  template <>
  struct Convert<Keyblock::ReducedJoints>
    : Keyblock::ChoiceConversion<Keyblock::ReducedJoints>
  {};
  template <>
  struct Convert<Keyblock::FactorSearch>
    : Keyblock::ChoiceConversion<Keyblock::FactorSearch>
  {};
  template <>
  struct Convert<Keyblock::BoltConvention>
    : Keyblock::ChoiceConversion<Keyblock::BoltConvention>
  {};
  template <>
  struct Convert<Keyblock::ClosedForm>
    : Keyblock::ChoiceConversion<Keyblock::ClosedForm>
  {};
} // namespace dealii::Patterns::Tools

#endif
