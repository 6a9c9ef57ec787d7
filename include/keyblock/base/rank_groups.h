// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_base_rank_groups_h
#define keyblock_base_rank_groups_h

#include <vector>

namespace Keyblock
{
  // Rank groups. All ranks compute the stages together; then each rank group
  // takes the state, and looks for the safety factors of some of the blocks.

  /** Split all ranks into @p wanted rank groups (collective over all ranks).
   * Throws InputError if their number does not divide that of the ranks. */
  void form_rank_groups(const unsigned int wanted);

  unsigned int n_rank_groups();

  unsigned int this_rank_group();

  /** Which of @p n_rank_groups does each of the jobs with @p costs: the
   * costliest job first, each to the rank group that has least to do. */
  std::vector<unsigned int> share_out(const std::vector<double> &costs,
                                      const unsigned int n_rank_groups);

  /** While it lives, world() is the ranks of this rank group alone. */
  class RankGroupScope
  {
  public:
    RankGroupScope();
    ~RankGroupScope();
    RankGroupScope(const RankGroupScope &)            = delete;
    RankGroupScope &operator=(const RankGroupScope &) = delete;
  };

  /** Until every rank of every rank group is here, without using the core. */
  void wait_for_all_rank_groups();
} // namespace Keyblock

#endif
