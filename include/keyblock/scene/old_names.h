// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_scene_old_names_h
#define keyblock_scene_old_names_h

#include <string>
#include <vector>

namespace Keyblock
{
  /**
   * Put the present names of entries and values in the place of those that
   * earlier versions had, in the lines of a parameter file.
   * @return a sentence for each that was found
   */
  std::vector<std::string> replace_old_names(std::string &text);
} // namespace Keyblock

#endif
