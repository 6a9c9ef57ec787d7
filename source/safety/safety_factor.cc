// SPDX-License-Identifier: LGPL-2.1-or-later
// The search for the factor between holding and failing.
#include <keyblock/safety/block_statics.h>
#include <keyblock/safety/factor_bracket.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace Keyblock
{
  namespace
  {
    /** The highest factor at which a block, or the group found for it so far,
     * holds [-]. */
    double
    held_so_far(const SafetyFactor &result)
    {
      return result.group.empty() ? result.lower : result.group_lower;
    }

    /** Add @p others to a sorted list; whether any are new. */
    bool
    add_to(std::vector<unsigned int> &list,
           const std::vector<unsigned int> &others)
    {
      std::vector<unsigned int> all;
      std::set_union(list.begin(),
                     list.end(),
                     others.begin(),
                     others.end(),
                     std::back_inserter(all));
      const bool is_more = all.size() > list.size();
      list.swap(all);
      return is_more;
    }
  } // namespace



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
  {
    trials.pulse = [this]() { tell_advance(); };
  }



  template <int dim>
  SafetyFactor
  StrengthReductionSearch<dim>::find(const unsigned int block,
                                     const unsigned int number,
                                     const Known &known)
  {
    SafetyFactor result;
    result.block = block;
    advance      = SearchAdvance();
    add_cheap_answers(block, result);
    trials.failure.forget();
    pressed_at_end.clear();
    TriedBlocks tried;
    tried.block = block;
    if (result.limit_moves && std::isfinite(result.limit_alone) &&
        result.facts.is_complete)
      tried.limit = result.limit_alone;
    if (result.limit_moves && std::isfinite(result.limit_alone))
      tried.limit_without_stress = result.limit_alone;
    {
      Search search(*this, tried, number, known, result.trials);
      result.outcome = scene.safety.method == FactorSearch::sweep
                         ? sweep(search)
                         : bisect(search, known);
      search.note_bounds(result);
      search.finish();
    }
    Assert(result.outcome != SafetyFactor::Outcome::bracketed ||
             result.lower < result.upper,
           dealii::ExcInternalError());
    if (result.outcome != SafetyFactor::Outcome::immovable)
      result.failure_mode = result.outcome == SafetyFactor::Outcome::met
                              ? BlockMode()
                              : trials.failure.mode();
    else if (result.limit_moves)
      result.outcome = SafetyFactor::Outcome::clamped;
    const bool is_bracketed =
      result.outcome == SafetyFactor::Outcome::bracketed;
    if ((is_bracketed || result.outcome == SafetyFactor::Outcome::met) &&
        scene.safety.reduced_joints != ReducedJoints::all)
      {
        Known guess = known;
        guess.hint  = is_bracketed ? result.value() : result.lower;
        if (is_bracketed)
          tried.companions = trials.failure.blocks_along();
        find_group(tried, number, guess, result);
        if (result.outcome == SafetyFactor::Outcome::met &&
            !result.group.empty())
          look_below_wanted(tried, number, known, result);
      }
    return result;
  }



  template <int dim>
  SafetyFactor
  StrengthReductionSearch<dim>::find_with(const TriedBlocks &carried,
                                          const unsigned int number,
                                          const Known &known)
  {
    // where all joints are reduced, those of the carriers are, too
    if (scene.safety.reduced_joints == ReducedJoints::all)
      return find(carried.block, number, known);
    SafetyFactor result;
    result.block = carried.block;
    advance      = SearchAdvance();
    add_cheap_answers(carried.block, result);
    trials.failure.forget();
    pressed_at_end.clear();
    find_group(carried, number, known, result);
    if (result.outcome != SafetyFactor::Outcome::carried &&
        result.outcome != SafetyFactor::Outcome::met)
      result.failure_mode = trials.failure.mode();
    return result;
  }



  template <int dim>
  void
  StrengthReductionSearch<dim>::find_group(TriedBlocks tried,
                                           const unsigned int number,
                                           Known guess,
                                           SafetyFactor &result)
  {
    std::vector<unsigned int> others = tried.companions;
    tried.companions.clear();
    while (true)
      {
        const double held     = held_so_far(result);
        const bool move_along = !others.empty();
        if (!move_along)
          others = find_weaker_neighbors(tried, number, guess, result);
        if (others.empty())
          break;
        tried = tried.with(others);
        std::vector<Trial> of_group;
        Search search(*this, tried, number, guess, of_group);
        const auto outcome = bisect(search, guess);
        search.finish();
        for (Trial &trial : of_group)
          {
            trial.is_of_group = true;
            result.trials.push_back(trial);
          }
        // what is carried along has no bounds of its own
        if (tried.is_carried && result.group.empty())
          {
            if (outcome != SafetyFactor::Outcome::bracketed)
              search.note_bounds(result);
            result.outcome = outcome == SafetyFactor::Outcome::bracketed
                               ? SafetyFactor::Outcome::carried
                               : outcome;
          }
        // neighbors matter if they make it weaker: a large change of strength
        // may have shaken it loose in the trial that told of them
        if (outcome == SafetyFactor::Outcome::met && result.group.empty() &&
            tried.is_carried)
          {
            others.clear();
            continue;
          }
        if (outcome != SafetyFactor::Outcome::bracketed ||
            (!move_along && search.stable >= held))
          break;
        result.group                 = ids_of(tried);
        result.group_lower           = search.stable;
        result.group_upper           = search.unstable;
        result.group_undecided_lower = search.undecided_lower;
        result.group_undecided_upper = search.undecided_upper;
        // those that move with the group only
        others.clear();
        for (const unsigned int b : trials.failure.blocks_along())
          if (!tried.contains(b))
            others.push_back(b);
        guess.hint = result.value_of_group();
      }
  }



  template <int dim>
  std::vector<unsigned int>
  StrengthReductionSearch<dim>::find_weaker_neighbors(const TriedBlocks &group,
                                                      const unsigned int number,
                                                      const Known &known,
                                                      SafetyFactor &result)
  {
    const double held = held_so_far(result);
    const bool is_met = result.outcome == SafetyFactor::Outcome::met;
    std::vector<unsigned int> pressed = blocks_pressed_on(group);
    // what has caught it, which is no less strong than it was
    if (is_met)
      add_to(pressed, pressed_at_end);
    std::vector<unsigned int> weaker;
    while (!pressed.empty() && held > 0.)
      {
        std::vector<Trial> tried;
        Search search(*this, group.with(pressed), number, known, tried);
        search.holds_at(held);
        const bool fails = search.unstable == held;
        search.finish();
        tried[0].is_of_group = true;
        result.trials.push_back(tried[0]);
        if (fails)
          {
            const auto &moving = trials.failure.blocks_moving();
            std::set_intersection(pressed.begin(),
                                  pressed.end(),
                                  moving.begin(),
                                  moving.end(),
                                  std::back_inserter(weaker));
            break;
          }
        // others may have caught them all
        if (!is_met || !tried[0].is_stable || !add_to(pressed, pressed_at_end))
          break;
      }
    return weaker;
  }



  template <int dim>
  void
  StrengthReductionSearch<dim>::look_below_wanted(const TriedBlocks &alone,
                                                  const unsigned int number,
                                                  Known known,
                                                  SafetyFactor &result)
  {
    known.hint     = result.value_of_group();
    known.looks_on = true;
    std::vector<Trial> tried;
    Search search(*this, alone, number, known, tried);
    if (search.is_open(result.group_upper) &&
        !search.holds_at(result.group_upper) && search.unstable > 0.)
      {
        result.outcome = bisect(search, known);
        search.note_bounds(result);
        result.failure_mode = trials.failure.mode();
      }
    search.finish();
    result.trials.insert(result.trials.end(), tried.begin(), tried.end());
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
        if (search.is_met())
          return Outcome::met;
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
    if (search.wanted > 0. && search.is_open(search.wanted))
      search.holds_at(search.wanted);
    for (const double middle : {guess, known.limit})
      if (!search.is_met())
        try_guess(search, middle, known.onset, spread);
    spread = has_hint ? 4. * spread : 0.5;
    while (!search.is_met())
      {
        const auto outcome = find_bracket(search, spread);
        if (outcome != SafetyFactor::Outcome::bracketed)
          return outcome;
        while (!search.is_done() && !search.is_met())
          search.holds_at(search.next());
        if (!search.is_met() && search.confirm_lower_end() && search.confirm())
          return SafetyFactor::Outcome::bracketed;
        spread = settings.bracket;
      }
    return SafetyFactor::Outcome::met;
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
