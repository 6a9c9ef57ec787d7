// SPDX-License-Identifier: LGPL-2.1-or-later
// Which other blocks have to do with the failure of one.
#include <keyblock/safety/strength_trial.h>

#include <algorithm>

namespace Keyblock
{
  namespace
  {
    /** Way of another block, in the direction of the one that fails and over
     * its way, from which on they move together [-]. */
    constexpr double along_share = 0.5;

    /** The same, in any direction, from which on it moves at all [-]. */
    constexpr double moving_share = 0.1;
  } // namespace



  template <int dim>
  bool
  StrengthTrials<dim>::is_finite(const unsigned int block) const
  {
    return !blocks.blocks[block].is_infinite && !blocks.blocks[block].is_rigid;
  }



  template <int dim>
  void
  StrengthTrials<dim>::note_blocks_that_moved(const unsigned int block)
  {
    // mean ways of the blocks in the second phase
    const unsigned int n_blocks = blocks.blocks.size();
    std::vector<double> sums((dim + 1) * n_blocks, 0.);
    for (unsigned int b = 0; b < n_blocks; ++b)
      for (const unsigned int node : nodes_of_block[b])
        {
          const double m = run.fields.mass[node];
          for (unsigned int d = 0; d < dim; ++d)
            sums[(dim + 1) * b + d] +=
              m * (run.fields.displacement[dim * node + d] -
                   displacement_before[dim * node + d]);
          sums[(dim + 1) * b + dim] += m;
        }
    communicator.sum_lists(sums);
    const auto way = [&](const unsigned int b) {
      Vector<dim> mean{};
      for (unsigned int d = 0; d < dim && sums[(dim + 1) * b + dim] > 0.; ++d)
        mean[d] = sums[(dim + 1) * b + d] / sums[(dim + 1) * b + dim];
      return mean;
    };
    const Vector<dim> own = way(block);
    last_along.clear();
    last_moving.clear();
    for (unsigned int b = 0; b < n_blocks; ++b)
      if (b != block && is_finite(b))
        {
          if (dot<dim>(way(b), own) > along_share * dot<dim>(own, own))
            last_along.push_back(b);
          if (norm<dim>(way(b)) > moving_share * norm<dim>(own))
            last_moving.push_back(b);
        }
  }



  template <int dim>
  std::vector<unsigned int>
  StrengthTrials<dim>::blocks_pressed_on(const unsigned int block) const
  {
    std::vector<unsigned int> group = companions;
    group.push_back(block);
    std::vector<unsigned int> pressed;
    for (const unsigned int b : group)
      for (const unsigned int other :
           run.contact->report().list_blocks_pressed_on(b))
        if (is_finite(other) &&
            std::count(group.begin(), group.end(), other) == 0)
          pressed.push_back(other);
    std::sort(pressed.begin(), pressed.end());
    pressed.erase(std::unique(pressed.begin(), pressed.end()), pressed.end());
    return pressed;
  }

  template bool StrengthTrials<2>::is_finite(const unsigned int) const;
  template bool StrengthTrials<3>::is_finite(const unsigned int) const;
  template void StrengthTrials<2>::note_blocks_that_moved(const unsigned int);
  template void StrengthTrials<3>::note_blocks_that_moved(const unsigned int);
  template std::vector<unsigned int>
  StrengthTrials<2>::blocks_pressed_on(const unsigned int) const;
  template std::vector<unsigned int>
  StrengthTrials<3>::blocks_pressed_on(const unsigned int) const;
} // namespace Keyblock
