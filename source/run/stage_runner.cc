// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/run/moving_blocks.h>
#include <keyblock/run/ramp_length.h>
#include <keyblock/run/stage_runner.h>
#include <keyblock/run/static_stage.h>
#include <keyblock/safety/block_stiffness.h>
#include <keyblock/safety/caught_block.h>
#include <keyblock/scene/step_count.h>
#include <keyblock/step/guided_blocks.h>

#include <algorithm>

namespace Keyblock
{
  namespace
  {
    /** Steps from check to check for numbers that are not finite. */
    constexpr unsigned int finite_check_interval = 50;

    /** Steps between measurements while forces are brought into balance. */
    constexpr unsigned int quasi_static_interval = 25;

    /** Steps between adjustments of the pace of a ramp. */
    constexpr unsigned int pace_interval = 10;

    /** Steps from check to check for blocks that have failed. */
    constexpr unsigned int removal_interval = 100;

    /** Steps from check to check whether the run is to be saved or stopped. */
    constexpr unsigned int save_interval = 10;

    /** How a block goes on that has failed. */
    struct Failure
    {
      double share;        ///< of its former speed, at least [-]
      double way;          ///< over its size, at least [-]
      double compressions; ///< and over its compression by its load [-]
    };

    /** Whatever drives it. What decays, or goes with the root of time, slows
     * down more from a quarter of the time to the half after it; soft blocks
     * that rock on a corner until they rest go this far, slender ones. */
    constexpr Failure goes_on = {0.75, size_of_place, compressions_of_place};

    /** One that forces drive all the while, as damping takes up what they do:
     * what decays so little goes seven times as far as in that half. */
    constexpr Failure is_driven_on = {0.9, 3e-4, 7.};
  } // namespace



  template <int dim>
  StageRunner<dim>::StageRunner(Model<dim> &model,
                                FiniteCheck<dim> &finite_check,
                                StageObserver<dim> &observer)
    : model(model)
    , finite_check(finite_check)
    , observer(observer)
  {}



  template <int dim>
  void
  StageRunner<dim>::begin(const StageProgress<dim> &progress)
  {
    const Stage &stage        = *model.scene.stages[progress.index];
    const unsigned int number = progress.number();
    std::vector<double> out_of_balance;
    const bool changes = model.conditions->changes(number);
    model.step->forget_excavated_cells();
    if (changes)
      {
        out_of_balance = model.step->excavate(number);
        model.count_cells();
      }
    model.step->begin_stage(stage, number);
    if (model.contact && (changes || is_shaken(stage)))
      model.contact->release_bent_points();
    Loads<dim> &loads = model.conditions->loads;
    if (stage.is_static())
      {
        loads.start_ramp({}, 0., false);
        return;
      }
    const bool moves_supports =
      stage.is_quasi_static() && are_supports_to_move();
    // else what a dynamic stage may have left of a ramp goes on
    if (changes || moves_supports)
      loads.start_ramp(changes              ? out_of_balance
                       : loads.is_ramping() ? model.step->list_out_of_balance()
                                            : std::vector<double>(),
                       ramp_duration_of(stage),
                       moves_supports);
  }



  template <int dim>
  bool
  StageRunner<dim>::is_shaken(const Stage &stage) const
  {
    const Scene<dim> &scene = model.scene;
    return !stage.is_quasi_static() && !stage.is_static() &&
           (model.conditions->loads.is_load_changing() ||
            !scene.initial_state.velocity.empty() ||
            std::any_of(scene.supports.begin(),
                        scene.supports.end(),
                        [](const auto &support) {
                          return !support->velocity.empty() ||
                                 support->history != nullptr;
                        }));
  }



  template <int dim>
  bool
  StageRunner<dim>::are_supports_to_move() const
  {
    return model.conditions->loads.has_displacement_left() &&
           std::any_of(model.scene.supports.begin(),
                       model.scene.supports.end(),
                       [](const auto &support) {
                         return !support->displacement.empty();
                       });
  }



