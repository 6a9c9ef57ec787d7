// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_base_digest_h
#define keyblock_base_digest_h

#include <boost/crc.hpp>

#include <cstdint>
#include <iomanip>
#include <sstream>
#include <string>

namespace Keyblock
{
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

  /** Of a text, as 16 hexadecimal digits. */
  inline std::string
  digest_of(const std::string &text)
  {
    Digest digest;
    digest.add(text.data(), text.size());
    std::ostringstream digits;
    digits << std::hex << std::setfill('0') << std::setw(16) << digest.value();
    return digits.str();
  }
} // namespace Keyblock

#endif
