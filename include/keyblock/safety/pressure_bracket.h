// SPDX-License-Identifier: LGPL-2.1-or-later
// The search for a pressure; for demand_search.cc alone.
#ifndef keyblock_safety_pressure_bracket_h
#define keyblock_safety_pressure_bracket_h

#include <keyblock/safety/block_statics.h>
#include <keyblock/safety/factor_bracket.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace Keyblock
{
  /** The pressures that were tried, and what all trials begin from. The bracket
   * is that of the reciprocal of the pressure, as a block holds at small ones,
   * and fails at large ones. */
  template <int dim>
  class StrengthReductionSearch<dim>::PressureSearch
  {
  public:
    /** @param is_at_rest whether the block is at rest now, before trials change
     * the pressure; else they put it on at once */
    PressureSearch(StrengthReductionSearch &owner,
                   const TriedBlocks &to_try,
                   const PressedBlock<dim> &pressed,
                   const unsigned int number,
                   const double start,
                   const bool is_at_rest,
                   TriedDemand &demand)
      : owner(owner)
      , origin(owner, to_try, number, start)
      , pressed(pressed)
      , is_at_rest(is_at_rest)
      , share(owner.scene.safety.bracket)
      , demand(demand)
    {}

    /** Let the pressure act on the free faces of all blocks that are @p tried,
     * for one whose own cancel each other.
     * @param unbalanced first guess of the pressure over their load [-] */
    static PressedBlock<dim> press_on_group(StrengthReductionSearch &owner,
                                            const TriedBlocks &tried,
                                            const double unbalanced);

    /** @param fails_without whether the block is known to fail without */
    TriedDemand::Outcome
    find(const bool fails_without)
    {
      if (!fails_without && try_pressure(0.).is_stable)
        return TriedDemand::Outcome::met;
      if (pressed.unit == 0.)
        return TriedDemand::Outcome::out_of_reach;
      const double spread = 1. + 0.4 * share;
      for (const double p :
           {spread * pressed.first_guess, pressed.first_guess / spread})
        if (relief.is_open(1. / p))
          try_pressure(p);
      const TriedDemand::Outcome outcome = find_bracket();
      if (outcome != TriedDemand::Outcome::bracketed)
        return outcome;
      while (relief.unstable > 0. && !relief.is_narrow(share))
        try_pressure(1. / relief.next());
      return outcome;
    }

    /** Note the bounds, and go back to the state before the first trial. */
    void
    finish()
    {
      const auto pressure_of = [](const double number) {
        return number > 0. ? 1. / number : 0.;
      };
      demand.lower           = pressure_of(relief.unstable);
      demand.upper           = pressure_of(relief.stable);
      demand.undecided_lower = pressure_of(relief.undecided_upper);
      demand.undecided_upper = pressure_of(relief.undecided_lower);
      origin.finish();
    }

  private:
    /** Part of the way of a block that fails, along the pressure, from which on
     * it is the pressure that drives it [-]. */
    static constexpr double driven_share = 0.1;

    /** Trials between what is too little and what drives the block elsewhere.
     */
    static constexpr unsigned int most_between = 8;

    /** First, second and further steps away from the first guess [-]. */
    static constexpr std::array<double, 3> steps_up   = {{1.25, 2., 4.}},
                                           steps_down = {{0.8, 0.5, 0.5}};

    static double
    step_number(const std::array<double, 3> &steps, unsigned int &n)
    {
      return steps[std::min<unsigned int>(n++, steps.size() - 1)];
    }

    /** Try pressures further and further from those that were, until one holds
     * and one fails, or is none. */
    TriedDemand::Outcome
    find_bracket()
    {
      unsigned int n_between = 0, n_up = 0, n_down = 0;
      while (relief.stable == 0.)
        {
          const bool is_between = driven_from > 0.;
          const double p        = is_between ? between_failures()
                                             : step_number(steps_up, n_up) * largest;
          if (is_between ? ++n_between > most_between ||
                             driven_from - too_little() <= share * driven_from
                         : p > most_demand * pressed.unit)
            return TriedDemand::Outcome::out_of_reach;
          if (relief.is_hopeless())
            return TriedDemand::Outcome::undecided;
          try_pressure(p);
        }
      while (relief.unstable == 0.)
        {
          const double p = step_number(steps_down, n_down) * smallest;
          // so little is none
          if (p < least_demand * pressed.unit)
            break;
          if (relief.is_hopeless())
            return TriedDemand::Outcome::undecided;
          try_pressure(p);
        }
      return TriedDemand::Outcome::bracketed;
    }

    double
    too_little() const
    {
      return relief.unstable > 0. ? 1. / relief.unstable : 0.;
    }

    /** Between too little and what drives the block elsewhere. */
    double
    between_failures() const
    {
      const double low = too_little();
      return low > 0. && driven_from > 2. * low ? std::sqrt(low * driven_from)
                                                : 0.5 * (low + driven_from);
    }

    /** One with @p pressure [Pa]. */
    Trial
    try_pressure(const double pressure)
    {
      const double wanted = owner.scene.safety.wanted;
      origin.tell_trial(owner.advance.lower, owner.advance.upper);
      recall(origin.state, owner.run);
      if (!is_at_rest)
        owner.run.conditions.trial_pressure.value = pressure;
      TriedBlocks tried = origin.tried;
      tried.limit       = pressure < pressed.slides_below ? 0.5 * wanted : 0.;
      Trial trial       = owner.trials.try_factor(tried,
                                            origin.number,
                                            origin.start_of(wanted),
                                            wanted,
                                            origin.first_slip,
                                            pressure);
      if (is_failure(trial) && pressure > 0. && returns())
        trial.is_stable = true;
      demand.trials.push_back(trial);
      if (pressure > 0.)
        take_in(trial);
      return trial;
    }

    void
    take_in(const Trial &trial)
    {
      const double p = trial.pressure;
      largest        = std::max(largest, p);
      smallest       = smallest > 0. ? std::min(smallest, p) : p;
      if (relief.stable == 0. && is_failure(trial) &&
          is_along(owner.trials.failure.way()))
        driven_from = driven_from > 0. ? std::min(driven_from, p) : p;
      else
        relief.add(1. / p, trial);
    }

    static bool
    is_failure(const Trial &trial)
    {
      return !trial.is_stable && !trial.is_undecided;
    }

    /** Whether a way leads as the pressure pushes. */
    bool
    is_along(const Vector<dim> &way) const
    {
      double along = 0.;
      for (unsigned int d = 0; d < dim; ++d)
        along -= way[d] * pressed.area[d];
      return along > driven_share * norm<dim>(way) * pressed.area.norm();
    }

    /** Whether the block that has just failed moves along the pressure, back to
     * its place, which it has left the other way: there it is held. */
    bool
    returns() const
    {
      const Vector<dim> now =
        owner.trials.measures.motion(origin.tried).displacement;
      return is_along(owner.trials.failure.way()) &&
             is_along(add<dim>(pressed.place, -1., now));
    }

    StrengthReductionSearch &owner;
    const Origin origin;
    const PressedBlock<dim> pressed;
    const bool is_at_rest;
    const double share; ///< of the bracket [-]
    TriedDemand &demand;
    TrialBracket relief; ///< 1 over the pressure [1/Pa]

    // of those tried [Pa]
    double largest = 0., smallest = 0.;
    double driven_from = 0.; ///< least that drives the block elsewhere; 0: none
  };
} // namespace Keyblock

#endif
