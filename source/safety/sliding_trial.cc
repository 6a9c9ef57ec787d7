// SPDX-License-Identifier: LGPL-2.1-or-later
// A block that rests above its limit equilibrium is asked again as it slides.
#include <keyblock/safety/strength_trial.h>

#include <cmath>
#include <numeric>
#include <vector>

namespace Keyblock
{
  namespace
  {
    // factor by which joints are weakened to make a block that holds slide on
    constexpr double weakening      = 1.02; ///< a period of the block [-]
    constexpr double most_weakening = 1.5;  ///< in all [-]

    /** Windows over which the speed of sliding is measured, and the part of the
     * first speed below which the block counts as stopped [-]. */
    constexpr unsigned int least_windows = 5, most_windows = 40;
    constexpr double stopped = 1e-2;

    /** Multiple of its standard error from which on a trend is certain [-]. */
    constexpr double certain = 3.;

    /** Straight line of least squares through values at equal distances. */
    struct Trend
    {
      double slope = 0., error = 0.; ///< and its standard error, per value

      explicit Trend(const std::vector<double> &values)
      {
        const double n = values.size(), middle = 0.5 * (n - 1.);
        const double mean =
          std::accumulate(values.begin(), values.end(), 0.) / n;
        const double squares = n * (n * n - 1.) / 12.;
        for (unsigned int i = 0; i < values.size(); ++i)
          slope += (i - middle) * (values[i] - mean) / squares;
        for (unsigned int i = 0; i < values.size(); ++i)
          error += std::pow(values[i] - mean - slope * (i - middle), 2);
        error = std::sqrt(error / (n - 2.) / squares);
      }
    };
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
    return true;
  }



  template <int dim>
  bool
  StrengthTrials<dim>::slides_faster(const TriedBlocks &tried,
                                     const Vector<dim> &first,
                                     Trial &trial)
  {
    const unsigned int window = watched_window(tried);
    const Vector<dim> begin   = measures.motion(tried).velocity;
    std::vector<double> speed(1, norm<dim>(begin));
    failure.begin(run.contact->report().mean_slip(tried.block));
    for (unsigned int w = 1; w <= most_windows; ++w)
      {
        pause();
        for (unsigned int step = 0; step < window; ++step)
          run.step.advance(false);
        trial.n_steps += window;
        const Motion now = measures.motion(tried);
        failure.add(run.contact->report().sum_over_block(tried.block));
        speed.push_back(dot<dim>(now.velocity, begin) / speed[0]);
        const Trend trend(speed);
        trial.phase        = 2;
        trial.slip         = norm<dim>(add<dim>(now.slip, -1., first));
        trial.unbalanced   = now.unbalanced;
        trial.velocity     = speed.back();
        trial.acceleration = trend.slope / (window * run.step.dt);
        if (speed.back() < stopped * speed[0])
          return false;
        if (w >= least_windows && std::abs(trend.slope) > certain * trend.error)
          break;
      }
    return trial.acceleration > 0.;
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
    if (slide_on(tried, trial) && slides_faster(tried, first, trial) &&
        weakened_area() == before)
      return Verdict::fails;
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
  template bool StrengthTrials<2>::slides_faster(const TriedBlocks &,
                                                 const Vector<2> &,
                                                 Trial &);
  template StrengthTrials<3>::Verdict
  StrengthTrials<3>::decide_as_it_slides(const TriedBlocks &,
                                         const unsigned int,
                                         const Vector<3> &,
                                         Trial &);
  template bool StrengthTrials<3>::slide_on(const TriedBlocks &, Trial &);
  template bool StrengthTrials<3>::slides_faster(const TriedBlocks &,
                                                 const Vector<3> &,
                                                 Trial &);
} // namespace Keyblock
