// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/teams.h>

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
    MPI_Comm team           = MPI_COMM_WORLD;
    MPI_Comm in_use         = MPI_COMM_WORLD;
    unsigned int team_count = 1;
    unsigned int my_team    = 0;
  } // namespace



  MPI_Comm
  world()
  {
    return in_use;
  }



  void
  form_teams(const unsigned int wanted)
  {
    const unsigned int n_all =
      dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
    const unsigned int rank =
      dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
    AssertThrow(n_all % wanted == 0,
                InputError("The entry 'Safety factor/Teams' is " +
                           std::to_string(wanted) + ", and the run has " +
                           std::to_string(n_all) +
                           " ranks, which cannot be shared out evenly; give "
                           "a divisor of the number of ranks."));
    if (team != MPI_COMM_WORLD)
      MPI_Comm_free(&team);
    team       = MPI_COMM_WORLD;
    team_count = wanted;
    my_team    = rank / (n_all / wanted);
    if (wanted > 1)
      MPI_Comm_split(MPI_COMM_WORLD, my_team, rank, &team);
  }



  unsigned int
  n_teams()
  {
    return team_count;
  }



  unsigned int
  this_team()
  {
    return my_team;
  }



  std::vector<unsigned int>
  share_out(const std::vector<double> &costs, const unsigned int n_teams)
  {
    std::vector<unsigned int> order(costs.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(),
                     order.end(),
                     [&](const unsigned int a, const unsigned int b) {
                       return costs[a] > costs[b];
                     });
    std::vector<unsigned int> team(costs.size());
    std::vector<double> load(n_teams, 0.);
    for (const unsigned int job : order)
      {
        const auto least = std::min_element(load.begin(), load.end());
        team[job]        = least - load.begin();
        *least += costs[job];
      }
    return team;
  }



  TeamScope::TeamScope()
  {
    in_use = team;
    if (my_team > 0)
      std::cout.setstate(std::ios::failbit); // the first team prints
  }



  TeamScope::~TeamScope()
  {
    in_use = MPI_COMM_WORLD;
    std::cout.clear();
  }



  void
  wait_for_all_teams()
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
