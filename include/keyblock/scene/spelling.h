// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_scene_spelling_h
#define keyblock_scene_spelling_h

#include <string>

namespace Keyblock
{
  /** Whether @p word is @p known but for a slip of the pen: a letter wrong,
   * missing, too many or swapped, two in words from eight letters on. */
  bool is_like(const std::string &word, const std::string &known);
} // namespace Keyblock

#endif
