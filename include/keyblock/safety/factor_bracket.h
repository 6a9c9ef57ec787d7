// SPDX-License-Identifier: LGPL-2.1-or-later
// The searches by strength reduction; for safety_factor.cc and demand_search.cc
// alone.
#ifndef keyblock_safety_factor_bracket_h
#define keyblock_safety_factor_bracket_h

#include <keyblock/safety/safety_factor.h>
#include <keyblock/safety/trial_bracket.h>

#include <algorithm>
#include <memory>
#include <vector>

namespace Keyblock
{
  /** What all trials of a search begin from. */
  template <int dim>
  class StrengthReductionSearch<dim>::Origin
  {
  public:
    Origin(StrengthReductionSearch &owner,
           const TriedBlocks &to_try,
           const unsigned int number,
           const double start)
      : owner(owner)
      , tried(owner.with_row(to_try))
      , number(number)
      , start(start)
      , first_slip(owner.trials.measures.motion(tried).slip)
      , way(owner.tell_ways(tried))
      , before(take_snapshot(owner.run))
      , state(owner.freeze_beyond_reach(tried) ? take_snapshot(owner.run)
                                               : before)
    {}

    /** Factor from which strength changes to @p factor: not through failure. */
    double
    start_of(const double factor) const
    {
      return factor < start ? std::max(owner.scene.safety.lowest, 0.5 * factor)
                            : start;
    }

    /** Tell who watches that a trial begins. */
    void
    tell_trial(const double stable, const double unstable) const
    {
      owner.advance = {owner.advance.n_trials + 1, stable, unstable};
      owner.tell_advance();
    }

    /** Back to the state before the first trial. */
    void
    finish() const
    {
      recall(before, owner.run);
    }

    StrengthReductionSearch &owner;
    const TriedBlocks tried;
    const unsigned int number;
    const double start; ///< factor of the state
    const Vector<dim> first_slip;
    const Tensor<1, dim> way; ///< without support
    const Snapshot<dim> before, state;
  };



  /** The bracket so far, and the states that trials start from. */
  template <int dim>
  class StrengthReductionSearch<dim>::Search : public TrialBracket
  {
  public:
    Search(StrengthReductionSearch &owner,
           const TriedBlocks &to_try,
           const unsigned int number,
           const Known &known,
           std::vector<Trial> &trials)
      : wanted(known.looks_on ? 0. : owner.scene.safety.wanted)
      , owner(owner)
      , origin(owner, to_try, number, known.start)
      , trials(trials)
    {
      stable   = known.stable;
      unstable = known.unstable;
    }

    /** Try @p factor; with warm starts the next trial goes on from the highest
     * factor that held with all neighbours still in place. */
    bool
    holds_at(const double factor)
    {
      Assert(factor > 0., dealii::ExcInternalError());
      const bool is_above = warm && warm_start <= factor;
      origin.tell_trial(stable, unstable);
      recall(is_above ? *warm : origin.state, owner.run);
      const Trial trial =
        owner.trials.try_factor(origin.tried,
                                origin.number,
                                is_above ? warm_start : origin.start_of(factor),
                                factor,
                                origin.first_slip);
      trials.push_back(trial);
      if (trial.is_stable && owner.scene.safety.warm_start && factor > stable &&
          !owner.trials.measures.has_passed(origin.tried.block, trial.slip))
        {
          warm = std::make_unique<Snapshot<dim>>(take_snapshot(owner.run));
          warm_start = factor;
        }
      add(factor, trial);
      if (trial.is_stable)
        owner.pressed_at_end = owner.blocks_pressed_on(origin.tried);
      if (trial.is_stable && stable >= owner.scene.safety.highest)
        held_by =
          owner.trials.measures.list_holders(origin.tried.block, origin.way);
      if (!trial.is_stable && !trial.is_undecided)
        unstable_start = trial.start;
      return trial.is_stable;
    }

    /** Whether the block failed at the end of the bracket by a small change
     * of strength from a factor that held: a large one may shake it loose. If
     * it did not, it is tried; if it does not fail then, the bracket is open
     * again. */
    bool
    confirm()
    {
      if (!owner.scene.safety.warm_start || warm_start <= unstable_start)
        return true;
      const double failed = unstable;
      unstable            = 0.;
      holds_at(failed);
      return unstable > 0.;
    }

    /** The same of the lower end, which may be known only from a stage, whose
     * balance may be coarse. */
    bool
    confirm_lower_end()
    {
      const double lower = stable;
      for (const Trial &trial : trials)
        if (trial.factor == lower)
          return true;
      stable = 0.;
      return lower == 0. || holds_at(lower);
    }

    /** What is known of the factor now. */
    void
    note_bounds(SafetyFactor &result) const
    {
      result.lower           = stable;
      result.upper           = unstable;
      result.undecided_lower = undecided_lower;
      result.undecided_upper = undecided_upper;
      result.held_by         = held_by;
    }

    /** Back to the state before the first trial. */
    void
    finish() const
    {
      origin.finish();
    }

    /** Whether the bracket is as narrow as asked for, see is_narrow(). */
    bool
    is_done() const
    {
      return is_narrow(owner.scene.safety.bracket);
    }

    /** Whether the block holds at the wanted factor, which is enough. */
    bool
    is_met() const
    {
      return wanted > 0. && stable >= wanted;
    }

    std::string held_by; ///< as SafetyFactor::held_by
    const double wanted; ///< 0: none, or more is to be known [-]

  private:
    StrengthReductionSearch &owner;
    const Origin origin;
    std::vector<Trial> &trials;
    std::unique_ptr<Snapshot<dim>> warm; ///< of the highest factor that held
    double warm_start     = 0.;
    double unstable_start = 0.; ///< of the trial that failed at `unstable`
  };
} // namespace Keyblock

#endif
