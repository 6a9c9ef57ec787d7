// SPDX-License-Identifier: LGPL-2.1-or-later
// The factor of a group is that of each of its blocks.
#include <keyblock/safety/safety_factor.h>

#include <algorithm>
#include <utility>

namespace Keyblock
{
  bool
  SafetyFactor::has_own_group() const
  {
    // a trial of a weaker neighbor may have held
    return !group.empty() &&
           std::any_of(trials.begin(), trials.end(), [&](const Trial &trial) {
             return trial.is_of_group && trial.factor == group_upper;
           });
  }



  namespace
  {
    /** By which of two demands tell how much they ask for. */
    std::pair<int, double>
    size_of(const TriedDemand &demand)
    {
      using Outcome = TriedDemand::Outcome;
      return {demand.outcome == Outcome::out_of_reach ? 3
              : demand.outcome == Outcome::undecided  ? 2
              : demand.outcome == Outcome::bracketed  ? 1
                                                      : 0,
              demand.force()};
    }

    /** Let the @p member of a group that lacks the wanted factor ask for what
     * the group asks for. */
    void
    share_demand(const SafetyFactor &finder, SafetyFactor &member)
    {
      if (finder.group_lower >= finder.support_demand.factor ||
          size_of(finder.tried_demand) <= size_of(member.tried_demand))
        return;
      member.tried_demand = finder.tried_demand;
      member.tried_demand.trials.clear();
    }
  } // namespace



  template <int dim>
  std::vector<unsigned int>
  share_last_group(const Blocks<dim> &blocks,
                   std::vector<SafetyFactor> &factors)
  {
    // whether `member` takes over the group that was found for `finder`: not if
    // it fails by itself before. Of the same blocks, whichever fails first
    // tells
    const auto shares = [&](const SafetyFactor &finder, SafetyFactor &member) {
      const bool is_same = member.group == finder.group;
      if (!finder.has_own_group() || (member.has_own_group() && !is_same) ||
          finder.stage != member.stage ||
          std::count(finder.group.begin(),
                     finder.group.end(),
                     blocks.blocks[member.block].id) == 0 ||
          (!member.group.empty() &&
           member.value_of_group() <= finder.value_of_group()) ||
          (!is_same && member.outcome == SafetyFactor::Outcome::bracketed &&
           member.upper < finder.group_lower))
        return false;
      share_demand(finder, member);
      member.group                 = finder.group;
      member.group_lower           = finder.group_lower;
      member.group_upper           = finder.group_upper;
      member.group_undecided_lower = finder.group_undecided_lower;
      member.group_undecided_upper = finder.group_undecided_upper;
      return true;
    };
    std::vector<unsigned int> told;
    SafetyFactor &last = factors.back();
    for (unsigned int i = 0; i + 1 < factors.size(); ++i)
      {
        shares(factors[i], last);
        if (shares(last, factors[i]))
          told.push_back(i);
      }
    return told;
  }

  template std::vector<unsigned int>
  share_last_group(const Blocks<2> &, std::vector<SafetyFactor> &);
  template std::vector<unsigned int>
  share_last_group(const Blocks<3> &, std::vector<SafetyFactor> &);
} // namespace Keyblock
