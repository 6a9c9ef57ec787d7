// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_run_factor_progress_h
#define keyblock_run_factor_progress_h

#include <keyblock/run/progress_line.h>
#include <keyblock/safety/safety_factor.h>

#include <deal.II/base/conditional_ostream.h>

namespace Keyblock
{
  /** What the line of progress of the search for factors says.
   * @param index of the block among the @p n_blocks that are looked at
   * @param seconds left; below zero: not known */
  std::vector<ProgressField> fields_of_search(const SearchAdvance &now,
                                              const unsigned int index,
                                              const unsigned int n_blocks,
                                              const unsigned int id,
                                              const double seconds);

  /** Wall time that is left by the mean of those of @p n_blocks that are done
   * [s]; below zero: not known, as before the first, and where the last takes
   * longer.
   * @param n_begun the present one included
   * @param before what those that are done have taken [s]
   * @param in_block what the present one has taken so far [s] */
  double time_left_of_blocks(const unsigned int n_begun,
                             const unsigned int n_blocks,
                             const double before,
                             const double in_block);

  /** The line of progress while the factors of blocks are looked for; it is
   * gone when this is. */
  class FactorProgress
  {
  public:
    FactorProgress(const dealii::ConditionalOStream &out,
                   const unsigned int n_blocks);
    ~FactorProgress();
    FactorProgress(const FactorProgress &)            = delete;
    FactorProgress &operator=(const FactorProgress &) = delete;

    /** The search for the factor of the next block begins. */
    void begin_block(const unsigned int id);

    /** Print the line if it is time to. */
    void show(const SearchAdvance &now);

    /** Let what follows begin where the line does. */
    void clear();

  private:
    const dealii::ConditionalOStream &out;
    const unsigned int n_blocks;
    const double start;       ///< wall time [s]
    double block_start;       ///< of the present block [s]
    double last_printed;      ///< wall time [s]
    unsigned int n_begun = 0; ///< blocks
    unsigned int id      = 0; ///< of the present one
    bool is_on_screen    = false;
  };
} // namespace Keyblock

#endif