  template <int dim>
  void
  StageRunner<dim>::complete(StageProgress<dim> &progress)
  {
    const Stage &stage = *model.scene.stages[progress.index];
    observer.started();
    if (model.scene.safety.is_by_statics())
      progress.is_converged = true;
    else if (stage.is_static())
      {
        solve_for_equilibrium(model,
                              model.conditions->loads.take_displacement());
        progress.is_converged = model.step->unbalanced_ratio < static_tolerance;
        model.step->settle_contact();
      }
    else
      step_through(stage, progress);
    observer.ended(progress, stage);
  }



  template <int dim>
  void
  StageRunner<dim>::step_through(const Stage &stage,
                                 StageProgress<dim> &progress)
  {
    if (progress.n_done == 0)
      progress.n_planned = plan_steps(stage, model.step->dt);
    if (progress.start_displacement.empty()) // of a stage that is tried
      progress.start_displacement = model.fields.displacement;
    const std::uint64_t n_steps = progress.n_planned;
    const unsigned int interval =
      stage.is_quasi_static()
        ? std::max(model.scene.output.history_interval, quasi_static_interval)
        : model.scene.output.history_interval;
    progress.is_converged = stage.unbalanced_ratio == 0. ||
                            (stage.duration > 0. && !stage.is_quasi_static());
    while (progress.n_done < n_steps)
      {
        const std::uint64_t i = ++progress.n_done;
        const bool is_last    = i == n_steps;
        const bool is_sample =
          i % interval == 0 || is_last || i == 1 || progress.has_removed;
        model.step->advance(is_sample);
        if (is_sample)
          {
            finite_check.check_sample();
            observer.sampled(progress);
          }
        // the ledger starts anew when a block is taken away
        progress.has_removed =
          stage.is_quasi_static() && i % removal_interval == 0 &&
          remove_blocks(list_failed_blocks(progress), stage, progress);
        if (stage.is_quasi_static() && i % pace_interval == 0 &&
            model.conditions->loads.is_ramping())
          pace_ramp(stage);
        if (i % finite_check_interval == 0 || is_last)
          finite_check.check_motion();
        observer.stepped(progress, stage);
        if (is_sample && i > 10 && stage.unbalanced_ratio > 0. &&
            !model.conditions->loads.is_ramping() &&
            model.step->unbalanced_ratio < stage.unbalanced_ratio &&
            !(stage.is_quasi_static() &&
              is_any_block_moving_off(model, quasi_static_interval)))
          {
            progress.has_removed =
              stage.is_quasi_static() &&
              remove_blocks(list_failed_blocks(progress), stage, progress);
            if (progress.has_removed)
              continue;
            progress.is_converged = true;
            break;
          }
        if (i % save_interval == 0)
          observer.save_point(progress);
      }
  }



  template <int dim>
  void
  StageRunner<dim>::pace_ramp(const Stage &stage)
  {
    // plastic rock answers more slowly than its lowest elastic mode; a ramp
    // that outruns it overshoots for good
    model.step->sample_unbalanced_force();
    model.conditions->loads.set_ramp_pace(
      std::min(1., stage.ramp_unbalance / model.step->unbalanced_ratio));
  }



  template <int dim>
  double
  StageRunner<dim>::ramp_duration_of(const Stage &stage) const
  {
    return stage.ramp_duration > 0. || !stage.is_quasi_static()
             ? stage.ramp_duration
             : find_ramp_duration(model);
  }



