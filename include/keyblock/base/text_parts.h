// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_base_text_parts_h
#define keyblock_base_text_parts_h

#include <string>
#include <vector>

// Texts of any length, for which std::regex is not made: it takes a piece of
// the stack for each letter.
namespace Keyblock
{
  /** What stands after each of some @p words in a text, up to the next of them
   * or the end; empty if they do not follow each other there. */
  inline std::vector<std::string>
  parts_between(const std::string &text, const std::vector<std::string> &words)
  {
    std::vector<std::string> parts;
    std::size_t begin = 0;
    for (const std::string &word : words)
      {
        const std::size_t place = text.find(word, begin);
        if (place == std::string::npos)
          return {};
        if (&word != &words.front())
          parts.push_back(text.substr(begin, place - begin));
        begin = place + word.size();
      }
    parts.push_back(text.substr(begin));
    return parts;
  }

  /** A text for a sentence: its first 80 bytes, if it is longer, in whole
   * letters. */
  inline std::string
  excerpt(const std::string &text)
  {
    std::size_t length = 80;
    if (text.size() <= length + 3)
      return text;
    while (length > 0 && (static_cast<unsigned char>(text[length]) >> 6) == 2)
      --length;
    return text.substr(0, length) + "...";
  }
} // namespace Keyblock

#endif
