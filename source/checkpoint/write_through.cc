// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/checkpoint/state_seal.h>
#include <keyblock/checkpoint/write_through.h>

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>

namespace Keyblock
{
  namespace
  {
    /** Returns whether that worked. */
    bool
    write_bytes(const int out, const char *bytes, const std::size_t length)
    {
      std::size_t at = 0;
      while (at < length)
        {
          const ssize_t n = ::write(out, bytes + at, length - at);
          if (n < 0 && errno != EINTR)
            break;
          at += n > 0 ? n : 0;
        }
      return at == length;
    }
  } // namespace



  bool
  write_through(const std::string &file_name, const std::vector<char> &content)
  {
    const std::string seal = make_seal(content);
    const int out = open(file_name.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
    if (out < 0)
      return false;
    const bool is_complete = write_bytes(out, seal.data(), seal.size()) &&
                             write_bytes(out, content.data(), content.size()) &&
                             fsync(out) == 0;
    const int reason = errno;
    close(out);
    errno = reason;
    return is_complete;
  }
} // namespace Keyblock
