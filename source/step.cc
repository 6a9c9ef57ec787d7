// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/step.h>

#include <keyblock/damping.h>
#include <keyblock/mpi.h>

#include <algorithm>
#include <cmath>

namespace Keyblock
{
  namespace
  {
    /** Add @p kick / mass times all forces but those of contact to the
     * velocities of the nodes that are free to move. */
    template <int dim, bool has_viscous, bool has_local>
    void
    kick_nodes(const Stage &stage, const double kick, Fields<dim> &fields)
    {
      const double *const load     = fields.load.data();
      const double *const internal = fields.internal_force.data();
      const double *const viscous  = fields.damping_force.data();
      const double *const contact  = fields.contact_force.data();
      double *const velocity       = fields.velocity.data();
      double *const local          = fields.local_damping.data();
      const double contact_share   = stage.damps_contact_force ? 1. : 0.;
      for (const auto &[begin, end] : fields.free_nodes)
        for (unsigned int node = begin; node < end; ++node)
          {
            const unsigned int i = dim * node;
            const double mass    = fields.mass[node];
            const double factor  = kick * fields.inverse_mass[node];
            const double drag    = stage.mass_damping * mass;
            // the contact step damps clusters itself
            const double alpha =
              stage.damps_contact_force && fields.is_in_cluster[node]
                ? 0.
                : stage.local_damping;
            // read everything before anything is written
            double old[dim], force[dim], change[dim], damping[dim];
            for (int d = 0; d < dim; ++d)
              {
                old[d]   = velocity[i + d];
                force[d] = load[i + d] - internal[i + d] - drag * old[d];
                if (has_viscous)
                  force[d] -= viscous[i + d];
                change[d] = factor * force[d];
                if (has_local)
                  {
                    force[d] += contact_share * contact[i + d];
                    damping[d] =
                      local_damping_change(old[d], factor * force[d], alpha);
                    change[d] += damping[d];
                  }
              }
            for (int d = 0; d < dim; ++d)
              {
                velocity[i + d] = old[d] + change[d];
                if (has_local)
                  local[i + d] = mass * damping[d];
              }
          }
    }
  } // namespace



  template <int dim>
  ExplicitStep<dim>::ExplicitStep(const Scene<dim> &scene,
                                  const SplitMesh<dim> &split,
                                  const Numbering<dim> &numbering,
                                  Conditions<dim> &conditions,
                                  CellArrays<dim> &cells,
                                  Fields<dim> &fields,
                                  Contact<dim> *contact)
    : keeps_ledger(scene.time_stepping.ledger)
    , scene(scene)
    , split(split)
    , numbering(numbering)
    , conditions(conditions)
    , cells(cells)
    , fields(fields)
    , contact(contact)
  {}



  template <int dim>
  double
  ExplicitStep<dim>::begin_stage(const Stage &new_stage,
                                 const unsigned int number)
  {
    is_first = true;
    sums     = Energies();
    if (contact)
      contact_work_at_start = contact->work;
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
    conditions.set_damping(stage.damping_ratio);
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
  }



  template <int dim>
  void
  ExplicitStep<dim>::stop_motion()
  {
    if (!is_stress_current)
      compute_internal_force();
    std::fill(fields.velocity.begin(), fields.velocity.end(), 0.);
    std::fill(fields.rate.begin(), fields.rate.end(), 0.);
    starts_at_rest = true;
  }



  template <int dim>
  double
  ExplicitStep<dim>::choose_step(const unsigned int number)
  {
    if (contact)
      contact->begin_stage(number);
    dt = scene.time_stepping.safety * conditions.stable_step.limit(stage);
    if (scene.time_stepping.maximum_step > 0. && !stage.is_quasi_static())
      dt = std::min(dt, scene.time_stepping.maximum_step);
    // a whole number of steps in the stage
    if (stage.duration > 0.)
      dt = stage.duration / std::ceil(stage.duration / dt - 1e-9);
    return dt;
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
    predict();
    contact->solve({kick, dt, 0., scene.time_stepping.is_large(), false, 0.});
    fields.shifts.clear();
    fields.velocity = velocity;
    stage           = kept;
  }



