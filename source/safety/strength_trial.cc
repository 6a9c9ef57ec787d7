// SPDX-License-Identifier: LGPL-2.1-or-later
// One trial of strength reduction, and how it is decided.
#include <keyblock/base/stop_request.h>
#include <keyblock/safety/slow_mode.h>
#include <keyblock/safety/strength_trial.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace Keyblock
{
  namespace
  {
    // what counts as rest (method: see doc/theory.md, section 12)
    constexpr double rest_unbalanced = 1e-5; ///< over the weight [-]
    constexpr double rest_slip       = 1e-6; ///< per period, over the size [-]

    /** Share of the bracket that a resultant over the weight may have that is
     * not told from rest [-]. */
    constexpr double resolution = 0.02;

    /** Slip over the size at which a growing motion is a failure [-]. */
    constexpr double failure_slip = 1e-3;

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

    /** Length of the second phase, at most, in periods of the block's lowest
     * mode, the first time and so much longer each time after it: what is open
     * then goes back to the first one, which damps [-]. */
    constexpr double watch_periods = 20.;

    // acceleration of slip over that of the block [-]
    constexpr double least_share = 0.3; ///< what the block slips on moves along
    constexpr double free_share  = 0.8; ///< the block moves by itself
    constexpr double most_share  = 1.25;

    // loss of acceleration of a block on its way to failure [-]
    constexpr double steady_alone = 0.1;  ///< of a block that moves by itself
    constexpr double steady_along = 0.01; ///< of one whose neighbours go along

    /** Slip over the block's compression by its load, before which speeding up
     * may be no more than strength that is not yet mobilised [-]. */
    constexpr double mobilising_slip = 0.02;

    /** Windows over which such an acceleration must stay. */
    constexpr unsigned int n_steady = 6;

    /** Way of another block, in the direction of the one that fails and over
     * its way, from which on they move together [-]. */
    constexpr double along_share = 0.5;

    /** Times that a block which neither rests nor speeds up is looked at. */
    constexpr unsigned int n_rounds = 5;
  } // namespace



  template <int dim>
  StrengthTrials<dim>::StrengthTrials(const Scene<dim> &scene,
                                      const SplitMesh<dim> &split,
                                      const Blocks<dim> &blocks,
                                      const Numbering<dim> &numbering,
                                      const RunParts<dim> &run)
    : communicator(numbering.communicator)
    , scene(scene)
    , split(split)
    , blocks(blocks)
    , run(run)
    , nodes_of_block(blocks.blocks.size())
  {
    for (unsigned int c = 0; c < split.mesh.n_cells(); ++c)
      if (split.block_of_cell[c] != none)
        for (const unsigned int v : split.mesh.cells[c])
          if (numbering.is_owned(v))
            nodes_of_block[split.block_of_cell[c]].push_back(
              numbering.local_node(v));
    for (auto &nodes : nodes_of_block)
      {
        std::sort(nodes.begin(), nodes.end());
        nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
      }
  }



  template <int dim>
  void
  StrengthTrials<dim>::reduce(const unsigned int block, const double factor)
  {
    StrengthReduction reduction;
    if (scene.safety.reduced_joints != ReducedJoints::all)
      {
        reduction.blocks = companions;
        reduction.blocks.push_back(block);
      }
    if (!scene.safety.joints.empty())
      reduction.joints.assign(scene.joints.size(), false);
    for (const std::string &name : scene.safety.joints)
      for (const unsigned int joint : scene.joints_called(name))
        reduction.joints[joint] = true;
    reduction.share = 1. / factor;
    run.contact->reduce_strength(reduction);
    run.conditions.reduce_strength(reduction);
    if (scene.safety.reduces_rock)
      run.conditions.active_cells.reduce_strength(1. / factor);
  }



  template <int dim>
  typename StrengthTrials<dim>::Motion
  StrengthTrials<dim>::measure(const unsigned int block) const
  {
    // resultant of everything but damping, loads, and size of contact forces
    std::vector<double> sums(3 * dim + 2, 0.);
    const Fields<dim> &fields = run.fields;
    for (const unsigned int node : nodes_of_block[block])
      for (unsigned int d = 0; d < dim; ++d)
        {
          sums[2 * dim + 2 + d] +=
            fields.mass[node] * fields.velocity[dim * node + d];
          sums[2 * dim + 1] += fields.mass[node] / dim;
          const unsigned int i = dim * node + d;
          sums[d] +=
            fields.load[i] - fields.internal_force[i] + fields.contact_force[i];
          sums[dim + d] += fields.load[i];
          sums[2 * dim] += std::abs(fields.contact_force[i]);
        }
    communicator.sum_lists(sums);
    double resultant = 0., weight = 0.;
    for (unsigned int d = 0; d < dim; ++d)
      {
        resultant += sums[d] * sums[d];
        weight += sums[dim + d] * sums[dim + d];
      }
    Motion motion;
    motion.slip = run.contact->report().mean_slip(block);
    motion.load = std::max(std::sqrt(weight), 1e-3 * sums[2 * dim]);
    motion.unbalanced =
      motion.load > 0. ? std::sqrt(resultant) / motion.load : 0.;
    for (unsigned int d = 0; d < dim; ++d)
      motion.velocity[d] = sums[2 * dim + 2 + d] / sums[2 * dim + 1];
    return motion;
  }



  template <int dim>
  double
  StrengthTrials<dim>::n_across(const unsigned int block) const
  {
    const Block<dim> &b = blocks.blocks[block];
    return std::max(4., b.size / std::pow(b.volume / b.n_cells, 1. / dim));
  }



  template <int dim>
  unsigned int
  StrengthTrials<dim>::period_of(const unsigned int block) const
  {
    return std::ceil(4. * n_across(block) / scene.time_stepping.safety);
  }



  template <int dim>
  double
  StrengthTrials<dim>::wave_speed(const unsigned int block) const
  {
    double speed = 0.;
    for (unsigned int c = 0; c < split.mesh.n_cells(); ++c)
      if (split.block_of_cell[c] == block)
        {
          const Material<dim> &m = *scene.materials[split.mesh.material[c]];
          speed =
            std::max(speed,
                     std::sqrt((m.lame_lambda() + 2. * m.shear_modulus()) /
                               m.density));
        }
    return speed;
  }



  template <int dim>
  double
  StrengthTrials<dim>::compression(const unsigned int block,
                                   const double load) const
  {
    const Block<dim> &b = blocks.blocks[block];
    double modulus      = 0.;
    for (unsigned int c = 0; c < split.mesh.n_cells(); ++c)
      if (split.block_of_cell[c] == block)
        {
          const Material<dim> &m = *scene.materials[split.mesh.material[c]];
          modulus = std::max(modulus, m.lame_lambda() + 2. * m.shear_modulus());
        }
    return load * b.size * b.size / (modulus * b.volume);
  }



  template <int dim>
  double
  StrengthTrials<dim>::kinetic_energy(const unsigned int block) const
  {
    double energy = 0.;
    for (const unsigned int node : nodes_of_block[block])
      for (unsigned int i = dim * node; i < dim * (node + 1); ++i)
        energy += 0.5 * run.fields.mass[node] * run.fields.velocity[i] *
                  run.fields.velocity[i];
    return communicator.sum(energy);
  }



  template <int dim>
  double
  StrengthTrials<dim>::mass_in_use(const unsigned int block) const
  {
    double mass = 0.;
    for (const unsigned int node : nodes_of_block[block])
      mass += run.fields.mass[node];
    return communicator.sum(mass);
  }



  template <int dim>
  unsigned int
  StrengthTrials<dim>::n_intact(const unsigned int block) const
  {
    unsigned int n = 0;
    for (const JointSums<dim> &sums :
         run.contact->report().sum_over_block(block))
      n += sums.n_intact;
    return n;
  }



  template <int dim>
  void
  StrengthTrials<dim>::step_damped_until(const unsigned int last,
                                         const unsigned int block,
                                         const double drop,
                                         Trial &trial)
  {
    // kinetic damping: at a peak of its energy the block is near a balance,
    // and all motion is stopped; a block that speeds up has no peaks
    double peak = 0.;
    for (; trial.n_steps < last; ++trial.n_steps)
      {
        run.step.advance(false);
        const double now = kinetic_energy(block);
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
  StrengthTrials<dim>::change_strength(const unsigned int block, Trial &trial)
  {
    // along half a cosine
    const unsigned int ramp = ramp_periods * period_of(block);
    for (; trial.n_steps < ramp; ++trial.n_steps)
      {
        const double s =
          0.5 *
          (1. - std::cos(dealii::numbers::PI * (trial.n_steps + 1.) / ramp));
        reduce(block, trial.start * std::pow(trial.factor / trial.start, s));
        run.step.advance(false);
      }
  }



  template <int dim>
  bool
  StrengthTrials<dim>::settle(const unsigned int block,
                              const double full_damping,
                              const Vector<dim> &first,
                              Trial &trial)
  {
    const double size         = blocks.blocks[block].size;
    const unsigned int period = period_of(block);
    const unsigned int window =
      std::max(1., std::round(scene.safety.window * period));
    Vector<dim> before   = run.contact->report().mean_slip(block);
    double least         = std::numeric_limits<double>::max();
    unsigned int n_stuck = 0;
    SlowMode<dim> creep(communicator, run.fields, nodes_of_block[block]);
    double slowest = 0.; // angular frequency of the creep [rad/s]
    for (unsigned int step = 0; step < scene.safety.maximum_periods * period;
         step += window)
      {
        stop_if_asked(communicator);
        step_damped_until(trial.n_steps + window,
                          block,
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
        const Motion now = measure(block);
        const double moved =
          norm<dim>(add<dim>(now.slip, -1., before)) * period / window;
        trial.unbalanced = now.unbalanced;
        trial.slip       = norm<dim>(add<dim>(now.slip, -1., first));
        trial.velocity   = moved / (period * run.step.dt);
        if (now.unbalanced < rest_unbalanced && moved < rest_slip * size)
          return true;
        n_stuck = now.unbalanced < 0.8 * least ? 0 : n_stuck + 1;
        if (n_stuck == 0)
          least = now.unbalanced;
        if (n_stuck >= patience)
          break;
        before = now.slip;
      }
    return is_as_good_as_at_rest(trial);
  }



  template <int dim>
  bool
  StrengthTrials<dim>::is_as_good_as_at_rest(const Trial &trial) const
  {
    return trial.unbalanced < resolution * scene.safety.bracket;
  }



  template <int dim>
  typename StrengthTrials<dim>::Verdict
  StrengthTrials<dim>::watch(const unsigned int block,
                             const double periods,
                             const Vector<dim> &first,
                             Trial &trial)
  {
    const double size = blocks.blocks[block].size;
    const unsigned int window =
      std::max(1.,
               std::ceil(scene.safety.window *
                         (scene.safety.true_masses
                            ? 4. * size / (wave_speed(block) * run.step.dt)
                            : period_of(block))));
    const double seconds = window * run.step.dt;
    const unsigned int n_windows =
      std::max(n_steady + 1.,
               std::min(periods, scene.safety.maximum_periods) /
                 scene.safety.window);
    const Vector<dim> at_rest = run.contact->report().mean_slip(block);
    const double mass         = mass_in_use(block);
    displacement_before       = run.fields.displacement;
    joint_force.assign(scene.joints.size() + 1, 0.);
    Vector<dim> before = at_rest;
    std::vector<double> velocity(1, 0.);
    std::vector<Vector<dim>> block_velocity(1);
    for (unsigned int w = 1; w <= n_windows; ++w)
      {
        stop_if_asked(communicator);
        for (unsigned int step = 0; step < window; ++step)
          run.step.advance(false);
        trial.n_steps += window;
        const Motion now = measure(block);
        const auto sums  = run.contact->report().sum_over_block(block);
        for (unsigned int j = 0; j < sums.size(); ++j)
          joint_force[j] += sums[j].normal;
        const Vector<dim> way   = add<dim>(now.slip, -1., at_rest);
        const Vector<dim> moved = add<dim>(now.slip, -1., before);
        const double slip       = norm<dim>(way);
        trial.slip              = norm<dim>(add<dim>(now.slip, -1., first));
        trial.unbalanced        = now.unbalanced;
        // of the slip along the way so far
        velocity.push_back(slip > 0. ? dot<dim>(moved, way) / (slip * seconds)
                                     : 0.);
        block_velocity.push_back(now.velocity);
        trial.velocity     = velocity[w];
        trial.acceleration = (velocity[w] - velocity[w - 1]) / seconds;
        before             = now.slip;
        if (now.unbalanced < rest_unbalanced &&
            norm<dim>(moved) < rest_slip * size)
          return Verdict::holds;
        const bool grows = w >= 3 && velocity[w] > velocity[w - 1] &&
                           velocity[w - 1] > velocity[w - 2] &&
                           velocity[w - 2] > 0.;
        if (grows && slip > failure_slip * size)
          return Verdict::fails;
        if (w > n_steady)
          {
            // forces that stay and move the block as they would a free body;
            // one whose neighbours go along may be held by their stiffness
            // later
            const double span = n_steady * seconds;
            const double early =
              velocity[w - n_steady / 2] - velocity[w - n_steady];
            const double late = velocity[w] - velocity[w - n_steady / 2];
            const double own  = norm<dim>(
              add<dim>(now.velocity, -1., block_velocity[w - n_steady]));
            const double share = own > 0. ? (early + late) / own : 0.;
            const double loss =
              share > free_share ? steady_alone : steady_along;
            if (slip > mobilising_slip * compression(block, now.load) &&
                velocity[w - n_steady] >= 0. && early > 0. &&
                late > (1. - loss) * early && share > least_share &&
                share < most_share &&
                mass * own / span >
                  resolution * scene.safety.bracket * now.load)
              return Verdict::fails;
          }
      }
    return Verdict::open;
  }



  template <int dim>
  Stage
  StrengthTrials<dim>::quiet_stage(const unsigned int block) const
  {
    Stage quiet;
    quiet.kind          = StageKind::quasi_static;
    quiet.local_damping = scene.safety.local_damping;
    quiet.damping_ratio = scene.safety.damping_ratio;
    // critical for the block's lowest mode: 2 omega
    run.conditions.scale_density(true);
    quiet.mass_damping = scene.safety.mass_damping * dealii::numbers::PI /
                         (2. * n_across(block)) *
                         run.conditions.stable_step.frequency;
    return quiet;
  }



  template <int dim>
  typename StrengthTrials<dim>::Verdict
  StrengthTrials<dim>::decide(const unsigned int block,
                              const unsigned int number,
                              const Vector<dim> &first,
                              Trial &trial)
  {
    const Stage quiet = quiet_stage(block);
    Stage moving;
    moving.damping_ratio = scene.safety.damping_ratio;
    moving.reset_motion  = true;
    if (!scene.safety.true_masses)
      moving.kind = StageKind::quasi_static;

    run.step.begin_stage(quiet, number);
    change_strength(block, trial);
    for (unsigned int round = 0; round < n_rounds; ++round)
      {
        const double begin = MPI_Wtime();
        trial.phase        = 1;
        if (round > 0)
          run.step.begin_stage(quiet, number);
        const bool rests = settle(block, quiet.mass_damping, first, trial);
        trial.phase_1_seconds += MPI_Wtime() - begin;
        if (rests)
          return Verdict::holds;
        trial.phase = 2;
        run.step.begin_stage(moving, number);
        const Verdict verdict =
          watch(block, (round + 1) * watch_periods, first, trial);
        if (verdict != Verdict::open)
          return verdict;
      }
    return Verdict::open;
  }



  template <int dim>
  Trial
  StrengthTrials<dim>::try_factor(const unsigned int block,
                                  const unsigned int number,
                                  const double start,
                                  const double factor,
                                  const Vector<dim> &first)
  {
    const double begin = MPI_Wtime();
    Trial trial;
    trial.factor = factor;
    trial.start  = start;
    reduce(block, start);
    run.conditions.scale_density(false);
    const double true_mass = mass_in_use(block);
    // forces on the block are measured at any step
    const bool keeps_ledger    = run.step.keeps_ledger;
    const bool skips_resting   = run.step.skips_resting;
    run.step.keeps_ledger      = false;
    run.step.skips_resting     = false;
    const unsigned int n_bonds = n_intact(block);
    const Verdict verdict      = decide(block, number, first, trial);
    trial.is_stable            = verdict == Verdict::holds;
    trial.is_undecided         = verdict == Verdict::open;
    trial.n_broken             = n_bonds - std::min(n_bonds, n_intact(block));
    for (; trial.n_steps < scene.safety.trial_steps; ++trial.n_steps)
      run.step.advance(false);
    run.step.keeps_ledger  = keeps_ledger;
    run.step.skips_resting = skips_resting;
    if (verdict == Verdict::fails)
      {
        last_failure = name_failure(block);
        last_along   = list_blocks_along(block);
      }
    // of the true masses
    const double ratio = mass_in_use(block) / true_mass;
    trial.velocity *= std::sqrt(ratio);
    trial.acceleration *= ratio;
    trial.seconds = MPI_Wtime() - begin;
    return trial;
  }



  template <int dim>
  std::vector<unsigned int>
  StrengthTrials<dim>::list_blocks_along(const unsigned int block) const
  {
    // mean ways of the blocks in the second phase
    const unsigned int n_blocks = blocks.blocks.size();
    std::vector<double> sums((dim + 1) * n_blocks, 0.);
    for (unsigned int b = 0; b < n_blocks; ++b)
      for (const unsigned int node : nodes_of_block[b])
        {
          const double m = run.fields.mass[node];
          for (unsigned int d = 0; d < dim; ++d)
            sums[(dim + 1) * b + d] +=
              m * (run.fields.displacement[dim * node + d] -
                   displacement_before[dim * node + d]);
          sums[(dim + 1) * b + dim] += m;
        }
    communicator.sum_lists(sums);
    const auto way = [&](const unsigned int b) {
      Vector<dim> mean{};
      for (unsigned int d = 0; d < dim && sums[(dim + 1) * b + dim] > 0.; ++d)
        mean[d] = sums[(dim + 1) * b + d] / sums[(dim + 1) * b + dim];
      return mean;
    };
    const Vector<dim> own = way(block);
    std::vector<unsigned int> along;
    for (unsigned int b = 0; b < n_blocks; ++b)
      if (b != block && !blocks.blocks[b].is_infinite &&
          !blocks.blocks[b].is_rigid &&
          dot<dim>(way(b), own) > along_share * dot<dim>(own, own))
        along.push_back(b);
    return along;
  }



  template <int dim>
  std::string
  StrengthTrials<dim>::name_failure(const unsigned int block) const
  {
    // a motion that varies over the block more than its mean is a rotation
    std::vector<double> sums(dim + 2, 0.);
    for (const unsigned int node : nodes_of_block[block])
      {
        const double m = run.fields.mass[node];
        sums[0] += m;
        for (unsigned int d = 0; d < dim; ++d)
          {
            const double way = run.fields.displacement[dim * node + d] -
                               displacement_before[dim * node + d];
            sums[1] += m * way * way;
            sums[2 + d] += m * way;
          }
      }
    communicator.sum_lists(sums);
    double mean = 0.;
    for (unsigned int d = 0; d < dim; ++d)
      mean += sums[2 + d] * sums[2 + d];
    mean /= sums[0];
    const bool rotates = mean < 0.75 * sums[1];

    const double total =
      std::accumulate(joint_force.begin(), joint_force.end(), 0.);
    std::string names;
    for (unsigned int j = 0; j < joint_force.size(); ++j)
      if (joint_force[j] > 0.01 * total && joint_force[j] > 0.)
        names += (names.empty() ? "" : "/") + (j < scene.joints.size()
                                                 ? scene.joints[j]->name
                                                 : std::string("a free face"));
    if (names.empty())
      return "falling";
    return (rotates ? "rotating on " : "sliding on ") + names;
  }



  template class StrengthTrials<2>;
  template class StrengthTrials<3>;
} // namespace Keyblock
