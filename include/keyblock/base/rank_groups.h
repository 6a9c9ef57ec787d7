// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_base_rank_groups_h
#define keyblock_base_rank_groups_h

#include <keyblock/base/communicator.h>

#include <vector>

namespace Keyblock
{
  /**
   * All ranks, split into groups of as many each. All ranks compute the stages
   * together; then each rank group takes the state, and looks for the safety
   * factors of some of the blocks.
   */
  class RankGroups
  {
  public:
    /** Split @p all into @p wanted groups (collective over all ranks). Throws
     * InputError if their number does not divide that of the ranks. */
    RankGroups(const Communicator &all, const unsigned int wanted);
    ~RankGroups();
    RankGroups(const RankGroups &)            = delete;
    RankGroups &operator=(const RankGroups &) = delete;

    /** Number of groups. */
    unsigned int
    n() const
    {
      return n_groups;
    }

    /** Number of this rank's group, from 0 on. */
    unsigned int
    index() const
    {
      return group_index;
    }

    /** The ranks of this rank's group. */
    Communicator
    mine() const
    {
      return Communicator(group);
    }

    /** Until every rank of every group is here, without using the core. */
    void wait_for_all() const;

    const Communicator all;

  private:
    unsigned int n_groups, group_index;
    MPI_Comm group; ///< owned if there are several
  };

  /** Which of @p n_rank_groups does each of the jobs with @p costs: the
   * costliest job first, each to the rank group that has least to do. */
  std::vector<unsigned int> share_out(const std::vector<double> &costs,
                                      const unsigned int n_rank_groups);
} // namespace Keyblock

#endif