  template <int dim>
  std::vector<double>
  ExplicitStep<dim>::dig(const unsigned int number)
  {
    update_forces();
    const double before = elastic_energy<dim>(cells, positions());
    conditions.dig(number);
    excavated_energy = before - elastic_energy<dim>(cells, positions());
    update_forces();
    std::vector<double> carried(dim * numbering.n_owned(), 0.);
    for (unsigned int node = 0; node < numbering.n_owned(); ++node)
      if (fields.inverse_mass[node] > 0.)
        for (unsigned int i = dim * node; i < dim * (node + 1); ++i)
          carried[i] =
            fields.internal_force[i] - fields.load[i] - fields.contact_force[i];
    conditions.remove_held_components(carried);
    double sum = 0.;
    for (const double force : carried)
      sum += std::abs(force);
    // a block that is taken away later in the stage carries less
    carried_sum =
      std::max(carried_sum, dealii::Utilities::MPI::sum(sum, world()));
    return carried;
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
    compute_internal_force();
    predict();
    resolve_contact();
    if (keeps_ledger)
      book_work();
    if (sample)
      {
        sample_energies();
        sample_unbalanced_force();
      }
    move();
    starts_at_rest    = false;
    is_first          = false;
    is_stress_current = false;
    previous_dt       = dt;
    conditions.advance_ramp(dt);
    time += dt;
    ++n_steps;
    return dt;
  }



  template <int dim>
  void
  ExplicitStep<dim>::compute_internal_force()
  {
    const double start = MPI_Wtime();
    std::fill(fields.internal_force.begin(), fields.internal_force.end(), 0.);
    ForcePass pass;
    pass.step        = is_stress_current ? 0. : previous_dt;
    pass.is_large    = scene.time_stepping.is_large();
    pass.has_damping = stage.damping_ratio > 0.;
    if (pass.has_damping)
      std::fill(fields.damping_force.begin(), fields.damping_force.end(), 0.);
    add_internal_force<dim>(pass,
                            cells,
                            pass.is_large ? fields.position.data()
                                          : fields.reference.data(),
                            pass.is_large ? fields.rate.data()
                                          : fields.velocity.data(),
                            fields.internal_force.data(),
                            fields.damping_force.data());
    numbering.add_hanging_to_masters(fields.internal_force);
    numbering.add_ghosts_to_owners(fields.internal_force);
    fields.far_field.add_force(fields.displacement, fields.internal_force);
    if (pass.has_damping)
      {
        numbering.add_hanging_to_masters(fields.damping_force);
        numbering.add_ghosts_to_owners(fields.damping_force);
      }
    is_stress_current = true;
    force_seconds += MPI_Wtime() - start;
  }



  template <int dim>
  void
  ExplicitStep<dim>::predict()
  {
    conditions.set_load(time);
    fields.old_velocity    = fields.velocity;
    const bool has_viscous = stage.damping_ratio > 0.;
    if (stage.local_damping > 0.)
      has_viscous ? kick_nodes<dim, true, true>(stage, kick, fields)
                  : kick_nodes<dim, false, true>(stage, kick, fields);
    else
      has_viscous ? kick_nodes<dim, true, false>(stage, kick, fields)
                  : kick_nodes<dim, false, false>(stage, kick, fields);
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
                    conditions.ramp_share_left()});
    contact_seconds += MPI_Wtime() - start;
  }



  template <int dim>
  void
  ExplicitStep<dim>::move()
  {
    numbering.interpolate_hanging(fields.velocity);
    const std::size_t n = fields.displacement.size();
    for (std::size_t i = 0; i < n; ++i)
      fields.displacement[i] += dt * fields.velocity[i];
    if (!scene.time_stepping.is_large())
      return;
    fields.rate = fields.velocity;
    for (const auto &[dof, shift] : fields.shifts)
      {
        fields.displacement[dof] += shift;
        fields.rate[dof] += shift / dt;
      }
    fields.shifts.clear();
    numbering.interpolate_hanging(fields.rate);
    numbering.interpolate_hanging(fields.displacement);
    for (std::size_t i = 0; i < n; ++i)
      fields.position[i] = fields.reference[i] + fields.displacement[i];
  }

  template class ExplicitStep<2>;
  template class ExplicitStep<3>;
} // namespace Keyblock
