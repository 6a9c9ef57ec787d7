// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/step/energy_ledger.h>

#include <algorithm>
#include <cmath>

namespace Keyblock
{
  double
  Energies::residual() const
  {
    return start + external + supports - kinetic - elastic - friction -
           contact_closure - penetration - dilation - stiffness_damping -
           mass_damping - local_damping - plastic - radiation - joints;
  }



  const std::array<Energies::Term, n_energy_terms> &
  Energies::terms()
  {
    static const std::array<Term, n_energy_terms> list = {
      {{"kinetic", &Energies::kinetic},
       {"elastic", &Energies::elastic},
       {"external", &Energies::external},
       {"supports", &Energies::supports},
       {"friction", &Energies::friction},
       {"contact_closure", &Energies::contact_closure},
       {"penetration", &Energies::penetration},
       {"dilation", &Energies::dilation},
       {"stiffness_damping", &Energies::stiffness_damping},
       {"mass_damping", &Energies::mass_damping},
       {"local_damping", &Energies::local_damping},
       {"plastic", &Energies::plastic},
       {"radiation", &Energies::radiation},
       {"joints", &Energies::joints},
       {"excavated", &Energies::excavated},
       {"start", &Energies::start}}};
    return list;
  }



  std::array<double, n_energy_terms>
  Energies::as_array() const
  {
    std::array<double, n_energy_terms> values;
    for (unsigned int i = 0; i < n_energy_terms; ++i)
      values[i] = this->*terms()[i].value;
    return values;
  }



  Energies
  Energies::from_array(const std::array<double, n_energy_terms> &values)
  {
    Energies e;
    for (unsigned int i = 0; i < n_energy_terms; ++i)
      e.*terms()[i].value = values[i];
    return e;
  }



  double
  Energies::turnover() const
  {
    return std::max({std::abs(external),
                     std::abs(supports),
                     std::abs(start),
                     kinetic,
                     std::abs(friction)});
  }



  namespace
  {
    /** Sum of @p force times the sum of velocities before and after the step,
     * over degrees of freedom. */
    template <int dim>
    double
    work_of(const std::vector<double> &force,
            const Fields<dim> &fields,
            const unsigned int begin,
            const unsigned int end)
    {
      double sum = 0.;
      for (unsigned int i = begin; i < end; ++i)
        sum += force[i] * (fields.old_velocity[i] + fields.velocity[i]);
      return sum;
    }
  } // namespace



  template <int dim>
  EnergyLedger<dim>::EnergyLedger(const Numbering<dim> &numbering,
                                  const Conditions<dim> &conditions,
                                  const CellArrays<dim> &cells,
                                  const Fields<dim> &fields,
                                  const Contact<dim> *contact)
    : numbering(numbering)
    , conditions(conditions)
    , cells(cells)
    , fields(fields)
    , contact(contact)
  {}



  template <int dim>
  void
  EnergyLedger<dim>::begin_stage(LedgerState &state) const
  {
    state.sums = Energies();
    if (contact)
      state.contact_work_at_start = contact->tally.work;
  }



  template <int dim>
  double
  EnergyLedger<dim>::energy_of_cells(const double *positions) const
  {
    return elastic_energy<dim>(cells, positions);
  }



  template <int dim>
  void
  EnergyLedger<dim>::book_work(const NodeRun &run,
                               const LedgerStep &step,
                               LedgerState &state) const
  {
    const double half_kick   = 0.5 * step.kick;
    const unsigned int begin = dim * run.begin, end = dim * run.end;
    state.sums.external +=
      half_kick * work_of<dim>(fields.load, fields, begin, end);
    if (step.has_damping_force)
      state.sums.stiffness_damping +=
        half_kick * work_of<dim>(fields.damping_force, fields, begin, end);
    if (step.stage.local_damping > 0.)
      state.sums.local_damping -=
        0.5 * work_of<dim>(fields.local_damping, fields, begin, end);
    if (step.stage.mass_damping > 0.)
      for (unsigned int i = begin; i < end; ++i)
        state.sums.mass_damping +=
          half_kick * step.stage.mass_damping * fields.mass[i / dim] *
          fields.old_velocity[i] *
          (fields.old_velocity[i] + fields.velocity[i]);
  }



