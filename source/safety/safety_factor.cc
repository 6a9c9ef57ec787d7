// SPDX-License-Identifier: LGPL-2.1-or-later
// The search for the factor between holding and failing.
#include <keyblock/safety/safety_factor.h>

#include <algorithm>
#include <cmath>

namespace Keyblock
{
  /** The bracket so far, and the states that trials start from. */
  template <int dim>
  class StrengthReductionSearch<dim>::Search
  {
  public:
    Search(StrengthReductionSearch &owner,
           const unsigned int block,
           const unsigned int number,
           const Known &known,
           std::vector<Trial> &trials)
      : stable(known.stable)
      , unstable(known.unstable)
      , owner(owner)
      , block(block)
      , number(number)
      , start(known.start)
      , first_slip(owner.run.contact->report().mean_slip(block))
      , way(owner.tell_ways(block))
      , before(take_snapshot(owner.run))
      , state(owner.freeze_beyond_reach(block) ? take_snapshot(owner.run)
                                               : before)
      , trials(trials)
    {}

    /** Try @p factor; with warm starts the next trial goes on from the highest
     * factor that held. */
    bool
    holds_at(const double factor)
    {
      Assert(factor > 0., dealii::ExcInternalError());
      const bool is_above = warm && warm_start <= factor;
      recall(is_above ? *warm : state, owner.run);
      const Trial trial =
        owner.trials.try_factor(block,
                                number,
                                is_above ? warm_start : start_of(factor),
                                factor,
                                first_slip);
      trials.push_back(trial);
      if (trial.is_stable)
        {
          if (owner.scene.safety.warm_start && factor > stable)
            {
              warm = std::make_unique<Snapshot<dim>>(take_snapshot(owner.run));
              warm_start = factor;
            }
          stable = std::max(stable, factor);
          if (stable >= owner.scene.safety.highest)
            held_by = owner.trials.list_holders(block, way);
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
     * it did not, it is tried; if it holds, the bracket is open again. */
    bool
    confirm()
    {
      if (!owner.scene.safety.warm_start || warm_start <= unstable_start)
        return true;
      const double failed = unstable;
      unstable            = 0.;
      return !holds_at(failed);
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
    const unsigned int block, number;
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



  template <int dim>
  StrengthReductionSearch<dim>::StrengthReductionSearch(
    const Scene<dim> &scene,
    const SplitMesh<dim> &split,
    const Blocks<dim> &blocks,
    const Numbering<dim> &numbering,
    const RunParts<dim> &run)
    : scene(scene)
    , split(split)
    , blocks(blocks)
    , run(run)
    , trials(scene, split, blocks, numbering, run)
  {}



  template <int dim>
  SafetyFactor
  StrengthReductionSearch<dim>::find(const unsigned int block,
                                     const unsigned int number,
                                     const Known &known)
  {
    SafetyFactor result;
    result.block = block;
    add_cheap_answers(block, result);
    trials.forget_failure();
    {
      Search search(*this, block, number, known, result.trials);
      result.outcome         = scene.safety.method == FactorSearch::sweep
                                 ? sweep(search)
                                 : bisect(search, known);
      result.lower           = search.stable;
      result.upper           = search.unstable;
      result.undecided_lower = search.undecided_lower;
      result.undecided_upper = search.undecided_upper;
      result.held_by         = search.held_by;
      search.finish();
    }
    if (result.outcome != SafetyFactor::Outcome::immovable)
      result.failure_mode =
        result.outcome == SafetyFactor::Outcome::met ? "" : trials.failure();
    else if (std::isfinite(result.limit_factor))
      result.outcome = SafetyFactor::Outcome::clamped;
    if (result.outcome == SafetyFactor::Outcome::bracketed &&
        scene.safety.reduced_joints != ReducedJoints::all)
      find_group(number, known, result);
    trials.reduce(block, 1.);
    return result;
  }



  template <int dim>
  void
  StrengthReductionSearch<dim>::find_group(const unsigned int number,
                                           const Known &known,
                                           SafetyFactor &result)
  {
    Known guess = known;
    guess.hint  = result.value();
    for (std::vector<unsigned int> more = trials.blocks_along(); !more.empty();)
      {
        trials.companions.insert(trials.companions.end(),
                                 more.begin(),
                                 more.end());
        std::vector<Trial> tried;
        Search search(*this, result.block, number, guess, tried);
        const auto outcome = bisect(search, guess);
        search.finish();
        for (Trial &trial : tried)
          {
            trial.is_of_group = true;
            result.trials.push_back(trial);
          }
        if (outcome != SafetyFactor::Outcome::bracketed)
          break;
        result.group       = ids_of_group(result.block);
        result.group_lower = search.stable;
        result.group_upper = search.unstable;
        // those that move with the group only
        more = trials.blocks_along();
        more.erase(std::remove_if(more.begin(),
                                  more.end(),
                                  [&](const unsigned int b) {
                                    return std::count(trials.companions.begin(),
                                                      trials.companions.end(),
                                                      b) > 0;
                                  }),
                   more.end());
        guess.hint = result.value_of_group();
      }
    trials.companions.clear();
  }



  template <int dim>
  SafetyFactor::Outcome
  StrengthReductionSearch<dim>::find_bracket(Search &search,
                                             double spread) const
  {
    using Outcome                  = SafetyFactor::Outcome;
    const SafetySettings &settings = scene.safety;
    const double middle = search.stable > 0. ? search.stable : search.unstable;
    // with neither end known, from the edges of what is undecided
    const double below = middle > 0. ? middle : search.undecided_lower,
                 above = middle > 0. ? middle : search.undecided_upper;
    for (; search.stable == 0. || search.unstable == 0.; spread *= 4.)
      {
        if (search.stable >= settings.highest)
          return Outcome::immovable;
        if (search.unstable > 0. && search.unstable <= settings.lowest)
          return Outcome::falls_freely;
        if (search.is_hopeless())
          return Outcome::undecided;
        if (search.stable == 0.)
          search.holds_at(std::max(settings.lowest, below / (1. + spread)));
        else
          search.holds_at(std::min(settings.highest, above * (1. + spread)));
      }
    return Outcome::bracketed;
  }



  template <int dim>
  void
  StrengthReductionSearch<dim>::try_guess(Search &search,
                                          double guess,
                                          const double onset,
                                          const double spread) const
  {
    const SafetySettings &settings = scene.safety;
    guess                          = std::min(guess, settings.highest);
    if (search.is_done() || !search.is_open(guess))
      return;
    // a block that slips at the onset may be caught by its neighbour further
    // on: the guess must not jump over that
    if (onset > (1. + settings.bracket) * search.stable &&
        onset < guess / (1. + settings.bracket) &&
        !search.holds_at(onset * (1. + spread)))
      guess = onset;
    const double below = std::max(settings.lowest, guess / (1. + spread));
    const double above = std::min(settings.highest, guess * (1. + spread));
    if (guess < settings.highest && search.is_open(below))
      search.holds_at(below);
    if (search.is_open(above))
      search.holds_at(above);
  }



  template <int dim>
  SafetyFactor::Outcome
  StrengthReductionSearch<dim>::bisect(Search &search, const Known &known) const
  {
    const SafetySettings &settings = scene.safety;
    // with nothing to go by, most blocks that hold cannot move at all
    const bool has_hint = known.hint > 0.;
    const double guess  = has_hint             ? known.hint
                          : search.stable > 0. ? settings.highest
                                               : 1.;
    double spread       = 0.4 * settings.bracket;
    if (settings.wanted > 0. && search.is_open(settings.wanted))
      search.holds_at(settings.wanted);
    if (settings.wanted > 0. && search.stable >= settings.wanted)
      return SafetyFactor::Outcome::met;
    for (const double middle : {guess, known.limit})
      try_guess(search, middle, known.onset, spread);
    spread = has_hint ? 4. * spread : 0.5;
    do
      {
        const auto outcome = find_bracket(search, spread);
        if (outcome != SafetyFactor::Outcome::bracketed)
          return outcome;
        while (!search.is_done())
          search.holds_at(search.next());
        spread = settings.bracket;
    } while (!search.confirm_lower_end() || !search.confirm());
    return SafetyFactor::Outcome::bracketed;
  }



  template <int dim>
  SafetyFactor::Outcome
  StrengthReductionSearch<dim>::sweep(Search &search) const
  {
    const SafetySettings &settings = scene.safety;
    search.confirm_lower_end();
    const double first = std::max(search.stable, settings.lowest);
    for (unsigned int i = search.stable > 0. ? 1 : 0;; ++i)
      {
        const double factor = first + i * settings.sweep_step;
        if (factor > settings.highest)
          return SafetyFactor::Outcome::immovable;
        search.holds_at(factor);
        if (search.unstable == factor)
          return search.stable > 0. ? SafetyFactor::Outcome::bracketed
                                    : SafetyFactor::Outcome::falls_freely;
      }
  }



  template class StrengthReductionSearch<2>;
  template class StrengthReductionSearch<3>;
} // namespace Keyblock
