// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_base_choice_h
#define keyblock_base_choice_h

#include <array>
#include <optional>
#include <string>

namespace Keyblock
{
  /** The words by which entries name the values of the choice E, in the order
   * of the values: specialised after each choice. One that is an entry needs
   * a line in the file that declares it, too (scene/choice_patterns.h). */
  template <typename E>
  struct ChoiceNames;

  /** The word by which entries name @p choice. */
  template <typename E>
  std::string
  name_of(const E choice)
  {
    return ChoiceNames<E>::names.at(static_cast<unsigned int>(choice));
  }

  /** The value that entries name by @p word; none if there is no such one. */
  template <typename E>
  std::optional<E>
  choice_called(const std::string &word)
  {
    constexpr auto &names = ChoiceNames<E>::names;
    for (unsigned int i = 0; i < names.size(); ++i)
      if (word == names[i])
        return static_cast<E>(i);
    return {};
  }
} // namespace Keyblock

#endif