  template <int dim>
  void
  EnergyLedger<dim>::book_supports(const LedgerStep &step,
                                   LedgerState &state) const
  {
    const bool has_viscous = step.has_damping_force;
    const bool is_local    = step.stage.local_damping > 0.;
    // the impulse that a support must have given is what the others left
    // missing; what damps motion does not damp one that is prescribed, although
    // book_work has booked it
    for (const NodeSupport<dim> &support : fields.supports)
      if (support.is_moved() && support.node < numbering.n_owned())
        {
          const unsigned int first = dim * support.node;
          const double mass        = fields.mass[support.node];
          std::array<double, dim> given, local{}, viscous, twice_mean;
          for (unsigned int d = 0; d < dim; ++d)
            {
              const unsigned int i = first + d;
              twice_mean[d] = fields.old_velocity[i] + fields.velocity[i];
              viscous[d]    = -step.kick * step.stage.mass_damping * mass *
                           fields.old_velocity[i];
              if (is_local)
                local[d] = fields.local_damping[i];
              given[d] =
                mass * (fields.velocity[i] - fields.old_velocity[i]) -
                step.kick * (fields.load[i] - fields.internal_force[i] +
                             fields.contact_force[i] -
                             (has_viscous ? fields.damping_force[i] : 0.)) -
                viscous[d] - local[d];
            }
          state.sums.supports += 0.5 * dot<dim>(given, twice_mean);
          for (unsigned int k = 0; k < support.n_directions; ++k)
            {
              const auto &direction     = support.directions[k];
              const double along        = 0.5 * dot<dim>(direction, twice_mean);
              const double lost_local   = along * dot<dim>(direction, local);
              const double lost_by_mass = along * dot<dim>(direction, viscous);
              state.sums.local_damping += lost_local;
              state.sums.mass_damping += lost_by_mass;
              state.sums.supports += lost_local + lost_by_mass;
            }
        }
  }



  template <int dim>
  void
  EnergyLedger<dim>::book_radiation(const LedgerStep &step,
                                    LedgerState &state) const
  {
    const double work = conditions.radiated_work(step.kick);
    state.sums.radiation += work;
    // the damping force of the ledger has it, too
    state.sums.stiffness_damping -= work;
  }



  template <int dim>
  double
  EnergyLedger<dim>::stored_energy(const double *positions) const
  {
    double stored = elastic_energy<dim>(cells, positions);
    for (const auto &element : conditions.elements)
      stored += element->stored_energy(fields.displacement);
    return stored;
  }



  template <int dim>
  double
  EnergyLedger<dim>::plastic_work() const
  {
    double work = cells.plastic_work;
    for (const auto &element : conditions.elements)
      work += element->plastic_work();
    return work;
  }



  template <int dim>
  Energies
  EnergyLedger<dim>::sum_over_ranks(const Energies &mine) const
  {
    std::array<double, n_energy_terms> values = mine.as_array();
    numbering.communicator.sum_lists(values);
    return Energies::from_array(values);
  }



  template <int dim>
  Energies
  EnergyLedger<dim>::sample(const LedgerStep &step, LedgerState &state) const
  {
    double kinetic = 0., kinetic_before = 0., internal = 0., before = 0.;
    for (unsigned int node = 0; node < numbering.n_owned(); ++node)
      for (unsigned int i = dim * node; i < dim * (node + 1); ++i)
        {
          const double v = fields.velocity[i], w = fields.old_velocity[i];
          kinetic += 0.5 * fields.mass[node] * v * v;
          kinetic_before += 0.5 * fields.mass[node] * w * w;
          internal += fields.internal_force[i] * v;
          before += fields.internal_force[i] * (v + w);
        }
    Energies mine = state.sums;
    // discrete energy of the leapfrog between n and n + 1 (theory, eq. 14)
    mine.elastic = stored_energy(step.positions) + 0.5 * step.dt * internal;
    mine.kinetic = kinetic;
    if (step.is_first)
      state.plastic_work_at_start = plastic_work();
    mine.plastic   = plastic_work() - state.plastic_work_at_start;
    mine.excavated = state.excavated_energy;
    if (contact)
      mine.joints = contact->spring_energy();
    if (step.is_first)
      {
        state.sums.start =
          kinetic_before + mine.elastic - 0.5 * step.kick * before;
        if (contact)
          state.sums.start += mine.joints - contact->tally.work.elastic +
                              state.contact_work_at_start.elastic;
      }
    mine.start = state.sums.start;
    if (contact)
      {
        mine.friction =
          contact->tally.work.friction - state.contact_work_at_start.friction;
        mine.contact_closure =
          contact->tally.work.closure - state.contact_work_at_start.closure;
        mine.penetration = contact->tally.work.penetration -
                           state.contact_work_at_start.penetration;
        mine.dilation =
          contact->tally.work.dilation - state.contact_work_at_start.dilation;
      }
    return sum_over_ranks(mine);
  }



  template <int dim>
  Energies
  EnergyLedger<dim>::sample_start(const double *positions) const
  {
    Energies mine;
    for (unsigned int node = 0; node < numbering.n_owned(); ++node)
      for (unsigned int i = dim * node; i < dim * (node + 1); ++i)
        mine.kinetic +=
          0.5 * fields.mass[node] * fields.velocity[i] * fields.velocity[i];
    mine.elastic = stored_energy(positions);
    if (contact)
      mine.joints = contact->spring_energy();
    mine.start = mine.kinetic + mine.elastic + mine.joints;
    return sum_over_ranks(mine);
  }

  template class EnergyLedger<2>;
  template class EnergyLedger<3>;
} // namespace Keyblock
