// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/step/step.h>

#include <keyblock/scene/step_count.h>
#include <keyblock/step/predict.h>

#include <algorithm>
#include <cmath>

namespace Keyblock
{
  template <int dim>
  ExplicitStep<dim>::ExplicitStep(const Scene<dim> &scene,
                                  const SplitMesh<dim> &split,
                                  const Blocks<dim> &blocks,
                                  const Numbering<dim> &numbering,
                                  Conditions<dim> &conditions,
                                  CellArrays<dim> &cells,
                                  Fields<dim> &fields,
                                  Contact<dim> *contact)
    : keeps_ledger(scene.time_stepping.ledger)
    , skips_resting(scene.time_stepping.skips_resting)
    , scene(scene)
    , split(split)
    , numbering(numbering)
    , conditions(conditions)
    , cells(cells)
    , fields(fields)
    , contact(contact)
    , resting(split, numbering, cells, fields, conditions.elements)
    , deformation_damping(split, blocks, numbering, cells, fields)
    , ledger(numbering, conditions, cells, fields, contact)
  {}



  template <int dim>
  double
  ExplicitStep<dim>::begin_stage(const Stage &new_stage,
                                 const unsigned int number)
  {
    is_first = true;
    conditions.clock.begin(number, time);
    ledger.begin_stage(work);
    apply_settings(new_stage);
    if (stage.reset_motion || stage.is_quasi_static())
      stop_motion();
    conditions.scale_density(stage.is_quasi_static() && stage.scales_density);
    return choose_step(number);
  }



  template <int dim>
  void
  ExplicitStep<dim>::apply_settings(const Stage &new_stage)
  {
    stage = new_stage;
    if (contact)
      contact->override_friction(stage.friction_angle_override);
    conditions.set_damping(stage);
    fields.local_damping.assign(
      stage.local_damping > 0. ? fields.velocity.size() : 0, 0.);
  }



  template <int dim>
  void
  ExplicitStep<dim>::resume(const Stage &stage, const unsigned int number)
  {
    apply_settings(stage);
    conditions.scale_density(stage.is_quasi_static() && stage.scales_density);
    if (contact)
      contact->begin_stage(number);
    resting.forget();
    deformation_damping.begin_stage();
    n_searches_seen = contact ? contact->tally.n_searches : 0;
  }



  template <int dim>
  void
  ExplicitStep<dim>::stop_motion()
  {
    if (!is_stress_current)
      compute_internal_force();
    std::fill(fields.velocity.begin(), fields.velocity.end(), 0.);
    std::fill(fields.rate.begin(), fields.rate.end(), 0.);
    for (const auto &element : conditions.elements)
      element->stop_motion();
    starts_at_rest = true;
  }



  template <int dim>
  double
  ExplicitStep<dim>::choose_step(const unsigned int number)
  {
    if (contact)
      contact->begin_stage(number);
    resting.forget();
    deformation_damping.begin_stage();
    n_searches_seen = none; // contact searches in the first step
    // where nothing moves any more, any step will do
    const double longest = longest_step(stage);
    if (std::isfinite(longest) || dt == 0.)
      dt = longest;
    // a whole number of steps in the stage
    if (stage.duration > 0.)
      dt = stage.duration / count_steps(stage, dt);
    return dt;
  }



  template <int dim>
  double
  ExplicitStep<dim>::longest_step(const Stage &stage) const
  {
    const double stable =
      scene.time_stepping.safety * conditions.stable_step.limit(stage);
    return scene.time_stepping.maximum_step > 0. && !stage.is_quasi_static()
             ? std::min(stable, scene.time_stepping.maximum_step)
             : stable;
  }



  template <int dim>
  void
  ExplicitStep<dim>::update_forces()
  {
    compute_internal_force();
    conditions.set_load(time);
  }



  template <int dim>
  void
  ExplicitStep<dim>::settle_contact()
  {
    if (contact == nullptr)
      return;
    const std::vector<double> velocity = fields.velocity;
    const Stage kept                   = stage;
    stage                              = Stage();
    kick                               = 0.5 * dt;
    compute_internal_force();
    predict_nodes(false);
    contact->solve(
      {kick, dt, 0., scene.time_stepping.is_large(), false, 0., true});
    fields.shifts.clear();
    fields.velocity = velocity;
    stage           = kept;
  }



  template <int dim>
  void
  ExplicitStep<dim>::add_displacement(const std::vector<double> &change)
  {
    std::fill(fields.internal_force.begin(), fields.internal_force.end(), 0.);
    ForcePass pass;
    pass.step = 1.;
    add_internal_force<dim>(pass,
                            cells,
                            fields.reference.data(),
                            change.data(),
                            fields.internal_force.data(),
                            nullptr);
    for (std::size_t i = 0; i < change.size(); ++i)
      fields.displacement[i] += change[i];
    is_stress_current = true;
    update_forces();
  }



  template <int dim>
  void
  ExplicitStep<dim>::zero_displacements()
  {
    if (!is_stress_current)
      compute_internal_force();
    std::fill(fields.displacement.begin(), fields.displacement.end(), 0.);
  }



