// SPDX-License-Identifier: LGPL-2.1-or-later
// Lets ParameterHandler::add_parameter() take a choice of words E, where
//   namespace dealii::Patterns::Tools
//   {
//     template <>
//     struct Convert<Keyblock::E> : Keyblock::ChoiceConversion<Keyblock::E>
//     {};
//   }
// stands before it: one by one, as deal.II may have a partial specialisation
// for all enumerations.
#ifndef keyblock_scene_choice_patterns_h
#define keyblock_scene_choice_patterns_h

#include <deal.II/base/patterns.h>

#include <keyblock/base/choice.h>

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

#endif