  template <int dim>
  std::vector<bool>
  StageRunner<dim>::mark_steady_blocks(
    const std::vector<BlockMotion<dim>> &motions,
    const std::vector<double> &ways,
    StageProgress<dim> &progress) const
  {
    std::vector<bool> is_steady(ways.size(), false);
    if (!progress.slips.offer(progress.n_done, ways))
      return is_steady;
    const auto nodes =
      owned_nodes_of_blocks(model.split, *model.numbering, ways.size());
    std::vector<double> loads, sizes;
    std::vector<bool> is_finite;
    for (unsigned int b = 0; b < ways.size(); ++b)
      {
        loads.push_back(motions[b].load);
        sizes.push_back(model.blocks.blocks[b].size);
        is_finite.push_back(can_fail(b));
      }
    const SupportState<dim> support =
      measure_support(model.conditions->elements,
                      model.fields,
                      nodes,
                      is_finite,
                      model.communicator);
    const std::vector<bool> is_caught =
      mark_caught_blocks(progress.support, support, loads, sizes);
    progress.support = support;
    const auto velocities =
      model.contact->motions().measure(model.fields.velocity);
    for (unsigned int b = 0; b < ways.size(); ++b)
      {
        if (is_caught[b])
          continue;
        const Block<dim> &block  = model.blocks.blocks[b];
        const double compression = compression_of_block(
          model.conditions->active_cells.ground(), b, block, loads[b]);
        const auto moves_as = [&](const Failure &failure) {
          return progress.slips.is_steady(b,
                                          std::max(failure.way * block.size,
                                                   failure.compressions *
                                                     compression),
                                          failure.share);
        };
        is_steady[b] = moves_as(goes_on) ||
                       (moves_as(is_driven_on) &&
                        is_driven<dim>(measure_balance(model.fields,
                                                       nodes[b],
                                                       model.communicator),
                                       velocities[b].shift));
      }
    return is_steady;
  }



  template <int dim>
  bool
  StageRunner<dim>::can_fail(const unsigned int block) const
  {
    return !model.blocks.blocks[block].is_infinite &&
           !model.conditions->active_cells.is_removed_block(block);
  }



  template <int dim>
  std::vector<unsigned int>
  StageRunner<dim>::list_failed_blocks(StageProgress<dim> &progress)
  {
    if (model.contact == nullptr || model.scene.safety.removal_slip == 0.)
      return {};
    std::vector<double> ways(model.blocks.blocks.size(), 0.);
    const auto motions =
      model.contact->motions().measure(progress.way_in_stage(model.fields));
    std::vector<unsigned int> failed = list_caught_blocks(model, motions);
    for (unsigned int b = 0; b < ways.size(); ++b)
      if (can_fail(b))
        ways[b] = motions[b].way();
    if (model.conditions->loads.is_ramping())
      progress.restart_slips();
    const std::vector<bool> is_steady =
      mark_steady_blocks(motions, ways, progress);
    for (unsigned int b = 0; b < ways.size(); ++b)
      if (can_fail(b) &&
          (ways[b] >
             model.scene.safety.removal_slip * model.blocks.blocks[b].size ||
           is_steady[b]) &&
          std::count(failed.begin(), failed.end(), b) == 0)
        failed.push_back(b);
    if (failed.empty())
      return {};
    const std::vector<bool> is_guided = mark_guided_blocks(
      model.fields,
      owned_nodes_of_blocks(model.split, *model.numbering, ways.size()),
      model.communicator);
    failed.erase(std::remove_if(failed.begin(),
                                failed.end(),
                                [&](const auto b) { return is_guided[b]; }),
                 failed.end());
    std::sort(failed.begin(), failed.end());
    return failed;
  }



  template <int dim>
  bool
  StageRunner<dim>::remove_blocks(const std::vector<unsigned int> &failed,
                                  const Stage &stage,
                                  StageProgress<dim> &progress)
  {
    if (failed.empty())
      return false;
    progress.restart_slips();
    const unsigned int number = progress.number();
    for (const unsigned int b : failed)
      {
        model.conditions->active_cells.remove_block(b);
        model.contact->remove_block(b);
        progress.removal_stage[b] = number;
      }
    const std::vector<double> out_of_balance = model.step->excavate(number);
    model.step->begin_stage(stage, number);
    // a block that has come off carries nothing that a ramp would take away
    const bool is_free =
      model.step->share_of_excavated(out_of_balance) < stage.unbalanced_ratio;
    const bool moves_supports = are_supports_to_move();
    model.conditions->loads.start_ramp(out_of_balance,
                                       is_free && !moves_supports
                                         ? 0.
                                         : ramp_duration_of(stage),
                                       moves_supports);
    model.count_cells();
    return true;
  }

  template class StageRunner<2>;
  template class StageRunner<3>;
} // namespace Keyblock
