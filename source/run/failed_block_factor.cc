// SPDX-License-Identifier: LGPL-2.1-or-later
// The factor of a block that a stage has taken away, from running that stage
// again with strong joints.
#include <keyblock/run/safety_study.h>
#include <keyblock/run/stage_runner.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace Keyblock
{
  namespace
  {
    /** Pressures, over the first guess, with which a stage is run again in
     * which nothing else holds a block: no more than that takes, as what
     * pushes it into a notch may wedge it there [-]. */
    constexpr std::array<double, 5> holding_parts = {{1., 1.25, 2.5, 5., 20.}};

    /** Width over the value of a bracket found by running the stage again,
     * which costs more than a trial [-]. */
    constexpr double stage_bracket = 0.02;

    /** No group: a stage took away at its own strength what holds at it in
     * trials, as joints that were strong while the stage lasted keep it
     * clamped.
     */
    void
    drop_group(SafetyFactor &result)
    {
      result.group.clear();
      result.group_lower = result.group_upper = 0.;
      result.group_undecided_lower = result.group_undecided_upper = 0.;
    }

    /** Looks for signals only: a stage that is run on trial leaves no trace. */
    template <int dim>
    class SignalWatch : public StageObserver<dim>
    {
    public:
      explicit SignalWatch(const Communicator &communicator)
        : communicator(communicator)
      {}

      void
      save_point(StageProgress<dim> &) override
      {
        stop_if_asked(communicator);
      }

    private:
      const Communicator communicator;
    };
  } // namespace



  template <int dim>
  SafetyFactor
  SafetyStudy<dim>::factor_of_failed_block(StrengthReductionSearch<dim> &search,
                                           const unsigned int block)
  {
    const double lowest = model.scene.safety.lowest;
    recall(record.before, model.parts());
    model.step->excavate(record.present.number());
    TriedBlocks alone;
    alone.block = block;
    search.tell_ways(alone);
    typename StrengthReductionSearch<dim>::Known known;
    known.stable   = lowest;
    known.unstable = 1.;
    known.start    = lowest;
    if (hold_in_stage({block}, lowest))
      {
        SafetyFactor cheap;
        search.add_cheap_answers(block, cheap);
        if (std::isfinite(cheap.limit_alone))
          known.limit = cheap.limit_alone;
        SafetyFactor result =
          search.find(block, record.present.number(), known);
        if (result.group_lower > 1.)
          drop_group(result);
        if (result.lower > 1.)
          bracket_by_stage(alone, result);
        else
          search.add_demand(record.present.number(), known, result);
        return result;
      }
    // with those that failed beside it, it may hold: they carry it along
    TriedBlocks carried = alone;
    carried.companions  = list_failed_beside(block);
    carried.is_carried  = true;
    if (!carried.companions.empty() && hold_in_stage(carried.all(), lowest))
      {
        SafetyFactor result =
          search.find_with(carried, record.present.number(), known);
        if (result.group_lower > 1.)
          bracket_by_stage(carried, result);
        else
          search.add_demand(record.present.number(), known, result);
        return result;
      }
    SafetyFactor result;
    result.block   = block;
    result.outcome = SafetyFactor::Outcome::falls_freely;
    result.upper   = lowest;
    recall(record.before, model.parts());
    model.step->excavate(record.present.number());
    search.add_cheap_answers(block, result);
    // it moved too far for trials to tell
    result.failure_mode = result.limit_factor < lowest
                            ? result.limit_mode
                            : search.mode_if_not_held(block);
    if (model.scene.safety.is_demand_tried())
      add_demand_of_fallen_block(search, result);
    return result;
  }



  template <int dim>
  void
  SafetyStudy<dim>::bracket_by_stage(const TriedBlocks &tried,
                                     SafetyFactor &result)
  {
    double holds = model.scene.safety.lowest, fails = 1.;
    const double guess = result.limit_factor;
    result.trials.clear();
    while (fails > (1. + stage_bracket) * holds)
      {
        Trial trial;
        trial.phase  = 0;
        trial.factor = std::sqrt(holds * fails);
        for (const double beside :
             {guess / std::sqrt(1. + stage_bracket), // and above it
              guess * std::sqrt(1. + stage_bracket)})
          if (beside > holds && beside < fails)
            trial.factor = beside;
        trial.start        = trial.factor;
        trial.is_of_group  = tried.is_carried;
        const double begin = MPI_Wtime();
        trial.is_stable    = hold_in_stage(tried.all(), trial.factor);
        trial.seconds      = MPI_Wtime() - begin;
        (trial.is_stable ? holds : fails) = trial.factor;
        result.trials.push_back(trial);
      }
    drop_group(result);
    result.undecided_lower = result.undecided_upper = 0.;
    if (tried.is_carried)
      {
        result.outcome = SafetyFactor::Outcome::carried;
        for (const unsigned int b : tried.all())
          result.group.push_back(model.blocks.blocks[b].id);
        std::sort(result.group.begin(), result.group.end());
        result.group_lower = holds;
        result.group_upper = fails;
      }
    else
      {
        result.outcome = SafetyFactor::Outcome::bracketed;
        result.lower   = holds;
        result.upper   = fails;
      }
    // how it went is not looked at
    result.failure_mode =
      std::isfinite(result.limit_factor) ? result.limit_mode : BlockMode();
    result.held_by.clear();
    if (model.scene.safety.is_demand_tried())
      result.tried_demand.outcome = TriedDemand::Outcome::undecided;
  }



  template <int dim>
  void
  SafetyStudy<dim>::add_demand_of_fallen_block(
    StrengthReductionSearch<dim> &search,
    SafetyFactor &result)
  {
    const PressedBlock<dim> pressed = search.press_on_block(result);
    result.tried_demand.outcome     = TriedDemand::Outcome::out_of_reach;
    if (pressed.unit == 0.)
      return;
    typename StrengthReductionSearch<dim>::Known known;
    known.start = model.scene.safety.lowest;
    for (const double part : holding_parts)
      if (hold_in_stage({result.block},
                        model.scene.safety.lowest,
                        part * pressed.first_guess))
        {
          search.add_demand_of_pressed(pressed,
                                       record.present.number(),
                                       known,
                                       result);
          return;
        }
  }



  template <int dim>
  std::vector<unsigned int>
  SafetyStudy<dim>::list_failed_beside(const unsigned int block) const
  {
    const SplitMesh<dim> &split = model.split;
    const auto has_failed       = [&](const unsigned int b) {
      return b != none &&
             record.present.removal_stage[b] == record.present.number();
    };
    std::vector<unsigned int> found = {block};
    for (std::size_t n_before = 0; n_before < found.size();)
      {
        n_before = found.size();
        for (const JointFace &face : split.interface.joint_faces)
          {
            const unsigned int minus = split.block_of_cell[face.minus_cell],
                               plus  = split.block_of_cell[face.plus_cell];
            if (!has_failed(minus) || !has_failed(plus))
              continue;
            const bool has_minus =
              std::count(found.begin(), found.end(), minus) > 0;
            const bool has_plus =
              std::count(found.begin(), found.end(), plus) > 0;
            if (has_minus != has_plus)
              found.push_back(has_minus ? plus : minus);
          }
      }
    found.erase(found.begin());
    return found;
  }



  template <int dim>
  bool
  SafetyStudy<dim>::hold_in_stage(const std::vector<unsigned int> &blocks,
                                  const double factor,
                                  const double pressure)
  {
    recall(record.before, model.parts());
    model.conditions->trial_pressure.value = pressure;
    StrengthReduction strong;
    strong.blocks = blocks;
    strong.share  = 1. / factor;
    model.contact->reduce_strength(strong);
    model.conditions->reduce_strength(strong);
    if (model.scene.safety.reduces_rock)
      model.conditions->active_cells.reduce_strength(strong.share);
    SignalWatch<dim> observer(model.communicator);
    StageRunner<dim> runner(model, finite_check, observer);
    StageProgress<dim> trial;
    trial.index = record.present.index;
    trial.removal_stage.assign(model.blocks.blocks.size(), 0);
    runner.begin(trial);
    runner.complete(trial);
    return std::all_of(blocks.begin(), blocks.end(), [&](const unsigned int b) {
      return trial.removal_stage[b] == 0;
    });
  }

#define INSTANTIATE(dim)                                                       \
  template SafetyFactor SafetyStudy<dim>::factor_of_failed_block(              \
    StrengthReductionSearch<dim> &, const unsigned int);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock
