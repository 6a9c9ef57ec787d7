// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_base_mpi_h
#define keyblock_base_mpi_h

#include <keyblock/base/errors.h>

#include <mpi.h>

#include <string>
#include <type_traits>
#include <vector>

namespace Keyblock
{
  /** All ranks that share this mesh: those of the run, or within a
   * RankGroupScope those of this rank's rank group (base/rank_groups.h). */
  MPI_Comm world();

  unsigned int n_ranks();

  unsigned int this_rank();

  inline bool
  is_root()
  {
    return this_rank() == 0;
  }

  // What follows is collective over world(). Numbers: int, unsigned int,
  // unsigned long long, double.

  template <typename Number>
  Number sum_over_ranks(const Number value);

  template <typename Number>
  Number max_over_ranks(const Number value);

  template <typename Number>
  Number min_over_ranks(const Number value);

  inline bool
  on_any_rank(const bool is_true)
  {
    return max_over_ranks(is_true ? 1 : 0) > 0;
  }

  /** Replace the @p n numbers from @p first on by their sums over the ranks. */
  template <typename Number>
  void sum_over_ranks(Number *first, const std::size_t n);

  /** Replace the @p n numbers from @p first on by the ranks' largest. */
  template <typename Number>
  void max_over_ranks(Number *first, const std::size_t n);

  /** Replace each number of @p list, a vector or array of the same length on
   * all ranks, by its sum over the ranks. */
  template <typename List>
  void
  sum_lists(List &list)
  {
    sum_over_ranks(list.data(), list.size());
  }

  /** Replace each number of @p list, a vector or array of the same length on
   * all ranks, by the ranks' largest. */
  template <typename List>
  void
  max_lists(List &list)
  {
    max_over_ranks(list.data(), list.size());
  }

  /** Rank 0's @p text. */
  std::string text_of_root(const std::string &text);

  /** That @p text which is not empty, of the first rank that has one. */
  std::string any_text(const std::string &text);

  /** Copy rank 0's @p list, plain data only, to all ranks. */
  template <typename T>
  void
  broadcast(std::vector<T> &list)
  {
    static_assert(std::is_trivially_copyable<T>::value ||
                    std::is_standard_layout<T>::value,
                  "Only plain data can be broadcast.");
    unsigned long long n = list.size();
    MPI_Bcast(&n, 1, MPI_UNSIGNED_LONG_LONG, 0, world());
    list.resize(n);
    const unsigned long long block = 1u << 30;
    auto *bytes                    = reinterpret_cast<char *>(list.data());
    for (unsigned long long at = 0; at < n * sizeof(T); at += block)
      MPI_Bcast(
        bytes + at, std::min(block, n * sizeof(T) - at), MPI_BYTE, 0, world());
  }

  /**
   * Run @p action on rank 0. If it throws an InputError there, throw the same
   * error on all ranks.
   */
  template <typename Action>
  void
  on_root(const Action &action)
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
  inline void
  assert_written(const bool is_written, const std::string &file_name)
  {
    AssertThrow(!on_any_rank(!is_written),
                ComputationError("The file '" + file_name +
                                 "' cannot be written; check free space."));
  }
} // namespace Keyblock

#endif
