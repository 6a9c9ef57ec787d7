// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_checkpoint_state_seal_h
#define keyblock_checkpoint_state_seal_h

#include <boost/crc.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace Keyblock
{
  // A state file begins with a seal: one line each for its format, for the
  // program that wrote it, and for length and digest of what follows, then
  // zeros. HDF5 takes these bytes for a user block and passes over them.

  /** Format of state files; it is to grow whenever their entries change. */
  constexpr unsigned int state_format = 2;

  /** Length of the seal: the first place but 0 where HDF5 looks for its own
   * beginning [bytes]. */
  constexpr std::size_t seal_length = 512;

  /** CRC-64/XZ, in pieces: every change of up to 64 bits in a row is seen, any
   * other with all but a chance of 5e-20. */
  class Digest
  {
  public:
    void
    add(const char *bytes, const std::size_t n)
    {
      crc.process_bytes(bytes, n);
    }

    std::uint64_t
    value() const
    {
      return crc.checksum();
    }

  private:
    boost::crc_optimal<64, 0x42F0E1EBA9EA3693, ~0ULL, ~0ULL, true, true> crc;
  };

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
