// SPDX-License-Identifier: LGPL-2.1-or-later
// Strength reduction: trials, their decision, and the search for the factor.
#include <keyblock/expression.h>
#include <keyblock/mpi.h>
#include <keyblock/safety_factor.h>
#include <keyblock/stop_request.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace Keyblock
{
  namespace
  {
    // what counts as rest (method: see doc/theory.md, section 12)
    constexpr double rest_unbalanced = 1e-5; ///< over the weight [-]
    constexpr double rest_slip       = 1e-6; ///< per period, over the size [-]

    /** Slip over the size below which nothing has failed, however its velocity
     * wavers [-]. */
    constexpr double least_slip = 1e-5;

    /** Slip over the size at which a growing motion is a failure [-]. */
    constexpr double failure_slip = 1e-3;

    /** Length of the change of strength, in periods of the block's lowest mode:
     * shorter ones start slip waves that shake the block loose [-]. */
    constexpr unsigned int ramp_periods = 4;

    /** A resultant over the weight that, if it stays, needs no more looking at
     * for a rest [-]. */
    constexpr double clear_resultant = 1e-2;

    /** Increments of velocity of two windows that differ by less are one
     * acceleration [-]. */
    constexpr double steadiness = 0.2;
  } // namespace



  std::string
  to_string(const SafetyFactor::Outcome outcome)
  {
    switch (outcome)
      {
        case SafetyFactor::Outcome::bracketed:
          return "value";
        case SafetyFactor::Outcome::falls_freely:
          return "falls freely";
        case SafetyFactor::Outcome::immovable:
          return "immovable";
      }
    return "";
  }



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
    , numbering(numbering)
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
  StrengthReductionSearch<dim>::reduce(const unsigned int block,
                                       const double factor)
  {
    StrengthReduction reduction;
    reduction.block = scene.safety.reduced_joints == "all" ? none : block;
    if (!scene.safety.joints.empty())
      for (const auto &joint : scene.joints)
        reduction.joints.push_back(std::find(scene.safety.joints.begin(),
                                             scene.safety.joints.end(),
                                             joint->name) !=
                                   scene.safety.joints.end());
    reduction.share = 1. / factor;
    run.contact->reduce_strength(reduction);
    if (scene.safety.reduces_rock)
      run.conditions.reduce_strength(1. / factor);
  }



  template <int dim>
  typename StrengthReductionSearch<dim>::Motion
  StrengthReductionSearch<dim>::measure(const unsigned int block) const
  {
    // resultant of everything but damping, loads, and size of contact forces
    std::vector<double> sums(2 * dim + 1, 0.);
    const Fields<dim> &fields = run.fields;
    for (const unsigned int node : nodes_of_block[block])
      for (unsigned int d = 0; d < dim; ++d)
        {
          const unsigned int i = dim * node + d;
          sums[d] +=
            fields.load[i] - fields.internal_force[i] + fields.contact_force[i];
          sums[dim + d] += fields.load[i];
          sums[2 * dim] += std::abs(fields.contact_force[i]);
        }
    dealii::Utilities::MPI::sum(sums, world(), sums);
    double resultant = 0., weight = 0.;
    for (unsigned int d = 0; d < dim; ++d)
      {
        resultant += sums[d] * sums[d];
        weight += sums[dim + d] * sums[dim + d];
      }
    Motion motion;
    motion.slip        = run.contact->mean_slip(block);
    const double scale = std::max(std::sqrt(weight), 1e-3 * sums[2 * dim]);
    motion.unbalanced  = scale > 0. ? std::sqrt(resultant) / scale : 0.;
    return motion;
  }



  template <int dim>
  void
  StrengthReductionSearch<dim>::step_until(const unsigned int last,
                                           Trial &trial)
  {
    stop_if_asked();
    for (; trial.n_steps < last; ++trial.n_steps)
      run.step.advance(false);
  }



  template <int dim>
  double
  StrengthReductionSearch<dim>::n_across(const unsigned int block) const
  {
    const Block<dim> &b = blocks.blocks[block];
    return std::max(4., b.size / std::pow(b.volume / b.n_cells, 1. / dim));
  }



  template <int dim>
  double
  StrengthReductionSearch<dim>::kinetic_energy(const unsigned int block) const
  {
    double energy = 0.;
    for (const unsigned int node : nodes_of_block[block])
      for (unsigned int i = dim * node; i < dim * (node + 1); ++i)
        energy += 0.5 * run.fields.mass[node] * run.fields.velocity[i] *
                  run.fields.velocity[i];
    return dealii::Utilities::MPI::sum(energy, world());
  }



  template <int dim>
  void
  StrengthReductionSearch<dim>::step_damped_until(const unsigned int last,
                                                  const unsigned int block,
                                                  Trial &trial)
  {
    // kinetic damping: at a peak of its energy the block is near a balance,
    // and all motion is stopped; a block that speeds up has no peaks
    double before = 0.;
    stop_if_asked();
    for (; trial.n_steps < last; ++trial.n_steps)
      {
        run.step.advance(false);
        const double now = kinetic_energy(block);
        if (now < before)
          run.step.stop_motion();
        before = now < before ? 0. : now;
      }
  }



  template <int dim>
  bool
  StrengthReductionSearch<dim>::settle(const unsigned int block,
                                       const double start,
                                       Trial &trial)
  {
    // a wave crosses one cell a step, and the block four times in a period
    const Block<dim> &b = blocks.blocks[block];
    const unsigned int period =
      std::ceil(4. * n_across(block) / scene.time_stepping.safety);
    const unsigned int window =
      std::max(1., std::round(scene.safety.window * period));
    const Vector<dim> first = run.contact->mean_slip(block);
    // strengths change along half a cosine
    const unsigned int ramp = ramp_periods * period;
    for (; trial.n_steps < ramp; ++trial.n_steps)
      {
        const double s =
          0.5 *
          (1. - std::cos(dealii::numbers::PI * (trial.n_steps + 1.) / ramp));
        reduce(block, 1. / ((1. - s) / start + s / trial.factor));
        run.step.advance(false);
      }
    Motion before             = measure(block);
    double step_before        = 0.;
    unsigned int n_persistent = 0;
    for (unsigned int w = 1;
         w * window <= scene.safety.maximum_periods * period;
         ++w)
      {
        step_damped_until(ramp + w * window, block, trial);
        const Motion now = measure(block);
        const double moved =
          norm<dim>(add<dim>(now.slip, -1., before.slip)) * period / window;
        trial.unbalanced = now.unbalanced;
        trial.slip       = norm<dim>(add<dim>(now.slip, -1., first));
        trial.velocity   = moved / (period * run.step.dt);
        if (now.unbalanced < rest_unbalanced && moved < rest_slip * b.size)
          return true;
        const bool persists = now.unbalanced > clear_resultant &&
                              std::abs(now.unbalanced - before.unbalanced) <
                                steadiness * before.unbalanced &&
                              moved > (1. - steadiness) * step_before;
        n_persistent = persists ? n_persistent + 1 : 0;
        if (n_persistent >= 3)
          return false;
        before      = now;
        step_before = moved;
      }
    return false;
  }



  template <int dim>
  void
  StrengthReductionSearch<dim>::watch(const unsigned int block, Trial &trial)
  {
    const Block<dim> &b = blocks.blocks[block];
    double speed        = 0.;
    for (unsigned int c = 0; c < split.mesh.n_cells(); ++c)
      if (split.block_of_cell[c] == block)
        {
          const Material<dim> &m = *scene.materials[split.mesh.material[c]];
          speed =
            std::max(speed,
                     std::sqrt((m.lame_lambda() + 2. * m.shear_modulus()) /
                               m.density));
        }
    const double length       = scene.safety.window * 4. * b.size / speed;
    const unsigned int window = std::max(1., std::ceil(length / run.step.dt));
    const double seconds      = window * run.step.dt;
    const unsigned int begin  = trial.n_steps;
    const unsigned int n_windows =
      std::max(4., scene.safety.maximum_periods / scene.safety.window);
    const Vector<dim> first = run.contact->mean_slip(block);
    displacement_before     = run.fields.displacement;
    Vector<dim> before      = first;
    std::vector<double> velocity;
    for (unsigned int w = 1; w <= n_windows; ++w)
      {
        step_until(begin + w * window, trial);
        const Motion now      = measure(block);
        const Vector<dim> way = add<dim>(now.slip, -1., first);
        trial.slip            = norm<dim>(way);
        trial.unbalanced      = now.unbalanced;
        // of the slip along the way so far
        const Vector<dim> moved = add<dim>(now.slip, -1., before);
        velocity.push_back(
          trial.slip > 0. ? dot<dim>(moved, way) / (trial.slip * seconds) : 0.);
        trial.velocity = velocity.back();
        before         = now.slip;
        if (now.unbalanced < rest_unbalanced &&
            norm<dim>(moved) < rest_slip * b.size)
          {
            trial.is_stable = true;
            return;
          }
        if (w < 3)
          continue;
        const double a1    = velocity[w - 1] - velocity[w - 2];
        const double a2    = velocity[w - 2] - velocity[w - 3];
        trial.acceleration = 0.5 * (a1 + a2) / seconds;
        const bool grows   = a1 >= 0. && a2 >= 0. && velocity[w - 3] > 0.;
        if (grows && trial.slip > failure_slip * b.size)
          return;
        if (w >= 4 && grows && trial.slip > least_slip * b.size &&
            now.unbalanced > 10. * rest_unbalanced && a1 > 0. &&
            std::abs(a1 - a2) < steadiness * std::max(a1, a2))
          return;
      }
    trial.is_stable =
      trial.acceleration <= 0. || trial.slip < least_slip * b.size;
  }



  template <int dim>
  Trial
  StrengthReductionSearch<dim>::try_factor(const unsigned int block,
                                           const unsigned int number,
                                           const double factor,
                                           const double start)
  {
    const double begin = MPI_Wtime();
    Trial trial;
    trial.factor = factor;
    reduce(block, start);
    Stage quiet;
    quiet.kind          = "quasi-static";
    quiet.local_damping = scene.safety.local_damping;
    quiet.damping_ratio = scene.safety.damping_ratio;
    // critical for the block's lowest mode: 2 omega
    run.conditions.scale_density(true);
    quiet.mass_damping = scene.safety.mass_damping * dealii::numbers::PI /
                         (2. * n_across(block)) *
                         run.conditions.stable_step.frequency;
    run.step.begin_stage(quiet, number);
    trial.is_stable       = settle(block, start, trial);
    trial.phase_1_seconds = MPI_Wtime() - begin;
    if (!trial.is_stable)
      {
        trial.phase = 2;
        Stage moving;
        moving.damping_ratio = scene.safety.damping_ratio;
        moving.reset_motion  = true;
        run.step.begin_stage(moving, number);
        watch(block, trial);
        if (!trial.is_stable)
          last_failure = name_failure(block);
      }
    trial.seconds = MPI_Wtime() - begin;
    return trial;
  }



  template <int dim>
  SafetyFactor
  StrengthReductionSearch<dim>::find(const unsigned int block,
                                     const unsigned int number,
                                     const Known &known)
  {
    SafetyFactor result;
    result.block = block;
    add_cheap_answers(block, result);
    last_failure.clear();
    if (scene.safety.method == "sweep")
      sweep(block, number, known, result);
    else
      bisect(block, number, known, result);
    result.failure_mode = last_failure;
    reduce(block, 1.);
    return result;
  }



  template <int dim>
  void
  StrengthReductionSearch<dim>::bisect(const unsigned int block,
                                       const unsigned int number,
                                       const Known &known,
                                       SafetyFactor &result)
  {
    const SafetySettings &settings = scene.safety;
    const Snapshot<dim> state      = take_snapshot(run);
    double stable = known.stable, unstable = known.unstable;
    const auto holds_at = [&](const double factor) {
      const Trial trial = try_factor(block, number, factor, known.start);
      recall(state, run);
      result.trials.push_back(trial);
      if (trial.is_stable)
        stable = std::max(stable, factor);
      else
        unstable = unstable == 0. ? factor : std::min(unstable, factor);
      return trial.is_stable;
    };
    const auto is_open = [&](const double factor) {
      return factor > stable && (unstable == 0. || factor < unstable);
    };
    // on either side of the guess, then further and further from it
    double spread = 0.4 * settings.bracket;
    double middle = known.hint > 0. ? known.hint : std::max(1., stable);
    if (known.hint == 0.)
      {
        // nothing to go by: most such blocks cannot move at all
        spread = 0.5;
        if (stable > 0. && unstable == 0.)
          holds_at(settings.highest);
        if (stable >= settings.highest)
          {
            result.outcome = SafetyFactor::Outcome::immovable;
            result.lower   = stable;
            return;
          }
      }
    while (stable == 0. || unstable == 0.)
      {
        const double below = std::max(settings.lowest, middle / (1. + spread));
        const double above = std::min(settings.highest, middle * (1. + spread));
        if (stable == 0. && (unstable == 0. || below < unstable))
          holds_at(below);
        if (stable == 0. && unstable <= settings.lowest * (1. + 1e-9) &&
            unstable > 0.)
          {
            result.outcome = SafetyFactor::Outcome::falls_freely;
            result.upper   = unstable;
            return;
          }
        if (unstable == 0. && is_open(above))
          holds_at(above);
        if (stable >= settings.highest * (1. - 1e-9))
          {
            result.outcome = SafetyFactor::Outcome::immovable;
            result.lower   = stable;
            return;
          }
        spread = std::max(4. * spread, 1.2 * spread);
      }
    while (unstable - stable > settings.bracket * unstable)
      {
        double factor = unstable > 2. * stable ? std::sqrt(stable * unstable)
                                               : 0.5 * (stable + unstable);
        holds_at(factor);
      }
    result.lower = stable;
    result.upper = unstable;
  }



  template <int dim>
  void
  StrengthReductionSearch<dim>::sweep(const unsigned int block,
                                      const unsigned int number,
                                      const Known &known,
                                      SafetyFactor &result)
  {
    const SafetySettings &settings = scene.safety;
    const Snapshot<dim> state      = take_snapshot(run);
    double stable                  = known.stable;
    for (double factor = std::max(stable, settings.lowest);
         factor <= settings.highest;
         factor += settings.sweep_step)
      {
        if (factor == known.stable)
          continue;
        const Trial trial = try_factor(block, number, factor, known.start);
        recall(state, run);
        result.trials.push_back(trial);
        if (!trial.is_stable)
          {
            if (stable == 0.)
              result.outcome = SafetyFactor::Outcome::falls_freely;
            result.lower = stable;
            result.upper = factor;
            return;
          }
        stable = factor;
      }
    result.outcome = SafetyFactor::Outcome::immovable;
    result.lower   = stable;
  }



  template <int dim>
  std::string
  StrengthReductionSearch<dim>::name_failure(const unsigned int block)
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
    dealii::Utilities::MPI::sum(sums, world(), sums);
    double mean = 0.;
    for (unsigned int d = 0; d < dim; ++d)
      mean += sums[2 + d] * sums[2 + d];
    mean /= sums[0];
    const bool rotates = mean < 0.75 * sums[1];

    const std::vector<JointSums<dim>> sums_of_joint =
      run.contact->sum_over_block(block);
    double total = 0.;
    for (const JointSums<dim> &joint : sums_of_joint)
      total += joint.normal;
    std::string names;
    for (unsigned int j = 0; j < sums_of_joint.size(); ++j)
      if (sums_of_joint[j].normal > 0.01 * total &&
          sums_of_joint[j].n_sliding + sums_of_joint[j].n_sticking > 0)
        names += (names.empty() ? "" : " and ") +
                 (j < scene.joints.size() ? scene.joints[j]->name
                                          : std::string("another face"));
    if (names.empty())
      return "falling";
    return (rotates ? "rotating on " : "sliding on ") + names;
  }



  template <int dim>
  Tensor<1, dim>
  StrengthReductionSearch<dim>::weight_of(const unsigned int block) const
  {
    Tensor<1, dim> acceleration;
    if (!scene.initial_state.gravity.empty())
      acceleration = Expression<dim>(scene.initial_state.gravity,
                                     dim,
                                     "Initial state/Gravity")
                       .vector(blocks.blocks[block].centroid, run.step.time);
    for (unsigned int d = 0; d < scene.safety.seismic_coefficient.size(); ++d)
      acceleration[d] += 9.81 * scene.safety.seismic_coefficient[d];
    return blocks.blocks[block].mass * acceleration;
  }



  template <int dim>
  std::vector<BlockFace<dim>>
  StrengthReductionSearch<dim>::list_faces(const unsigned int block) const
  {
    // one face per joint and side
    std::map<std::pair<unsigned int, bool>, BlockFace<dim>> faces;
    const Mesh<dim> &mesh = split.mesh;
    for (const JointFace &face : split.interface.joint_faces)
      {
        const bool is_plus = split.block_of_cell[face.plus_cell] == block;
        if ((split.block_of_cell[face.minus_cell] == block) == is_plus)
          continue;
        if (run.conditions.is_dug(face.minus_cell) ||
            run.conditions.is_dug(face.plus_cell))
          continue;
        const Joint<dim> &joint = *scene.joints[face.joint];
        BlockFace<dim> &entry   = faces[{face.joint, is_plus}];
        const double area =
          mesh.face_area_vector(face.minus_cell, face.minus_face).norm();
        entry.inward = (is_plus ? 1. : -1.) * joint.normal();
        entry.area += area;
        entry.tangent_friction =
          std::tan(joint.friction_angle * dealii::numbers::PI / 180.);
        entry.cohesion = joint.cohesion;
        entry.name     = joint.name;
        if (!joint.water_pressure.empty())
          entry.water_force +=
            area *
            Expression<dim>(joint.water_pressure,
                            1,
                            "Joints/" + joint.name + "/Water pressure")
              .value(mesh.face_center(face.minus_cell, face.minus_face), 0., 0);
      }
    std::vector<BlockFace<dim>> list;
    for (const auto &[key, face] : faces)
      list.push_back(face);
    return list;
  }



  template <int dim>
  void
  StrengthReductionSearch<dim>::add_cheap_answers(const unsigned int block,
                                                  SafetyFactor &result)
  {
    const std::vector<BlockFace<dim>> faces = list_faces(block);
    const LimitEquilibrium<dim> limit =
      solve_limit_equilibrium<dim>(faces, weight_of(block));
    result.limit_mode   = limit.describe(faces);
    result.limit_factor = limit.factor;

    // shear strength over shear force on the faces that it slides on
    const auto sums = run.contact->sum_over_block(block);
    double strength = 0.;
    Vector<dim> shear{};
    for (unsigned int i = 0; i < faces.size(); ++i)
      {
        if (!limit.faces.empty() &&
            std::find(limit.faces.begin(), limit.faces.end(), i) ==
              limit.faces.end())
          continue;
        for (unsigned int j = 0; j < scene.joints.size(); ++j)
          if (scene.joints[j]->name == faces[i].name)
            {
              double normal = 0.;
              for (unsigned int d = 0; d < dim; ++d)
                normal += sums[j].force[d] * faces[i].inward[d];
              for (unsigned int d = 0; d < dim; ++d)
                shear[d] += sums[j].force[d] - normal * faces[i].inward[d];
              strength += faces[i].cohesion * faces[i].area +
                          faces[i].tangent_friction * normal;
            }
      }
    const double force  = norm<dim>(shear);
    result.stress_ratio = force > 0. && strength > 0. ? strength / force : 0.;
  }

  template class StrengthReductionSearch<2>;
  template class StrengthReductionSearch<3>;
} // namespace Keyblock
