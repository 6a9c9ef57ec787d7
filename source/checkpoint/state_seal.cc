// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/errors.h>
#include <keyblock/checkpoint/state_seal.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <regex>
#include <sstream>

namespace Keyblock
{
  namespace
  {
    const std::string this_program =
      std::string("keyblock ") + KEYBLOCK_VERSION;

    const std::string anew =
      "name another by --restart, or leave --restart out to start anew.";

    const std::string with_the_other =
      "; continue with the program that wrote it, or leave --restart out to "
      "start anew.";

    /** First bytes of an HDF5 file without a seal, as format 1 was. */
    const std::string hdf5_signature = "\211HDF\r\n\032\n";

    /** Length of the pieces in which a file is read [bytes]. */
    constexpr std::size_t piece_length = 1 << 20;

    struct Seal
    {
      std::string program;
      std::uint64_t length = 0; ///< of what follows [bytes]
      std::uint64_t digest = 0;

      /** Its bytes. */
      std::string
      text() const
      {
        std::ostringstream out;
        out << "keyblock checkpoint, format " << state_format << "\nwritten by "
            << program << '\n'
            << length << " bytes follow these " << seal_length << ", CRC-64/XZ "
            << std::hex << std::setfill('0') << std::setw(16) << digest << '\n';
        std::string bytes = out.str();
        bytes.resize(seal_length, '\0');
        return bytes;
      }
    };

    [[noreturn]] void
    refuse_damaged(const std::string &name, const std::string &reason)
    {
      throw InputError("The checkpoint '" + name + "' is damaged: " + reason +
                       "; " + anew);
    }

    std::ifstream
    open_file(const std::string &name)
    {
      std::error_code error;
      const auto status = std::filesystem::status(name, error);
      AssertThrow(std::filesystem::exists(status),
                  InputError("The checkpoint '" + name +
                             "' does not exist; name another by --restart, or "
                             "leave --restart out to start anew."));
      AssertThrow(std::filesystem::is_regular_file(status),
                  InputError("The checkpoint '" + name +
                             "' is a folder or a device, not a file; " + anew));
      std::ifstream file(name, std::ios::binary);
      AssertThrow(file,
                  InputError("The checkpoint '" + name + "' cannot be read (" +
                             std::strerror(errno) +
                             "); check its permissions, or " + anew));
      return file;
    }

    /** Refuse @p bytes, the first of a file, unless they are a seal of the
     * present format. */
    void
    check_format(const std::string &name, const std::string &bytes)
    {
      AssertThrow(bytes.compare(0, hdf5_signature.size(), hdf5_signature) != 0,
                  InputError("The checkpoint '" + name +
                             "' is of format 1, without a checksum, and this "
                             "program reads format " +
                             std::to_string(state_format) + with_the_other));
      std::smatch words;
      AssertThrow(std::regex_search(bytes,
                                    words,
                                    std::regex("^keyblock checkpoint, format "
                                               "([0-9]{1,9})\n")),
                  InputError("The file '" + name +
                             "' is not a checkpoint; name one by --restart."));
      AssertThrow(words[1] == std::to_string(state_format),
                  InputError("The checkpoint '" + name + "' is of format " +
                             words[1].str() +
                             ", and this program reads format " +
                             std::to_string(state_format) + with_the_other));
    }

    Seal
    read_seal(const std::string &name, const std::string &bytes)
    {
      check_format(name, bytes);
      Seal seal;
      std::smatch words;
      const std::regex lines("^[^\n]*\nwritten by (keyblock [-+.0-9A-Za-z]+)\n"
                             "([0-9]{1,18}) bytes [^\n]* ([0-9a-f]{16})\n");
      if (std::regex_search(bytes, words, lines))
        {
          seal.program = words[1];
          seal.length  = std::stoull(words[2]);
          seal.digest  = std::stoull(words[3], nullptr, 16);
        }
      if (bytes != seal.text())
        refuse_damaged(name,
                       "its first " + std::to_string(seal_length) +
                         " bytes are not as they were written");
      return seal;
    }
  } // namespace



  std::string
  make_seal(const std::vector<char> &content)
  {
    Digest digest;
    digest.add(content.data(), content.size());
    return Seal{this_program, content.size(), digest.value()}.text();
  }



  void
  check_seal(const std::string &name)
  {
    std::ifstream file = open_file(name);
    std::string bytes(seal_length, '\0');
    file.read(&bytes[0], seal_length);
    bytes.resize(file.gcount());
    const Seal seal = read_seal(name, bytes);
    AssertThrow(seal.program == this_program,
                InputError("The checkpoint '" + name + "' was written by " +
                           seal.program + ", and this is " + this_program +
                           with_the_other));
    const std::uint64_t length = std::filesystem::file_size(name) - seal_length;
    if (length != seal.length)
      refuse_damaged(name,
                     "it has " + std::to_string(length + seal_length) +
                       " bytes instead of " +
                       std::to_string(seal.length + seal_length));
    Digest digest;
    std::vector<char> piece(piece_length);
    while (file.read(piece.data(), piece.size()) || file.gcount() > 0)
      digest.add(piece.data(), file.gcount());
    if (digest.value() != seal.digest)
      refuse_damaged(name, "its checksum is not the one it was written with");
  }
} // namespace Keyblock
