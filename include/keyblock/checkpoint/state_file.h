// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_checkpoint_state_file_h
#define keyblock_checkpoint_state_file_h

#include <keyblock/base/communicator.h>

#include <cstdint>

namespace Keyblock
{
  /**
   * Named lists of numbers and texts in an HDF5 file behind a seal, names like
   * `run/time`.
   * One call of exchange() serves both directions: it hands the value to a file
   * that is being made, or sets it from one that is read. Only rank 0 touches
   * the file; its values are the ones that are saved, and what is read is the
   * same on all ranks. All functions are collective.
   *
   * A new file is put together in memory, so that write() cannot leave half of
   * one behind.
   */
  class StateFile
  {
  public:
    /** A new file. */
    explicit StateFile(const Communicator &communicator);

    /** Read the file called @p name, if its seal is in order
     * (checkpoint/state_seal.h). Throws InputError. */
    StateFile(const Communicator &communicator, const std::string &name);

    /** Read what image() of another file gave. */
    StateFile(const Communicator &communicator, std::vector<char> &image);

    ~StateFile();
    StateFile(const StateFile &)            = delete;
    StateFile &operator=(const StateFile &) = delete;

    bool
    is_read() const
    {
      return !name.empty();
    }

    void exchange(const std::string &entry, std::vector<double> &list);
    void exchange(const std::string &entry, std::vector<unsigned int> &list);
    void exchange(const std::string &entry, std::vector<std::uint64_t> &list);
    void exchange(const std::string &entry, std::string &text);
    void exchange(const std::string &entry, double &value);
    void exchange(const std::string &entry, unsigned int &value);
    void exchange(const std::string &entry, std::uint64_t &value);
    void exchange(const std::string &entry, bool &value);
    void exchange(const std::string &entry, std::vector<bool> &list);

    /** Texts without line breaks. */
    void exchange(const std::string &entry, std::vector<std::string> &list);

    /** Values of which every rank has a share that counts in a sum: back to
     * their ranks if there are as many, else the sum to rank 0. */
    void exchange_shares(const std::string &entry,
                         const std::vector<double *> &values);

    /** The bytes of a new file, the same on all ranks. */
    std::vector<char> image() const;

    /**
     * Write a new file to disk under @p file_name, complete or not at all: as
     * @p file_name.part, which is renamed at last. Returns why that failed, or
     * an empty text.
     */
    std::string write(const std::string &file_name) const;

    const Communicator communicator;

  private:
    template <typename T>
    void exchange_list(const std::string &entry, std::vector<T> &list);

    std::string name;       ///< of the file that is read
    std::int64_t file = -1; ///< HDF5's handle, on rank 0
  };
} // namespace Keyblock

#endif
