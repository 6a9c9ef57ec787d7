// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/rank_groups.h>

#include <deal.II/base/mpi.h>

#include <keyblock/base/mpi.h>

#include <algorithm>
#include <chrono>
#include <iostream>
#include <numeric>
#include <thread>

namespace Keyblock
{
  namespace
  {
    MPI_Comm group           = MPI_COMM_WORLD;
    MPI_Comm in_use          = MPI_COMM_WORLD;
    unsigned int group_count = 1;
    unsigned int my_group    = 0;
  } // namespace



  MPI_Comm
  world()
  {
    return in_use;
  }



  void
  form_rank_groups(const unsigned int wanted)
  {
    const unsigned int n_all =
      dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
    const unsigned int rank =
      dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
    AssertThrow(n_all % wanted == 0,
                InputError("The entry 'Safety factor/Rank groups' is " +
                           std::to_string(wanted) + ", and the run has " +
                           std::to_string(n_all) +
                           " ranks, which cannot be shared out evenly; give "
                           "a divisor of the number of ranks."));
    if (group != MPI_COMM_WORLD)
      MPI_Comm_free(&group);
    group       = MPI_COMM_WORLD;
    group_count = wanted;
    my_group    = rank / (n_all / wanted);
    if (wanted > 1)
      MPI_Comm_split(MPI_COMM_WORLD, my_group, rank, &group);
  }



  unsigned int
  n_rank_groups()
  {
    return group_count;
  }



  unsigned int
  this_rank_group()
  {
    return my_group;
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



  RankGroupScope::RankGroupScope()
  {
    in_use = group;
    if (my_group > 0)
      std::cout.setstate(std::ios::failbit); // the first rank group prints
  }



  RankGroupScope::~RankGroupScope()
  {
    in_use = MPI_COMM_WORLD;
    std::cout.clear();
  }



  void
  wait_for_all_rank_groups()
  {
    MPI_Request request;
    MPI_Ibarrier(MPI_COMM_WORLD, &request);
    for (int is_complete = 0; !is_complete;)
      {
        MPI_Test(&request, &is_complete, MPI_STATUS_IGNORE);
        if (!is_complete)
          std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
  }
} // namespace Keyblock
