// SPDX-License-Identifier: LGPL-2.1-or-later
// The slow mode by which nodes creep to rest.
#include <keyblock/safety/slow_mode.h>

#include <algorithm>
#include <cmath>

namespace Keyblock
{
  namespace
  {
    /** Checks in a row that must agree: joints that slip in fits and starts
     * show a different frequency at each. */
    constexpr unsigned int n_checks = 3;
    constexpr double same_frequency = 0.2; ///< of two frequencies [-]
  }                                        // namespace



  template <int dim>
  SlowMode<dim>::SlowMode(const Communicator &communicator,
                          const Fields<dim> &fields,
                          const std::vector<unsigned int> &nodes)
    : communicator(communicator)
    , fields(fields)
    , nodes(nodes)
    , before(take_sample())
  {}



  template <int dim>
  typename SlowMode<dim>::Sample
  SlowMode<dim>::take_sample() const
  {
    Sample sample;
    for (const unsigned int node : nodes)
      for (unsigned int i = dim * node; i < dim * (node + 1); ++i)
        {
          sample.displacement.push_back(fields.displacement[i]);
          sample.unbalanced.push_back(fields.load[i] -
                                      fields.internal_force[i] +
                                      fields.contact_force[i]);
        }
    return sample;
  }



  template <int dim>
  double
  SlowMode<dim>::check()
  {
    // omega^2 = -du.dr / (du.M du)
    Sample now = take_sample();
    std::vector<double> sums(2, 0.);
    for (unsigned int i = 0; i < now.displacement.size(); ++i)
      {
        const double way = now.displacement[i] - before.displacement[i];
        sums[0] -= way * (now.unbalanced[i] - before.unbalanced[i]);
        sums[1] += way * way * fields.mass[nodes[i / dim]];
      }
    communicator.sum_lists(sums);
    before = std::move(now);

    const double frequency =
      sums[0] > 0. && sums[1] > 0. ? std::sqrt(sums[0] / sums[1]) : 0.;
    const double difference = std::abs(frequency - last_frequency);
    if (difference < same_frequency * std::max(frequency, last_frequency))
      ++n_alike;
    else
      n_alike = 1;
    last_frequency = frequency;
    return n_alike >= n_checks ? frequency : 0.;
  }

  template class SlowMode<2>;
  template class SlowMode<3>;
} // namespace Keyblock
