// SPDX-License-Identifier: LGPL-2.1-or-later
// One trial of strength reduction: strength changes, the first phase, and how
// the two phases decide. The second one: trial_watch.cc.
#include <keyblock/base/stop_request.h>
#include <keyblock/safety/reduced_joints.h>
#include <keyblock/safety/slow_mode.h>
#include <keyblock/safety/strength_trial.h>
#include <keyblock/step/measured_steps.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace Keyblock
{
  namespace
  {
    /** Length of the change of strength, in periods of the block's lowest mode:
     * shorter ones start slip waves that shake the block loose [-]. */
    constexpr unsigned int ramp_periods = 4;

    // of blocks that creep to rest by one slow mode
    constexpr double creep_damping = 0.6; ///< over that mode's critical one [-]
    constexpr double creep_drop    = 0.5; ///< of energy, where motion stops [-]

    /** A resultant that has not fallen by a fifth in so many windows has
     * stopped falling: the rock around relaxes in several periods of the block.
     */
    constexpr unsigned int patience = 8;

    /** Swings of a block on soft support in which it may come to rest. */
    constexpr double n_swings = 20.;

    /** Resultant over the load of a group of blocks that fails at once; a
     * smaller one may be that of rock which still relaxes, and is damped once
     * more before a motion counts as failure. A block by itself fails at the
     * beginning of its motion, though it may be caught further on [-]. */
    constexpr double plain_unbalanced = 0.02;

    /** How often a block that moves off below its limit equilibrium is damped
     * once more: stress that pushes it is spent as it makes way. */
    constexpr unsigned int n_doubts = 3;

    /** Times that a block which neither rests nor speeds up is looked at. */
    constexpr unsigned int n_rounds = 5;
  } // namespace



  template <int dim>
  StrengthTrials<dim>::StrengthTrials(const Scene<dim> &scene,
                                      const SplitMesh<dim> &split,
                                      const Blocks<dim> &blocks,
                                      const Numbering<dim> &numbering,
                                      const RunParts<dim> &run)
    : measures(scene, split, blocks, numbering, run)
    , failure(scene,
              blocks,
              measures.nodes_of_block,
              run.fields,
              numbering.communicator)
    , communicator(numbering.communicator)
    , scene(scene)
    , blocks(blocks)
    , run(run)
  {}



  template <int dim>
  void
  StrengthTrials<dim>::pause() const
  {
    stop_if_asked(communicator);
    if (pulse)
      pulse();
  }



  template <int dim>
  void
  StrengthTrials<dim>::reduce(const TriedBlocks &tried, const double factor)
  {
    StrengthReduction reduction;
    if (scene.safety.reduced_joints != ReducedJoints::all)
      reduction.blocks = tried.all();
    reduction.joints = list_reduced_joints(scene);
    reduction.share  = 1. / factor;
    run.contact->reduce_strength(reduction);
    run.conditions.reduce_strength(reduction);
    if (scene.safety.reduces_rock)
      run.conditions.active_cells.reduce_strength(1. / factor);
  }



  template <int dim>
  Stage
  StrengthTrials<dim>::quiet_stage(const TriedBlocks &tried) const
  {
    Stage quiet;
    quiet.kind          = StageKind::quasi_static;
    quiet.local_damping = scene.safety.local_damping;
    quiet.damping_ratio = scene.safety.damping_ratio;
    // critical for the lowest mode of the slowest block: 2 omega
    run.conditions.scale_density(true);
    quiet.mass_damping =
      scene.safety.mass_damping * dealii::numbers::PI /
      (2. * measures.n_across(tried.block) * measures.slowness(tried)) *
      run.conditions.stable_step.frequency;
    return quiet;
  }



  template <int dim>
  Stage
  StrengthTrials<dim>::moving_stage() const
  {
    Stage moving;
    moving.damping_ratio = scene.safety.damping_ratio;
    moving.reset_motion  = true;
    if (!scene.safety.true_masses)
      moving.kind = StageKind::quasi_static;
    return moving;
  }



  template <int dim>
  void
  StrengthTrials<dim>::step_damped_until(const unsigned int last,
                                         const TriedBlocks &tried,
                                         const double drop,
                                         Trial &trial)
  {
    // kinetic damping: at a peak of its energy the block is near a balance,
    // and all motion is stopped; a block that speeds up has no peaks
    double peak = 0.;
    for (; trial.n_steps < last; ++trial.n_steps)
      {
        run.step.advance(false);
        const double now = measures.kinetic_energy(tried);
        peak             = std::max(peak, now);
        if (now < drop * peak)
          {
            run.step.stop_motion();
            peak = 0.;
          }
      }
  }



  template <int dim>
  void
  StrengthTrials<dim>::change_strength(const TriedBlocks &tried,
                                       const double from,
                                       const double to,
                                       Trial &trial)
  {
    // along half a cosine
    const unsigned int ramp = ramp_periods * measures.period(tried.block);
    double &pressure        = run.conditions.trial_pressure.value;
    const double before     = pressure;
    for (unsigned int step = 1; step <= ramp; ++step)
      {
        const double s =
          0.5 * (1. - std::cos(dealii::numbers::PI * step / ramp));
        reduce(tried, from * std::pow(to / from, s));
        pressure = before + s * (trial.pressure - before);
        run.step.advance(false);
      }
    trial.n_steps += ramp;
  }



  template <int dim>
  bool
  StrengthTrials<dim>::settle(const TriedBlocks &tried,
                              const double full_damping,
                              const Vector<dim> &first,
                              Trial &trial)
  {
    const double size         = blocks.blocks[tried.block].size;
    const unsigned int period = measures.period(tried.block);
    const double slowness     = measures.slowness(tried);
    const unsigned int window =
      std::max(1., std::round(scene.safety.window * period));
    const Motion begin        = measures.motion(tried);
    Motion before             = begin;
    double least              = std::numeric_limits<double>::max();
    double unbalanced         = least;
    unsigned int n_stuck      = 0;
    SupportState<dim> support = measures.support(tried);
    SlowMode<dim> creep(communicator,
                        run.fields,
                        measures.nodes_of_block[tried.block]);
    double slowest = 0.; // angular frequency of the creep [rad/s]
    double last    = scene.safety.maximum_periods * slowness * period;
    for (double step = 0.; step < last; step += window)
      {
        pause();
        step_damped_until(trial.n_steps + window,
                          tried,
                          slowest > 0. ? creep_drop : 1.,
                          trial);
        if (scene.safety.adaptive_damping)
          {
            slowest = creep.check();
            run.step.set_mass_damping(
              slowest > 0.
                ? std::min(full_damping, 2. * creep_damping * slowest)
                : full_damping);
          }
        const Motion now = measures.motion(tried);
        const double moved =
          measures.way_between(before, now) * period / window;
        trial.unbalanced = now.unbalanced;
        trial.slip       = norm<dim>(add<dim>(now.slip, -1., first));
        trial.velocity   = moved / (period * run.step.dt);
        const SupportState<dim> borne = measures.support(tried);
        const double swing =
          measures.swing_period(tried.block, support, borne, before, now);
        unbalanced = measures.largest_unbalanced(tried, now);
        if (unbalanced < rest_unbalanced &&
            moved * std::max(1., swing / period) < rest_slip * size)
          return true;
        const bool is_stuck = unbalanced >= 0.8 * least && swing == 0.;
        last                = std::max(last, n_swings * swing);
        n_stuck             = is_stuck ? n_stuck + 1 : 0;
        support             = borne;
        if (n_stuck == 0)
          least = unbalanced;
        if (n_stuck >= slowness * patience ||
            measures.has_passed(tried.block,
                                norm<dim>(add<dim>(now.slip, -1., begin.slip))))
          break;
        before = now;
      }
    return is_as_good_as_at_rest(unbalanced);
  }



  template <int dim>
  bool
  StrengthTrials<dim>::is_as_good_as_at_rest(const double unbalanced) const
  {
    return unbalanced < resolution * scene.safety.bracket;
  }



  template <int dim>
  bool
  StrengthTrials<dim>::is_failure(const TriedBlocks &tried,
                                  const unsigned int n_failures,
                                  const Trial &trial) const
  {
    if (tried.may_come_to_rest(trial.factor))
      return n_failures > n_doubts;
    return tried.companions.empty() || n_failures > 1 ||
           trial.unbalanced > plain_unbalanced;
  }



  template <int dim>
  typename StrengthTrials<dim>::Verdict
  StrengthTrials<dim>::decide(const TriedBlocks &tried,
                              const unsigned int number,
                              const double from,
                              const Vector<dim> &first,
                              Trial &trial)
  {
    const Stage quiet  = quiet_stage(tried);
    const Stage moving = moving_stage();
    run.step.begin_stage(quiet, number);
    change_strength(tried, from, trial.factor, trial);
    unsigned int n_failures = 0;
    for (unsigned int round = 0; round < n_rounds; ++round)
      {
        const double begin = MPI_Wtime();
        trial.phase        = 1;
        if (round > 0)
          run.step.begin_stage(quiet, number);
        const bool rests = settle(tried, quiet.mass_damping, first, trial);
        trial.phase_1_seconds += MPI_Wtime() - begin;
        if (rests)
          return Verdict::holds;
        trial.phase = 2;
        run.step.begin_stage(moving, number);
        const Verdict verdict =
          watch(tried, (round + 1) * watch_periods, first, trial);
        if (verdict == Verdict::holds)
          return verdict;
        if (verdict == Verdict::fails && is_failure(tried, ++n_failures, trial))
          return verdict;
      }
    return Verdict::open;
  }



  template <int dim>
  Trial
  StrengthTrials<dim>::try_factor(const TriedBlocks &tried,
                                  const unsigned int number,
                                  const double start,
                                  const double factor,
                                  const Vector<dim> &first,
                                  const double pressure)
  {
    const double begin = MPI_Wtime();
    Trial trial;
    trial.factor   = factor;
    trial.pressure = pressure;
    trial.start    = start;
    reduce(tried, start);
    run.conditions.scale_density(false);
    const double true_mass = measures.mass_in_use(tried.block);
    const MeasuredSteps<dim> guard(run.step);
    const unsigned int n_bonds = measures.n_intact(tried.block);
    Verdict verdict            = decide(tried, number, start, first, trial);
    if (verdict == Verdict::holds && tried.is_above_limit(factor))
      verdict = decide_as_it_slides(tried, number, first, trial);
    trial.is_stable    = verdict == Verdict::holds;
    trial.is_undecided = verdict == Verdict::open;
    trial.n_broken =
      n_bonds - std::min(n_bonds, measures.n_intact(tried.block));
    const std::vector<double> weakened =
      run.contact->report().weakened_area(tried.block);
    trial.weakened_area = std::accumulate(weakened.begin(), weakened.end(), 0.);
    for (; trial.n_steps < scene.safety.trial_steps; ++trial.n_steps)
      run.step.advance(false);
    if (verdict == Verdict::fails)
      failure.note(tried.block, run.contact->report().mean_slip(tried.block));
    // of the true masses
    const double ratio = measures.mass_in_use(tried.block) / true_mass;
    trial.velocity *= std::sqrt(ratio);
    trial.acceleration *= ratio;
    trial.seconds = MPI_Wtime() - begin;
    return trial;
  }



  template class StrengthTrials<2>;
  template class StrengthTrials<3>;
} // namespace Keyblock
