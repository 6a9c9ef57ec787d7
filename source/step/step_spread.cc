// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/step/step_spread.h>


#include <algorithm>

namespace Keyblock
{
  namespace
  {
    /** Lists of all ranks, one after the other, on rank 0. */
    std::vector<double>
    gather_on_root(const Communicator &communicator,
                   const std::vector<double> &mine)
    {
      const int n = mine.size();
      std::vector<int> counts(communicator.size()),
        begin(communicator.size(), 0);
      MPI_Gather(&n, 1, MPI_INT, counts.data(), 1, MPI_INT, 0, communicator);
      for (unsigned int r = 1; r < communicator.size(); ++r)
        begin[r] = begin[r - 1] + counts[r - 1];
      std::vector<double> all(
        communicator.is_root() ? begin.back() + counts.back() : 0);
      MPI_Gatherv(mine.data(),
                  n,
                  MPI_DOUBLE,
                  all.data(),
                  counts.data(),
                  begin.data(),
                  MPI_DOUBLE,
                  0,
                  communicator);
      return all;
    }

    double
    median_of(std::vector<double> &list)
    {
      const auto middle = list.begin() + list.size() / 2;
      std::nth_element(list.begin(), middle, list.end());
      return list.size() % 2 == 1
               ? *middle
               : 0.5 * (*middle + *std::max_element(list.begin(), middle));
    }
  } // namespace



  StiffestCell
  find_stiffest(const Communicator &communicator,
                const std::vector<double> &frequency,
                const std::vector<unsigned int> &mesh_cell)
  {
    StiffestCell stiffest;
    for (const double omega : frequency)
      stiffest.frequency = std::max(stiffest.frequency, omega);
    stiffest.frequency = communicator.max(stiffest.frequency);
    for (unsigned int c = 0; c < frequency.size(); ++c)
      if (frequency[c] == stiffest.frequency)
        stiffest.cell = std::min(stiffest.cell, mesh_cell[c]);
    stiffest.cell = communicator.min(stiffest.cell);
    return stiffest;
  }



  template <int dim>
  StepSpread<dim>
  measure_step_spread(const Communicator &communicator,
                      const std::vector<double> &frequency,
                      const std::vector<unsigned int> &mesh_cell,
                      const Mesh<dim> &mesh)
  {
    StepSpread<dim> spread;
    const StiffestCell stiffest =
      find_stiffest(communicator, frequency, mesh_cell);
    spread.cell = stiffest.cell;
    if (spread.cell == none)
      return spread;
    spread.place = mesh.cell_center(spread.cell);
    spread.least = 2. / stiffest.frequency;
    std::vector<double> steps(frequency.size());
    std::transform(frequency.begin(),
                   frequency.end(),
                   steps.begin(),
                   [](const double omega) { return 2. / omega; });
    steps = gather_on_root(communicator, steps);
    std::vector<double> median(1,
                               communicator.is_root() ? median_of(steps) : 0.);
    communicator.broadcast(median);
    spread.median = median[0];
    return spread;
  }

  template struct StepSpread<2>;
  template struct StepSpread<3>;
  template StepSpread<2> measure_step_spread(const Communicator &,
                                             const std::vector<double> &,
                                             const std::vector<unsigned int> &,
                                             const Mesh<2> &);
  template StepSpread<3> measure_step_spread(const Communicator &,
                                             const std::vector<double> &,
                                             const std::vector<unsigned int> &,
                                             const Mesh<3> &);
} // namespace Keyblock
