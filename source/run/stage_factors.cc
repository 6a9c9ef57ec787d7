// SPDX-License-Identifier: LGPL-2.1-or-later
// Blocks that fail in a stage, and the safety factors at its end.
#include <keyblock/base/mpi.h>
#include <keyblock/base/teams.h>
#include <keyblock/blocks/block_resolution.h>
#include <keyblock/run/simulation.h>
#include <keyblock/safety/block_statics.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <map>

namespace Keyblock
{
  namespace
  {
    /** Slip over the size in the second half of the time so far, at a steady
     * speed, by which a block has failed [-]. */
    constexpr double steady_slip = 1e-3;
  } // namespace



  template <int dim>
  bool
  Simulation<dim>::remove_failed_blocks(const Stage &stage,
                                        StageProgress<dim> &progress)
  {
    const unsigned int index = progress.index;
    if (contact == nullptr || scene.safety.removal_slip == 0.)
      return false;
    std::vector<unsigned int> failed;
    std::vector<double> slip(blocks.blocks.size(), 0.);
    const auto can_fail = [&](const unsigned int b) {
      return !blocks.blocks[b].is_infinite &&
             !conditions->active_cells.is_removed_block(b);
    };
    for (unsigned int b = 0; b < blocks.blocks.size(); ++b)
      if (can_fail(b))
        slip[b] = norm<dim>(contact->report().mean_slip(b));
    if (conditions->loads.is_ramping())
      progress.slips.restart(progress.n_done);
    const bool is_recorded = progress.slips.offer(progress.n_done, slip);
    for (unsigned int b = 0; b < blocks.blocks.size(); ++b)
      if (can_fail(b) &&
          (slip[b] > scene.safety.removal_slip * blocks.blocks[b].size ||
           (is_recorded &&
            progress.slips.is_steady(b, steady_slip * blocks.blocks[b].size))))
        failed.push_back(b);
    if (failed.empty())
      return false;
    progress.slips.restart(progress.n_done);
    const unsigned int number = index + 2;
    for (const unsigned int b : failed)
      {
        conditions->active_cells.remove_block(b);
        contact->remove_block(b);
        removal_stage[b] = number;
      }
    const std::vector<double> carried = step->dig(number);
    step->begin_stage(stage, number);
    // a block that has come off carries nothing that a ramp would take away
    const bool is_free = step->share_of_dug(carried) < stage.unbalanced_ratio;
    conditions->loads.start_ramp(carried,
                                 is_free ? 0. : ramp_duration_of(stage));
    count_cells();
    return true;
  }



  template <int dim>
  bool
  Simulation<dim>::is_class_wanted(const unsigned int block,
                                   const unsigned int number) const
  {
    const Block<dim> &b = blocks.blocks[block];
    if (!scene.safety.wants_block(b.id) || b.is_infinite || b.is_rigid)
      return false;
    const BlockClass now =
      b.class_of_stage[std::min<std::size_t>(number,
                                             b.class_of_stage.size() - 1)];
    return now == BlockClass::exposed || now == BlockClass::hidden;
  }



  template <int dim>
  std::vector<unsigned int>
  Simulation<dim>::list_wanted_blocks(const unsigned int index) const
  {
    const unsigned int number = index + 2;
    std::vector<unsigned int> wanted;
    for (unsigned int b = 0; b < blocks.blocks.size(); ++b)
      {
        const bool is_known =
          std::any_of(safety_factors.begin(),
                      safety_factors.end(),
                      [&](const SafetyFactor &factor) {
                        return factor.block == b &&
                               factor.stage == scene.stages[index]->name;
                      });
        if (is_class_wanted(b, number) && !is_known &&
            (removal_stage[b] == 0 || removal_stage[b] >= number))
          wanted.push_back(b);
      }
    return wanted;
  }



