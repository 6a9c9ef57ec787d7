// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/step/stable_step.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Keyblock
{
  template <int dim>
  void
  StableStep<dim>::add(const StepBound &bound)
  {
    // the highest eigenvalue of a sum is at most the sum of the highest ones
    frequency = std::sqrt(frequency * frequency + bound.squared_frequency);
    damping_rate += bound.damping_rate;
  }



  template <int dim>
  double
  StableStep<dim>::damping_ratio(const Stage &stage) const
  {
    return stage.damping_ratio +
           0.5 * (stage.mass_damping + damping_rate) / frequency +
           0.5 * stage.rayleigh_stiffness() * frequency;
  }



  template <int dim>
  double
  StableStep<dim>::limit(const Stage &stage) const
  {
    // nothing is left that moves
    if (frequency == 0.)
      return std::numeric_limits<double>::infinity();
    // y = omega dt / 2 with (1 + alpha) (y^2 + 2 c y) = 1
    const double c = damping_ratio(stage);
    return 2. / frequency *
           (std::sqrt(c * c + 1. / (1. + stage.local_damping)) - c);
  }



  template <int dim>
  double
  StableStep<dim>::mass_damping_left(const Stage &stage, const double dt) const
  {
    const double y = 0.5 * frequency * dt;
    const double c = damping_ratio(stage);
    return std::max(0., 1. / (1. + stage.local_damping) - y * (y + 2. * c)) *
           frequency / y;
  }



  template struct StableStep<2>;
  template struct StableStep<3>;
} // namespace Keyblock
