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
    if (hold_when_strong({block}))
      {
        SafetyFactor cheap;
        search.add_cheap_answers(block, cheap);
        if (std::isfinite(cheap.limit_factor))
          known.limit = cheap.limit_factor;
        SafetyFactor result =
          search.find(block, record.present.number(), known);
        search.add_demand(record.present.number(), known, result);
        return result;
      }
    // with those that failed beside it, it may hold: they carry it along
    TriedBlocks carried = alone;
    carried.companions  = list_failed_beside(block);
    carried.is_carried  = true;
    if (!carried.companions.empty() && hold_when_strong(carried.all()))
      {
        SafetyFactor result =
          search.find_with(carried, record.present.number(), known);
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
      if (hold_when_strong({result.block}, part * pressed.first_guess))
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
  SafetyStudy<dim>::hold_when_strong(const std::vector<unsigned int> &blocks,
                                     const double pressure)
  {
    recall(record.before, model.parts());
    model.conditions->trial_pressure.value = pressure;
    StrengthReduction strong;
    strong.blocks = blocks;
    strong.share  = 1. / model.scene.safety.lowest;
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
