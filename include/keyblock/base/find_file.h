// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_base_find_file_h
#define keyblock_base_find_file_h

#include <string>

namespace Keyblock
{
  /** Path of a file that a scene names: beside @p scene_file, or else where the
   * program runs; empty if neither can be read. */
  std::string find_file(const std::string &scene_file, const std::string &name);
} // namespace Keyblock

#endif
