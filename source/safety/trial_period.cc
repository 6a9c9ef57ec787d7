// SPDX-License-Identifier: LGPL-2.1-or-later
// How slowly the blocks of a trial move.
#include <keyblock/safety/trial_measures.h>
#include <keyblock/step/block_balance.h>

#include <algorithm>
#include <cmath>

namespace Keyblock
{
  namespace
  {
    /** Force through a block from joint to joint over its load, from which on
     * it is clamped [-]. */
    constexpr double clamping_loads = 3.;
  } // namespace



  template <int dim>
  double
  TrialMeasures<dim>::n_across(const unsigned int block) const
  {
    const Block<dim> &b = blocks.blocks[block];
    return std::max(4., b.size / std::pow(b.volume / b.n_cells, 1. / dim));
  }



  template <int dim>
  unsigned int
  TrialMeasures<dim>::period(const unsigned int block) const
  {
    return std::ceil(4. * n_across(block) / scene.time_stepping.safety);
  }



  template <int dim>
  double
  TrialMeasures<dim>::slowness(const TriedBlocks &tried) const
  {
    const double own = n_across(tried.block);
    double slowest   = own;
    for (const unsigned int other : tried.others())
      {
        const Block<dim> &b = blocks.blocks[other];
        const double load =
          measure_balance(run.fields, nodes_of_block[other], communicator).load;
        // what stress clamps does not rock
        const double slender =
          force_through(other) > clamping_loads * load
            ? 1.
            : std::pow(b.size, dim) / (b.volume * std::pow(dim, 0.5 * dim));
        slowest = std::max(slowest, n_across(other) * slender);
      }
    return slowest / own;
  }

#define INSTANTIATE(dim)                                                       \
  template double TrialMeasures<dim>::n_across(const unsigned int) const;      \
  template unsigned int TrialMeasures<dim>::period(const unsigned int) const;  \
  template double TrialMeasures<dim>::slowness(const TriedBlocks &) const;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock
