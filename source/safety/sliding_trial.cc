// SPDX-License-Identifier: LGPL-2.1-or-later
// A block that rests above its limit equilibrium is asked again as it slides.
#include <keyblock/safety/strength_trial.h>

#include <cmath>
#include <numeric>

namespace Keyblock
{
  namespace
  {
    // factor by which joints are weakened to make a block that holds slide on
    constexpr double weakening      = 1.02; ///< a period of the block [-]
    constexpr double most_weakening = 1.5;  ///< in all [-]

  } // namespace



  template <int dim>
  bool
  StrengthTrials<dim>::slide_on(const TriedBlocks &tried, Trial &trial)
  {
    const Motion begin = measures.motion(tried);
    const double way   = measures.compression(tried.block, begin.load) +
                       measures.elastic_slip(tried.block);
    const auto slip = [&]() {
      return norm<dim>(add<dim>(measures.motion(tried).slip, -1., begin.slip));
    };
    const auto step_on = [&](const unsigned int n_steps) {
      for (unsigned int step = 0; step < n_steps; ++step)
        run.step.advance(false);
      trial.n_steps += n_steps;
    };
    const unsigned int period = measures.period(tried.block);
    double weaker             = 1.;
    for (; weaker < most_weakening && slip() < way; step_on(period))
      {
        pause();
        weaker *= weakening;
        reduce(tried, weaker * trial.factor);
      }
    if (slip() < way)
      return false;
    for (unsigned int step = 1; step <= period; ++step)
      {
        reduce(tried,
               trial.factor *
                 std::pow(weaker, 1. - static_cast<double>(step) / period));
        step_on(1);
      }
    // by its own momentum
    const unsigned int window = watched_window(tried);
    const double restored     = slip();
    double before = 0., now = restored;
    for (double waited = 0.; now > before && now < restored + way &&
                             waited < scene.safety.maximum_periods;
         waited += scene.safety.window)
      {
        pause();
        before = now;
        step_on(window);
        now = slip();
      }
    return true;
  }



  template <int dim>
  typename StrengthTrials<dim>::Verdict
  StrengthTrials<dim>::decide_as_it_slides(const TriedBlocks &tried,
                                           const unsigned int number,
                                           const Vector<dim> &first,
                                           Trial &trial)
  {
    const auto weakened_area = [&]() {
      const auto area = run.contact->report().weakened_area(tried.block);
      return std::accumulate(area.begin(), area.end(), 0.);
    };
    const double before          = weakened_area();
    const Snapshot<dim> at_rest  = take_snapshot(run);
    const Trial trial_until_rest = trial;
    run.step.begin_stage(moving_stage(), number);
    if (slide_on(tried, trial) && weakened_area() == before)
      {
        run.step.begin_stage(moving_stage(), number);
        const Verdict verdict = watch(tried, watch_periods, first, trial);
        return verdict == Verdict::open
                 ? decide(tried, number, trial.factor, first, trial)
                 : verdict;
      }
    // it does not slide, or not without a loss of what it holds by
    recall(at_rest, run);
    reduce(tried, trial.factor);
    run.step.begin_stage(quiet_stage(tried), number);
    const unsigned int n_steps = trial.n_steps;
    trial                      = trial_until_rest;
    trial.n_steps              = n_steps;
    return Verdict::holds;
  }

  template StrengthTrials<2>::Verdict
  StrengthTrials<2>::decide_as_it_slides(const TriedBlocks &,
                                         const unsigned int,
                                         const Vector<2> &,
                                         Trial &);
  template bool StrengthTrials<2>::slide_on(const TriedBlocks &, Trial &);
  template StrengthTrials<3>::Verdict
  StrengthTrials<3>::decide_as_it_slides(const TriedBlocks &,
                                         const unsigned int,
                                         const Vector<3> &,
                                         Trial &);
  template bool StrengthTrials<3>::slide_on(const TriedBlocks &, Trial &);
} // namespace Keyblock
