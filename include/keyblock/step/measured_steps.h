// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_step_measured_steps_h
#define keyblock_step_measured_steps_h

#include <keyblock/step/step.h>

#include <utility>

namespace Keyblock
{
  /** While it lives, forces may be measured at any step, and no ledger is kept.
   */
  template <int dim>
  class MeasuredSteps
  {
  public:
    explicit MeasuredSteps(ExplicitStep<dim> &step)
      : step(step)
      , keeps_ledger(std::exchange(step.keeps_ledger, false))
      , skips_resting(std::exchange(step.skips_resting, false))
    {}

    ~MeasuredSteps()
    {
      step.keeps_ledger  = keeps_ledger;
      step.skips_resting = skips_resting;
    }

    MeasuredSteps(const MeasuredSteps &)            = delete;
    MeasuredSteps &operator=(const MeasuredSteps &) = delete;

  private:
    ExplicitStep<dim> &step;
    const bool keeps_ledger, skips_resting;
  };
} // namespace Keyblock

#endif
