// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_checkpoint_state_seal_h
#define keyblock_checkpoint_state_seal_h

#include <keyblock/base/digest.h>

#include <cstdint>
#include <string>
#include <vector>

namespace Keyblock
{
  // A state file begins with a seal: one line each for its format, for the
  // program that wrote it, and for length and digest of what follows, then
  // zeros. HDF5 takes these bytes for a user block and passes over them.

  /** Format of state files; it is to grow whenever their entries change. */
  constexpr unsigned int state_format = 23;

  /** Length of the seal: the first place but 0 where HDF5 looks for its own
   * beginning [bytes]. */
  constexpr std::size_t seal_length = 512;

  /** The seal of a file whose other bytes are @p content. */
  std::string make_seal(const std::vector<char> &content);

  /**
   * Look at every byte of the file @p name, before anyone makes use of it, a
   * piece at a time. Throws InputError if it is no state file, of another
   * format or program, or not as it was written.
   */
  void check_seal(const std::string &name);
} // namespace Keyblock

#endif
