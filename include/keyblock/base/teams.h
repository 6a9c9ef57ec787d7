// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_base_teams_h
#define keyblock_base_teams_h

#include <vector>

namespace Keyblock
{
  // Teams of ranks. All ranks compute the stages together; then each team takes
  // the state, and looks for the safety factors of some of the blocks.

  /** Split all ranks into @p wanted teams (collective over all ranks). Throws
   * InputError if their number does not divide that of the ranks. */
  void form_teams(const unsigned int wanted);

  unsigned int n_teams();

  unsigned int this_team();

  /** Which of @p n_teams does each of the jobs with @p costs: the costliest
   * job first, each to the team that has least to do. */
  std::vector<unsigned int> share_out(const std::vector<double> &costs,
                                      const unsigned int n_teams);

  /** While it lives, world() is the ranks of this team alone. */
  class TeamScope
  {
  public:
    TeamScope();
    ~TeamScope();
    TeamScope(const TeamScope &)            = delete;
    TeamScope &operator=(const TeamScope &) = delete;
  };

  /** Until every rank of every team is here, without using the core. */
  void wait_for_all_teams();
} // namespace Keyblock

#endif