  template <int dim>
  std::vector<unsigned int>
  Simulation<dim>::list_blocks_of_team(const unsigned int index) const
  {
    // a block costs what it did last time; one never tried, as much as any
    const std::vector<unsigned int> wanted = list_wanted_blocks(index);
    std::map<unsigned int, double> steps;
    double most = 1.;
    for (const SafetyFactor &earlier : safety_factors)
      {
        double &sum = steps[earlier.block];
        sum         = 0.;
        for (const Trial &trial : earlier.trials)
          sum += trial.n_steps;
        most = std::max(most, sum);
      }
    std::vector<double> costs;
    for (const unsigned int b : wanted)
      // the stage is run again for one that failed in it
      costs.push_back((steps.count(b) > 0 ? steps[b] : most) +
                      (removal_stage[b] == index + 2 ? present.n_done : 0));

    const std::vector<unsigned int> team = share_out(costs, n_teams());
    std::vector<unsigned int> mine;
    for (unsigned int i = 0; i < wanted.size(); ++i)
      if (team[i] == this_team())
        mine.push_back(wanted[i]);
    return mine;
  }



  template <int dim>
  SafetyFactor
  Simulation<dim>::factor_of_failed_block(StrengthReductionSearch<dim> &search,
                                          const unsigned int block,
                                          const unsigned int index,
                                          const Snapshot<dim> &before)
  {
    const double lowest       = scene.safety.lowest;
    const unsigned int number = index + 2;
    SafetyFactor result;
    if (holds_when_strong(block, index, before))
      {
        typename StrengthReductionSearch<dim>::Known known;
        known.stable   = lowest;
        known.unstable = 1.;
        known.start    = lowest;
        search.add_cheap_answers(block, result);
        if (std::isfinite(result.limit_factor))
          known.limit = result.limit_factor;
        result = search.find(block, number, known);
      }
    else
      {
        result.block        = block;
        result.outcome      = SafetyFactor::Outcome::falls_freely;
        result.upper        = lowest;
        result.failure_mode = "falling";
        recall(before, parts());
        step->dig(number);
        search.add_cheap_answers(block, result);
      }
    contact->reduce_strength(StrengthReduction());
    return result;
  }



  template <int dim>
  SafetyFactor
  Simulation<dim>::factor_of_standing_block(
    StrengthReductionSearch<dim> &search,
    const unsigned int block,
    const unsigned int index)
  {
    const Stage &stage = *scene.stages[index];
    typename StrengthReductionSearch<dim>::Known known;
    for (const SafetyFactor &earlier : safety_factors)
      if (earlier.block == block)
        known.hint = earlier.outcome == SafetyFactor::Outcome::bracketed
                       ? earlier.value()
                       : 0.;
    if (is_converged && stage.friction_angle_override < 0. &&
        stage.unbalanced_ratio > 0.)
      known.stable = 1.;
    SafetyFactor cheap;
    search.add_cheap_answers(block, cheap);
    if (known.stable > 0.)
      known.onset = cheap.stress_ratio;
    if (std::isfinite(cheap.limit_factor))
      known.limit = cheap.limit_factor;
    if (known.hint == 0.)
      known.hint =
        known.limit > 0. && known.onset > 1. ? known.onset : known.limit;
    // only rest at the joints' own strength is a start at factor 1
    if (known.stable == 0.)
      known.start = std::max(scene.safety.lowest, 0.5 * known.hint);
    return search.find(block, index + 2, known);
  }



  template <int dim>
  void
  Simulation<dim>::find_safety_factors(const unsigned int index,
                                       const Snapshot<dim> &before,
                                       const Snapshot<dim> &after)
  {
    StrengthReductionSearch<dim> search(
      scene, split, blocks, *numbering, parts());
    const std::vector<unsigned int> removed = removal_stage;
    const bool was_converged                = is_converged;
    for (const unsigned int b : list_blocks_of_team(index))
      {
        SafetyFactor result =
          removed[b] == index + 2
            ? factor_of_failed_block(search, b, index, before)
            : factor_of_standing_block(search, b, index);
        recall(after, parts());
        removal_stage = removed;
        is_converged  = was_converged;
        result.stage  = scene.stages[index]->name;
        check_factor(result);
        safety_factors.push_back(result);
        print_factor(result);
        count_cells();
        save_if_due();
      }
  }



