// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_scene_decimal_commas_h
#define keyblock_scene_decimal_commas_h

#include <string>
#include <vector>

namespace Keyblock
{
  /** Warnings of entries that may have one number or two and have "0,6", in the
   * lines of a parameter file: that is two numbers. */
  std::vector<std::string> warnings_of_decimal_commas(const std::string &text);
} // namespace Keyblock

#endif