  template <int dim>
  const double *
  ExplicitStep<dim>::positions() const
  {
    return scene.time_stepping.is_large() ? fields.position.data()
                                          : fields.reference.data();
  }



  template <int dim>
  double
  ExplicitStep<dim>::advance(const bool sample)
  {
    kick = starts_at_rest ? 0.5 * dt : 0.5 * (previous_dt + dt);
    update_internal_force(sample);
    // energies are measured before anything moves
    predict_nodes(!sample);
    resolve_contact();
    numbering.interpolate_hanging(fields.velocity);
    if (keeps_ledger)
      {
        ledger.book_supports(ledger_step(), work);
        ledger.book_radiation(ledger_step(), work);
      }
    if (sample)
      {
        for (const NodeRun &run : resting.moving_nodes())
          if (keeps_ledger)
            ledger.book_work(run, ledger_step(), work);
        energies = ledger.sample(ledger_step(), work);
        sample_unbalanced_force();
      }
    move_nodes(sample);
    n_searches_seen   = contact ? contact->tally.n_searches : 0;
    starts_at_rest    = false;
    is_first          = false;
    is_stress_current = false;
    previous_dt       = dt;
    conditions.loads.advance_ramp(dt);
    if (!conditions.clock.stands())
      time += dt;
    ++n_steps;
    return dt;
  }



  template <int dim>
  LedgerStep
  ExplicitStep<dim>::ledger_step() const
  {
    return {stage, kick, dt, has_damping_force(), is_first, positions()};
  }



  template <int dim>
  void
  ExplicitStep<dim>::sample_start()
  {
    energies = ledger.sample_start(positions());
  }



  template <int dim>
  void
  ExplicitStep<dim>::predict_nodes(const bool moves_inner)
  {
    conditions.set_load(time);
    // those of nodes that move are kept on the way
    std::copy(fields.velocity.begin() +
                (moves_inner ? dim * numbering.n_owned() : 0),
              fields.velocity.end(),
              fields.old_velocity.begin() +
                (moves_inner ? dim * numbering.n_owned() : 0));
    const NodeWork moved = predict(stage,
                                   {kick,
                                    dt,
                                    moves_inner,
                                    scene.time_stepping.is_large(),
                                    has_damping_force(),
                                    resting.moving_nodes()},
                                   fields);
    if (keeps_ledger)
      work.sums.add(moved);
    conditions.apply_supports(time, dt);
    numbering.update_ghosts(fields.velocity);
  }



  template <int dim>
  void
  ExplicitStep<dim>::resolve_contact()
  {
    if (contact == nullptr)
      return;
    const double start = MPI_Wtime();
    contact->solve({kick,
                    dt,
                    stage.damps_contact_force ? stage.local_damping : 0.,
                    scene.time_stepping.is_large(),
                    keeps_ledger,
                    conditions.loads.ramp_share_left(),
                    false,
                    stage.is_quasi_static()});
    contact_seconds += MPI_Wtime() - start;
  }



  template <int dim>
  void
  ExplicitStep<dim>::move_nodes(const bool with_inner)
  {
    const bool is_large = scene.time_stepping.is_large();
    const NodeRun ghosts{numbering.n_owned(), numbering.n_local(), false};
    const auto move = [&](const NodeRun &run) {
      for (unsigned int i = dim * run.begin; i < dim * run.end; ++i)
        fields.displacement[i] += dt * fields.velocity[i];
      if (is_large)
        std::copy(fields.velocity.begin() + dim * run.begin,
                  fields.velocity.begin() + dim * run.end,
                  fields.rate.begin() + dim * run.begin);
    };
    const LedgerStep step            = ledger_step();
    const std::vector<NodeRun> &runs = resting.moving_nodes();
    for (unsigned int r = 0; r < runs.size(); ++r)
      {
        const NodeRun &run = runs[r];
        if (run.is_inner && !with_inner)
          continue;
        // outer nodes lie anywhere: fetch those a few runs on
        const unsigned int next =
          dim * runs[std::min<std::size_t>(r + 8, runs.size() - 1)].begin;
        for (const auto *values : {&fields.load,
                                   &fields.velocity,
                                   &fields.old_velocity,
                                   &fields.displacement})
          __builtin_prefetch(values->data() + next);
        if (keeps_ledger && !with_inner)
          ledger.book_work(run, step, work);
        move(run);
      }
    move(ghosts);
    if (!is_large)
      return;
    for (const auto &[dof, shift] : fields.shifts)
      {
        fields.displacement[dof] += shift;
        fields.rate[dof] += shift / dt;
      }
    fields.shifts.clear();
    numbering.interpolate_hanging(fields.rate);
    numbering.interpolate_hanging(fields.displacement);
    const auto place = [&](const NodeRun &run) {
      for (unsigned int i = dim * run.begin; i < dim * run.end; ++i)
        fields.position[i] = fields.reference[i] + fields.displacement[i];
    };
    for (const NodeRun &run : runs)
      if (with_inner || !run.is_inner)
        place(run);
    place(ghosts);
  }

  template class ExplicitStep<2>;
  template class ExplicitStep<3>;
} // namespace Keyblock