  template <int dim>
  bool
  Simulation<dim>::holds_when_strong(const unsigned int block,
                                     const unsigned int index,
                                     const Snapshot<dim> &before)
  {
    const Stage &stage        = *scene.stages[index];
    const unsigned int number = index + 2;
    recall(before, parts());
    std::fill(removal_stage.begin(), removal_stage.end(), 0);
    StrengthReduction strong;
    strong.blocks = {block};
    strong.share  = 1. / scene.safety.lowest;
    contact->reduce_strength(strong);
    is_trial = true;
    dig_stage(stage, number);
    StageProgress<dim> progress;
    progress.index = index;
    step_through(stage, progress);
    is_trial = false;
    return removal_stage[block] == 0;
  }



  template <int dim>
  void
  Simulation<dim>::print_factor(const SafetyFactor &factor) const
  {
    if (!is_root())
      return;
    double seconds = 0.;
    for (const Trial &trial : factor.trials)
      seconds += trial.seconds;
    std::cout << "Factor  block " << blocks.blocks[factor.block].id << " after "
              << factor.stage << ": " << std::setprecision(5);
    if (factor.outcome == SafetyFactor::Outcome::bracketed)
      std::cout << factor.value() << " [" << factor.lower << ", "
                << factor.upper << "]";
    else
      std::cout << describe_outcome(factor);
    if (factor.undecided_upper > 0.)
      std::cout << ", undecided from " << factor.undecided_lower << " to "
                << factor.undecided_upper;
    if (!factor.failure_mode.empty())
      std::cout << ", " << factor.failure_mode;
    if (!factor.group.empty())
      {
        std::cout << "; blocks ";
        for (unsigned int i = 0; i < factor.group.size(); ++i)
          std::cout << (i > 0 ? ", " : "") << factor.group[i];
        std::cout << " move together: "
                  << 0.5 * (factor.group_lower + factor.group_upper) << " ["
                  << factor.group_lower << ", " << factor.group_upper << "]";
      }
    std::cout << "; limit equilibrium "
              << (has_initial_stress(scene) ? "without in-situ clamping " : "")
              << factor.limit_factor << " (" << factor.limit_mode
              << (factor.limit_remark.empty() ? "" : "; ")
              << factor.limit_remark << ")";
    if (factor.stress_ratio > 0.)
      std::cout << ", stress ratio " << factor.stress_ratio;
    const Block<dim> &block = blocks.blocks[factor.block];
    unsigned int n_broken   = 0;
    for (const Trial &trial : factor.trials)
      if (trial.is_stable && !trial.is_of_group && trial.factor == factor.lower)
        n_broken = trial.n_broken;
    if (n_broken > 0)
      std::cout << "; " << n_broken << " bonds broke in the last that held";
    if (is_too_coarse(block, scene))
      std::cout << "; only " << std::setprecision(2) << block.cells_across()
                << " cells across, not " << scene.meshing.cells_across;
    std::cout << "; " << factor.trials.size() << " trials, "
              << std::setprecision(3) << seconds << " s" << std::endl;
  }

  template bool Simulation<2>::remove_failed_blocks(const Stage &,
                                                    StageProgress<2> &);
  template bool Simulation<3>::remove_failed_blocks(const Stage &,
                                                    StageProgress<3> &);
  template void Simulation<2>::find_safety_factors(const unsigned int,
                                                   const Snapshot<2> &,
                                                   const Snapshot<2> &);
  template void Simulation<3>::find_safety_factors(const unsigned int,
                                                   const Snapshot<3> &,
                                                   const Snapshot<3> &);
} // namespace Keyblock
