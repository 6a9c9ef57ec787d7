// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_base_communicator_h
#define keyblock_base_communicator_h

#include <keyblock/base/errors.h>

#include <mpi.h>

#include <algorithm>
#include <string>
#include <type_traits>
#include <vector>

namespace Keyblock
{
  /**
   * The ranks that share a mesh: those of the run, or those of a rank group
   * (base/rank_groups.h). Copies stand for the same ranks; none of them owns
   * the MPI communicator. All functions but size(), rank() and is_root() are
   * collective. Numbers: int, unsigned int, unsigned long long, double.
   */
  class Communicator
  {
  public:
    explicit Communicator(const MPI_Comm communicator)
      : communicator(communicator)
    {}

    operator MPI_Comm() const
    {
      return communicator;
    }

    /** Number of ranks. */
    unsigned int size() const;

    /** Number of this rank, from 0 on. */
    unsigned int rank() const;

    /** Whether this is rank 0. */
    bool
    is_root() const
    {
      return rank() == 0;
    }

    template <typename Number>
    Number sum(const Number value) const;

    template <typename Number>
    Number max(const Number value) const;

    template <typename Number>
    Number min(const Number value) const;

    /** Whether it @p is_true on any rank. */
    bool
    on_any(const bool is_true) const
    {
      return max(is_true ? 1 : 0) > 0;
    }

    /** Replace the @p n numbers from @p first on by their sums over the
     * ranks. */
    template <typename Number>
    void sum(Number *first, const std::size_t n) const;

    /** Replace the @p n numbers from @p first on by the ranks' largest. */
    template <typename Number>
    void max(Number *first, const std::size_t n) const;

    /** Replace each number of @p list, a vector or array of the same length on
     * all ranks, by its sum over the ranks. */
    template <typename List>
    void
    sum_lists(List &list) const
    {
      sum(list.data(), list.size());
    }

    /** Replace each number of @p list, a vector or array of the same length on
     * all ranks, by the ranks' largest. */
    template <typename List>
    void
    max_lists(List &list) const
    {
      max(list.data(), list.size());
    }

    /** Rank 0's @p text. */
    std::string text_of_root(const std::string &text) const;

    /** That @p text which is not empty, of the first rank that has one. */
    std::string any_text(const std::string &text) const;

    /** Copy rank 0's @p list, plain data only, to all ranks. */
    template <typename T>
    void
    broadcast(std::vector<T> &list) const
    {
      static_assert(std::is_trivially_copyable<T>::value ||
                      std::is_standard_layout<T>::value,
                    "Only plain data can be broadcast.");
      unsigned long long n = list.size();
      MPI_Bcast(&n, 1, MPI_UNSIGNED_LONG_LONG, 0, communicator);
      list.resize(n);
      const unsigned long long block = 1u << 30;
      auto *bytes                    = reinterpret_cast<char *>(list.data());
      for (unsigned long long at = 0; at < n * sizeof(T); at += block)
        MPI_Bcast(bytes + at,
                  std::min(block, n * sizeof(T) - at),
                  MPI_BYTE,
                  0,
                  communicator);
    }

    /**
     * Run @p action on rank 0. If it throws an InputError there, throw the same
     * error on all ranks.
     */
    template <typename Action>
    void
    on_root(const Action &action) const
    {
      std::string message;
      if (is_root())
        {
          try
            {
              action();
            }
          catch (const InputError &error)
            {
              message = error.message;
            }
        }
      message = text_of_root(message);
      AssertThrow(message.empty(), InputError(message));
    }

    /** Throw ComputationError on all ranks if one could not write its part of
     * @p file_name. */
    void
    assert_written(const bool is_written, const std::string &file_name) const
    {
      AssertThrow(!on_any(!is_written),
                  ComputationError("The file '" + file_name +
                                   "' cannot be written; check free space."));
    }

  private:
    MPI_Comm communicator;
  };
} // namespace Keyblock

#endif
