// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_base_number_text_h
#define keyblock_base_number_text_h

#include <charconv>
#include <cmath>
#include <sstream>
#include <string>

namespace Keyblock
{
  /** The shortest text that is read again as exactly @p value, whatever the
   * locale. */
  inline std::string
  exact_text(const double value)
  {
    char text[32];
    const auto end = std::to_chars(text, text + sizeof(text), value).ptr;
    return std::string(text, end);
  }

  /** The first @p n of some numbers as a list of an entry, exactly. */
  template <typename Numbers>
  std::string
  exact_list(const Numbers &numbers,
             const std::size_t n,
             const std::string &separator = ", ")
  {
    std::string text;
    for (std::size_t i = 0; i < n; ++i)
      text += (i ? separator : "") + exact_text(numbers[i]);
    return text;
  }

  /** A number for people, with so many significant digits. */
  inline std::string
  text_of(const double value, const unsigned int digits = 6)
  {
    std::ostringstream out;
    out.precision(digits);
    out << value;
    return out.str();
  }

  /** Whether all of @p text is one finite number, which is then put into
   * @p value; @p has_decimal_comma allows one comma in place of the point. */
  inline bool
  read_number(std::string text, const bool has_decimal_comma, double &value)
  {
    const auto comma = text.find(',');
    if (has_decimal_comma && comma != std::string::npos &&
        text.find('.') == std::string::npos)
      text[comma] = '.';
    const char *begin = text.data(), *const end = begin + text.size();
    if (text.size() > 1 && text[0] == '+' && text[1] != '-')
      ++begin;
    const auto result = std::from_chars(begin, end, value);
    return result.ec == std::errc() && result.ptr == end &&
           std::isfinite(value);
  }
} // namespace Keyblock

#endif
