// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_step_measured_steps_h
#define keyblock_step_measured_steps_h

#include <keyblock/step/step.h>

#include <utility>

namespace Keyblock
{
  /** While it lives, forces may be measured at any step, no ledger is kept, and
   * time stands: steps look for the equilibrium of this moment. */
  template <int dim>
  class MeasuredSteps
  {
  public:
    explicit MeasuredSteps(ExplicitStep<dim> &step)
      : step(step)
      , keeps_ledger(std::exchange(step.keeps_ledger, false))
      , skips_resting(std::exchange(step.skips_resting, false))
    {
      step.hold_time(true);
    }

    ~MeasuredSteps()
    {
      step.keeps_ledger  = keeps_ledger;
      step.skips_resting = skips_resting;
      step.hold_time(false);
    }

    MeasuredSteps(const MeasuredSteps &)            = delete;
    MeasuredSteps &operator=(const MeasuredSteps &) = delete;

  private:
    ExplicitStep<dim> &step;
    const bool keeps_ledger, skips_resting;
  };
} // namespace Keyblock

#endif
