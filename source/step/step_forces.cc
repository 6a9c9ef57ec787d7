// SPDX-License-Identifier: LGPL-2.1-or-later
// The forces of a step: of all cells or those that do not rest, and of force
// elements, and what they leave unbalanced.
#include <keyblock/rock/nodal_force.h>
#include <keyblock/step/step.h>

#include <algorithm>
#include <cmath>

namespace Keyblock
{
  namespace
  {
    /** Loads smaller than this, over the internal forces, do not drive [-]. */
    constexpr double share_that_drives = 1e-12;
  } // namespace



  template <int dim>
  void
  ExplicitStep<dim>::update_internal_force(const bool of_all)
  {
    const bool rests = may_rest();
    if (!rests)
      resting.wake();
    const bool with_resting = of_all || resting.is_due();
    n_skipped += with_resting ? 0. : cells.nodes.size() - resting.n_awake();
    compute_internal_force(with_resting);
    if (rests && resting.is_due())
      look_for_rest();
    resting.advance();
  }



  template <int dim>
  bool
  ExplicitStep<dim>::may_rest() const
  {
    return skips_resting && !conditions.is_load_changing() &&
           (contact == nullptr || contact->tally.n_searches == n_searches_seen);
  }



  template <int dim>
  bool
  ExplicitStep<dim>::has_damping_force() const
  {
    return stage.has_stiffness_damping() || conditions.has_viscous_elements();
  }



  template <int dim>
  void
  ExplicitStep<dim>::look_for_rest()
  {
    conditions.set_load(time);
    double square = 0.;
    for (unsigned int i = 0; i < dim * numbering.n_owned(); i += dim)
      {
        double sum = 0.;
        for (unsigned int d = 0; d < dim; ++d)
          sum += fields.velocity[i + d] * fields.velocity[i + d];
        square = std::max(square, sum);
      }
    const double fastest = std::sqrt(numbering.communicator.max(square));
    const double stopped = resting.check(
      {kick, scene.time_stepping.rest_speed * fastest, has_damping_force()},
      contact ? contact->list_surface_contact_nodes()
              : std::vector<unsigned int>());
    // the energy that a stage starts with is measured after the check
    if (!is_first)
      work.sums.local_damping += stopped;
  }



  template <int dim>
  void
  ExplicitStep<dim>::compute_internal_force(const bool with_resting)
  {
    const double start = MPI_Wtime();
    std::fill(fields.internal_force.begin(), fields.internal_force.end(), 0.);
    ForcePass pass;
    pass.step        = is_stress_current ? 0. : previous_dt;
    pass.is_large    = scene.time_stepping.is_large();
    pass.has_damping = stage.has_stiffness_damping();
    pass.cells       = with_resting ? nullptr : resting.awake_cells();
    if (has_damping_force())
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
    for (const auto &element : conditions.elements)
      element->add_force(fields.displacement, fields.internal_force);
    conditions.trial_pressure.add_force(fields.internal_force);
    if (pass.has_damping)
      {
        numbering.add_hanging_to_masters(fields.damping_force);
        numbering.add_ghosts_to_owners(fields.damping_force);
        if (contact && stage.mass_damping == 0. && stage.local_damping == 0.)
          deformation_damping.add_force(
            *contact,
            stage.damping_ratio,
            conditions.stable_step.mass_damping_left(stage, dt),
            positions());
      }
    if (conditions.has_viscous_elements())
      {
        conditions.set_load(time);
        for (const auto &element : conditions.elements)
          if (element->is_viscous())
            element->add_damping_force({fields,
                                        time,
                                        pass.step,
                                        kick,
                                        stage.mass_damping,
                                        stage.rayleigh_stiffness()},
                                       fields.damping_force);
      }
    is_stress_current = true;
    force_seconds += MPI_Wtime() - start;
  }

  template <int dim>
  void
  ExplicitStep<dim>::sample_unbalanced_force()
  {
    double unbalanced = 0., largest = 0., n_free = 0.;
    double loads = 0., reactions = 0., internal = 0.;
    for (unsigned int node = 0; node < numbering.n_owned(); ++node)
      {
        Vector<dim> force = out_of_balance_force<dim>(fields, node);
        for (unsigned int i = dim * node; i < dim * (node + 1); ++i)
          {
            internal += std::abs(fields.internal_force[i]);
            if (fields.inverse_mass[node] > 0.)
              loads += std::abs(fields.load[i]);
          }
        take_support_reactions<dim>(
          fields, node, force, [&reactions](const double held, const auto &) {
            reactions += std::abs(held);
          });
        if (fields.inverse_mass[node] == 0.)
          continue;
        ++n_free;
        for (unsigned int d = 0; d < dim; ++d)
          {
            unbalanced += std::abs(force[d]);
            largest = std::max(largest, std::abs(force[d]));
          }
      }
    std::array<double, 5> sums = {
      {unbalanced, n_free, loads, reactions, internal}};
    numbering.communicator.sum_lists(sums);
    largest      = numbering.communicator.max(largest);
    double scale = out_of_balance_sum;
    if (scale == 0.)
      {
        // what is left of a wave at its end drives nothing
        const double least = share_that_drives * sums[4];
        scale = sums[2] > least ? sums[2] : sums[3] > least ? sums[3] : sums[4];
      }
    unbalanced_ratio    = scale > 0. ? sums[0] / scale : 0.;
    largest_nodal_ratio = scale > 0. ? largest * sums[1] / scale : 0.;
  }

#define INSTANTIATE(dim)                                                       \
  template void ExplicitStep<dim>::update_internal_force(const bool);          \
  template bool ExplicitStep<dim>::has_damping_force() const;                  \
  template void ExplicitStep<dim>::compute_internal_force(const bool);         \
  template void ExplicitStep<dim>::sample_unbalanced_force();
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock
