// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/step/ramp.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>

namespace Keyblock
{
  namespace
  {
    double
    share_left_at(const double progress)
    {
      return 0.5 * (1. + std::cos(dealii::numbers::PI * progress));
    }
  } // namespace



  Ramp
  Ramp::over(const double duration)
  {
    Ramp ramp;
    ramp.duration = duration;
    ramp.progress = duration > 0. ? 0. : 1.;
    return ramp;
  }



  double
  Ramp::share_left() const
  {
    return share_left_at(progress);
  }



  double
  Ramp::share_of_step(const double step) const
  {
    return share_left() - share_left_at(progress_after(step));
  }



  void
  Ramp::advance(const double step)
  {
    progress = progress_after(step);
  }



  double
  Ramp::progress_after(const double step) const
  {
    return is_running() ? std::min(1., progress + pace * step / duration) : 1.;
  }
} // namespace Keyblock
