// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_checkpoint_write_through_h
#define keyblock_checkpoint_write_through_h

#include <string>
#include <vector>

namespace Keyblock
{
  /** Write @p content behind its seal and wait for the disk. Returns whether
   * that worked. */
  bool write_through(const std::string &file_name,
                     const std::vector<char> &content);
} // namespace Keyblock

#endif
