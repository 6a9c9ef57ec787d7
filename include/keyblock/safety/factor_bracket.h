// SPDX-License-Identifier: LGPL-2.1-or-later
// The bracket of a search by strength reduction; for safety_factor.cc alone.
#ifndef keyblock_safety_factor_bracket_h
#define keyblock_safety_factor_bracket_h

#include <keyblock/safety/safety_factor.h>

#include <algorithm>
#include <memory>
#include <vector>

namespace Keyblock
{
  /** The bracket so far, and the states that trials start from. */
  template <int dim>
  class StrengthReductionSearch<dim>::Search
  {
  public:
    Search(StrengthReductionSearch &owner,
           const TriedBlocks &to_try,
           const unsigned int number,
           const Known &known,
           std::vector<Trial> &trials)
      : stable(known.stable)
      , unstable(known.unstable)
      , owner(owner)
      , tried(owner.with_row(to_try))
      , number(number)
      , start(known.start)
      , first_slip(owner.trials.measures.motion(tried).slip)
      , way(owner.tell_ways(tried))
      , before(take_snapshot(owner.run))
      , state(owner.freeze_beyond_reach(tried) ? take_snapshot(owner.run)
                                               : before)
      , trials(trials)
    {}

    /** Try @p factor; with warm starts the next trial goes on from the highest
     * factor that held with all neighbours still in place. */
    bool
    holds_at(const double factor)
    {
      Assert(factor > 0., dealii::ExcInternalError());
      const bool is_above = warm && warm_start <= factor;
      owner.advance       = {owner.advance.n_trials + 1, stable, unstable};
      owner.tell_advance();
      recall(is_above ? *warm : state, owner.run);
      const Trial trial =
        owner.trials.try_factor(tried,
                                number,
                                is_above ? warm_start : start_of(factor),
                                factor,
                                first_slip);
      trials.push_back(trial);
      if (trial.is_stable)
        {
          if (owner.scene.safety.warm_start && factor > stable &&
              !owner.trials.measures.has_passed(tried.block, trial.slip))
            {
              warm = std::make_unique<Snapshot<dim>>(take_snapshot(owner.run));
              warm_start = factor;
            }
          stable = std::max(stable, factor);
          if (stable >= owner.scene.safety.highest)
            held_by = owner.trials.measures.list_holders(tried.block, way);
        }
      else if (trial.is_undecided)
        {
          ++n_undecided;
          undecided_lower =
            undecided_upper == 0. ? factor : std::min(undecided_lower, factor);
          undecided_upper = std::max(undecided_upper, factor);
        }
      else
        {
          unstable       = factor;
          unstable_start = trial.start;
        }
      forget_undecided_outside();
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
    finish()
    {
      recall(before, owner.run);
    }

    /** Whether @p factor would tell something new. */
    bool
    is_open(const double factor) const
    {
      return factor > stable && (unstable == 0. || factor < unstable) &&
             (factor < undecided_lower || factor > undecided_upper);
    }

    /** Whether the bracket is as narrow as asked for, but for undecided
     * factors in it; or does not get narrower. */
    bool
    is_done() const
    {
      if (unstable == 0.)
        return false;
      const double width = owner.scene.safety.bracket * unstable;
      return undecided_upper == 0. ? unstable - stable <= width
                                   : n_undecided >= most_undecided ||
                                       (undecided_lower - stable <= width &&
                                        unstable - undecided_upper <= width);
    }

    /** Whether so many trials were undecided that more are of no use. */
    bool
    is_hopeless() const
    {
      return n_undecided >= most_undecided;
    }

    /** The factor to try next in a closed bracket. */
    double
    next() const
    {
      const auto middle = [](const double a, const double b) {
        return b > 2. * a ? std::sqrt(a * b) : 0.5 * (a + b);
      };
      if (undecided_upper == 0.)
        return middle(stable, unstable);
      return unstable - undecided_upper > undecided_lower - stable
               ? middle(undecided_upper, unstable)
               : middle(stable, undecided_lower);
    }

    double stable, unstable; ///< 0: none known
    std::string held_by;     ///< as SafetyFactor::held_by

    /** Factors without a verdict; 0: none. */
    double undecided_lower = 0., undecided_upper = 0.;

  private:
    /** Trials without a verdict after which a search ends. */
    static constexpr unsigned int most_undecided = 6;

    /** What holds or fails decides those below or above it. */
    void
    forget_undecided_outside()
    {
      if (undecided_upper == 0.)
        return;
      undecided_lower = std::max(undecided_lower, stable);
      if (unstable > 0.)
        undecided_upper = std::min(undecided_upper, unstable);
      if (undecided_upper <= stable ||
          (unstable > 0. && undecided_lower >= unstable))
        undecided_lower = undecided_upper = 0.;
    }

    /** Factor from which strength changes to @p factor: not through failure. */
    double
    start_of(const double factor) const
    {
      return factor < start ? std::max(owner.scene.safety.lowest, 0.5 * factor)
                            : start;
    }

    StrengthReductionSearch &owner;
    const TriedBlocks tried;
    const unsigned int number;
    const double start; ///< factor of the state
    const Vector<dim> first_slip;
    const Tensor<1, dim> way; ///< without support
    const Snapshot<dim> before, state;
    std::vector<Trial> &trials;
    std::unique_ptr<Snapshot<dim>> warm; ///< of the highest factor that held
    double warm_start        = 0.;
    double unstable_start    = 0.; ///< of the trial that failed at `unstable`
    unsigned int n_undecided = 0;
  };
} // namespace Keyblock

#endif
