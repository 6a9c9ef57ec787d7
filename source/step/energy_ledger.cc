// SPDX-License-Identifier: LGPL-2.1-or-later
// What the step measures: every energy, and the unbalanced force.
#include <keyblock/step/step.h>

#include <algorithm>
#include <cmath>

namespace Keyblock
{
  double
  Energies::residual() const
  {
    return start + external + supports - kinetic - elastic - friction -
           contact_closure - penetration - dilation - stiffness_damping -
           mass_damping - local_damping - plastic - radiation;
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
  void
  ExplicitStep<dim>::book_work(const NodeRun &run)
  {
    const double half_kick   = 0.5 * kick;
    const unsigned int begin = dim * run.begin, end = dim * run.end;
    sums.external += half_kick * work_of<dim>(fields.load, fields, begin, end);
    if (has_damping_force())
      sums.stiffness_damping +=
        half_kick * work_of<dim>(fields.damping_force, fields, begin, end);
    if (stage.local_damping > 0.)
      sums.local_damping -=
        0.5 * work_of<dim>(fields.local_damping, fields, begin, end);
    if (stage.mass_damping > 0.)
      for (unsigned int i = begin; i < end; ++i)
        sums.mass_damping += half_kick * stage.mass_damping *
                             fields.mass[i / dim] * fields.old_velocity[i] *
                             (fields.old_velocity[i] + fields.velocity[i]);
  }



  template <int dim>
  void
  ExplicitStep<dim>::book_supports()
  {
    const bool has_viscous = has_damping_force();
    // the force that a support must have given: what the others left missing
    for (const NodeSupport<dim> &support : fields.supports)
      if (support.motion >= 0 && support.node < numbering.n_owned())
        for (unsigned int i = dim * support.node; i < dim * (support.node + 1);
             ++i)
          {
            const double change = fields.mass[support.node] *
                                  (fields.velocity[i] - fields.old_velocity[i]);
            double given = fields.load[i] - fields.internal_force[i] +
                           fields.contact_force[i];
            if (has_viscous)
              given -= fields.damping_force[i];
            sums.supports += 0.5 * (change - kick * given) *
                             (fields.old_velocity[i] + fields.velocity[i]);
          }
  }



  template <int dim>
  void
  ExplicitStep<dim>::book_radiation()
  {
    const double work = conditions.radiated_work(kick);
    sums.radiation += work;
    // the damping force of the ledger has it, too
    sums.stiffness_damping -= work;
  }



  template <int dim>
  double
  ExplicitStep<dim>::stored_energy() const
  {
    double stored = elastic_energy<dim>(cells, positions());
    for (const auto &element : conditions.elements)
      stored += element->stored_energy(fields.displacement);
    return stored;
  }



  template <int dim>
  double
  ExplicitStep<dim>::plastic_work() const
  {
    double work = cells.plastic_work;
    for (const auto &element : conditions.elements)
      work += element->plastic_work();
    return work;
  }



  template <int dim>
  void
  ExplicitStep<dim>::sample_energies()
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
    Energies mine = sums;
    // discrete energy of the leapfrog between n and n + 1 (theory, eq. 14)
    mine.elastic = stored_energy() + 0.5 * dt * internal;
    mine.kinetic = kinetic;
    if (is_first)
      plastic_work_at_start = plastic_work();
    mine.plastic   = plastic_work() - plastic_work_at_start;
    mine.excavated = excavated_energy;
    if (is_first)
      sums.start = kinetic_before + mine.elastic - 0.5 * kick * before;
    mine.start = sums.start;
    if (contact)
      {
        mine.friction =
          contact->tally.work.friction - contact_work_at_start.friction;
        mine.contact_closure =
          contact->tally.work.closure - contact_work_at_start.closure;
        mine.penetration =
          contact->tally.work.penetration - contact_work_at_start.penetration;
        mine.dilation =
          contact->tally.work.dilation - contact_work_at_start.dilation;
      }
    std::array<double, n_energy_terms> values = mine.as_array();
    numbering.communicator.sum_lists(values);
    energies = Energies::from_array(values);
  }



  template <int dim>
  void
  ExplicitStep<dim>::sample_start()
  {
    Energies mine;
    for (unsigned int node = 0; node < numbering.n_owned(); ++node)
      for (unsigned int i = dim * node; i < dim * (node + 1); ++i)
        mine.kinetic +=
          0.5 * fields.mass[node] * fields.velocity[i] * fields.velocity[i];
    mine.elastic                              = stored_energy();
    mine.start                                = mine.kinetic + mine.elastic;
    std::array<double, n_energy_terms> values = mine.as_array();
    numbering.communicator.sum_lists(values);
    energies = Energies::from_array(values);
  }



  template <int dim>
  void
  ExplicitStep<dim>::sample_unbalanced_force()
  {
    double unbalanced = 0., largest = 0., n_free = 0.;
    double loads = 0., reactions = 0., internal = 0.;
    for (unsigned int node = 0; node < numbering.n_owned(); ++node)
      {
        std::array<double, dim> force;
        for (unsigned int d = 0; d < dim; ++d)
          {
            const unsigned int i = dim * node + d;
            force[d]             = fields.load[i] - fields.internal_force[i] +
                       fields.contact_force[i];
            internal += std::abs(fields.internal_force[i]);
            if (fields.inverse_mass[node] > 0.)
              loads += std::abs(fields.load[i]);
          }
        const int s = fields.support_of_node[node];
        if (s >= 0)
          for (unsigned int k = 0; k < fields.supports[s].n_directions; ++k)
            {
              const auto &direction = fields.supports[s].directions[k];
              const double held     = dot<dim>(direction, force);
              reactions += std::abs(held);
              for (unsigned int d = 0; d < dim; ++d)
                force[d] -= held * direction[d];
            }
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
      scale = sums[2] > 0. ? sums[2] : sums[3] > 0. ? sums[3] : sums[4];
    unbalanced_ratio    = scale > 0. ? sums[0] / scale : 0.;
    largest_nodal_ratio = scale > 0. ? largest * sums[1] / scale : 0.;
  }

  template void ExplicitStep<2>::book_work(const NodeRun &);
  template void ExplicitStep<3>::book_work(const NodeRun &);
  template void ExplicitStep<2>::book_supports();
  template void ExplicitStep<3>::book_supports();
  template void ExplicitStep<2>::book_radiation();
  template void ExplicitStep<3>::book_radiation();
  template void ExplicitStep<2>::sample_energies();
  template void ExplicitStep<3>::sample_energies();
  template void ExplicitStep<2>::sample_start();
  template void ExplicitStep<3>::sample_start();
  template void ExplicitStep<2>::sample_unbalanced_force();
  template void ExplicitStep<3>::sample_unbalanced_force();
} // namespace Keyblock
