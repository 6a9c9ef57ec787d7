// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/scene/old_names.h>
#include <keyblock/scene/text.h>

#include <boost/algorithm/string.hpp>

#include <array>
#include <sstream>

namespace Keyblock
{
  namespace
  {
    /** What an entry was called, or a value of it if that is not empty. */
    struct OldName
    {
      std::string section, entry, value, new_entry, new_value;
    };

    const std::array<OldName, 2> old_names = {
      {{"Safety factor", "Teams", "", "Rank groups", ""},
       {"Contact", "Method", "paper", "Method", "published"}}};

    std::string
    sentence(const OldName &old)
    {
      const std::string before = "'" + old.section + "/" + old.entry;
      const std::string now    = "'" + old.section + "/" + old.new_entry;
      return old.value.empty()
               ? "The entry " + before + "' is now called " + now +
                   "'; rename it, its old name will go."
               : "The value " + before + " = " + old.value +
                   "' is now called " + now + " = " + old.new_value +
                   "'; rename it, its old name will go.";
    }
  } // namespace



  std::vector<std::string>
  replace_old_names(std::string &text)
  {
    std::vector<std::string> sentences, sections;
    std::istringstream lines(text);
    std::string result;
    for (std::string line; std::getline(lines, line);)
      {
        const std::string words = significant_part(line);
        const auto equal        = words.find('=');
        if (boost::istarts_with(words, "subsection "))
          sections.push_back(words.substr(11));
        else if (boost::iequals(words, "end") && !sections.empty())
          sections.pop_back();
        else if (sections.size() == 1 && boost::istarts_with(words, "set ") &&
                 equal != std::string::npos)
          {
            const std::string entry =
              boost::trim_copy(words.substr(4, equal - 4));
            const std::string value = boost::trim_copy(words.substr(equal + 1));
            for (const OldName &old : old_names)
              if (sections[0] == old.section && entry == old.entry &&
                  (old.value.empty() || value == old.value))
                {
                  sentences.push_back(sentence(old));
                  line = "set " + old.new_entry + " = " +
                         (old.value.empty() ? value : old.new_value);
                }
          }
        result += line + '\n';
      }
    if (!sentences.empty())
      text = result;
    return sentences;
  }
} // namespace Keyblock
