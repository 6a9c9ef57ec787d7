// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_mpi_h
#define keyblock_mpi_h

#include <deal.II/base/mpi.h>

#include <keyblock/errors.h>

#include <string>
#include <type_traits>
#include <vector>

namespace Keyblock
{
  /** All ranks that share this mesh: those of the run, or of this rank's team
   * (teams.h). */
  MPI_Comm world();

  inline bool
  is_root()
  {
    return dealii::Utilities::MPI::this_mpi_process(world()) == 0;
  }

  inline unsigned int
  n_ranks()
  {
    return dealii::Utilities::MPI::n_mpi_processes(world());
  }

  inline unsigned int
  this_rank()
  {
    return dealii::Utilities::MPI::this_mpi_process(world());
  }

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
    message = dealii::Utilities::MPI::broadcast(world(), message, 0);
    AssertThrow(message.empty(), InputError(message));
  }

  /** Throw ComputationError on all ranks if one could not write its part of
   * @p file_name. */
  inline void
  assert_written(const bool is_written, const std::string &file_name)
  {
    const bool is_complete =
      dealii::Utilities::MPI::min(is_written ? 1 : 0, world()) > 0;
    AssertThrow(is_complete,
                ComputationError("The file '" + file_name +
                                 "' cannot be written; check free space."));
  }
} // namespace Keyblock

#endif
