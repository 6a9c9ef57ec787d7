// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_base_last_resort_h
#define keyblock_base_last_resort_h

#include <string>

namespace Keyblock
{
  /** @p message with blanks in place of line ends and other control
   * characters, which a file can bring into it. */
  std::string in_one_line(std::string message);

  /**
   * A sentence about the exception that is being handled and that nobody
   * expected: that memory is used up, or that it is our bug, with a few words
   * about what it was, but not with its dump.
   */
  std::string describe_present_exception();

  /** For std::set_terminate(): say what happened, and end with code 2. */
  [[noreturn]] void end_with_a_sentence();
} // namespace Keyblock

#endif
