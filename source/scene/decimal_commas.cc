// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/scene/decimal_commas.h>
#include <keyblock/scene/text.h>

#include <regex>
#include <sstream>

namespace Keyblock
{
  std::vector<std::string>
  warnings_of_decimal_commas(const std::string &text)
  {
    // (others want as many numbers as the scene has dimensions, or one)
    static const std::regex entry(
      "set (K0|Lateral ratios|Spacing) ?= ?(-?[0-9]+),([0-9]+)");
    std::vector<std::string> warnings;
    std::istringstream lines(text);
    std::smatch part;
    for (std::string line; std::getline(lines, line);)
      if (line.find(',') != std::string::npos)
        {
          line = significant_part(line);
          if (std::regex_match(line, part, entry))
            warnings.push_back(
              "The entry '" + part[1].str() + "' is '" + part[2].str() + "," +
              part[3].str() + "', which are two numbers; write " +
              part[2].str() + "." + part[3].str() + " if it is one, or '" +
              part[2].str() + ", " + part[3].str() + "'.");
        }
    return warnings;
  }
} // namespace Keyblock
