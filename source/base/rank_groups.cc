// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/rank_groups.h>

#include <algorithm>
#include <chrono>
#include <numeric>
#include <thread>

namespace Keyblock
{
  RankGroups::RankGroups(const Communicator &all, const unsigned int wanted)
    : all(all)
    , n_groups(wanted)
    , group_index(0)
    , group(all)
  {
    AssertThrow(all.size() % wanted == 0,
                InputError("The entry 'Safety factor/Rank groups' is " +
                           std::to_string(wanted) + ", and the run has " +
                           std::to_string(all.size()) +
                           " ranks, which cannot be shared out evenly; give "
                           "a divisor of the number of ranks."));
    group_index = all.rank() / (all.size() / wanted);
    if (wanted > 1)
      MPI_Comm_split(all, group_index, all.rank(), &group);
  }



  RankGroups::~RankGroups()
  {
    if (n_groups > 1)
      MPI_Comm_free(&group);
  }



  void
  RankGroups::wait_for_all() const
  {
    MPI_Request request;
    MPI_Ibarrier(all, &request);
    for (int is_complete = 0; !is_complete;)
      {
        MPI_Test(&request, &is_complete, MPI_STATUS_IGNORE);
        if (!is_complete)
          std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
  }



  std::vector<unsigned int>
  share_out(const std::vector<double> &costs, const unsigned int n_rank_groups)
  {
    std::vector<unsigned int> order(costs.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(),
                     order.end(),
                     [&](const unsigned int a, const unsigned int b) {
                       return costs[a] > costs[b];
                     });
    std::vector<unsigned int> group(costs.size());
    std::vector<double> load(n_rank_groups, 0.);
    for (const unsigned int job : order)
      {
        const auto least = std::min_element(load.begin(), load.end());
        group[job]       = least - load.begin();
        *least += costs[job];
      }
    return group;
  }
} // namespace Keyblock
