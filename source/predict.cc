// SPDX-License-Identifier: LGPL-2.1-or-later
// The passes over the nodes between the cells' forces and contact.
#include <keyblock/damping.h>
#include <keyblock/predict.h>

namespace Keyblock
{
  namespace
  {
    /** Velocity of a node before the kick, and what changes it [m/s]. */
    template <int dim>
    struct Kicked
    {
      double old[dim], change[dim];
      double damping[dim]; ///< part of the change: local damping
    };

    template <int dim, bool has_viscous, bool has_local>
    inline Kicked<dim>
    kick_node(const Stage &stage,
              const double kick,
              const double alpha,
              const unsigned int node,
              const Fields<dim> &fields)
    {
      const double *const load     = fields.load.data() + dim * node;
      const double *const internal = fields.internal_force.data() + dim * node;
      const double *const viscous  = fields.damping_force.data() + dim * node;
      const double *const contact  = fields.contact_force.data() + dim * node;
      const double *const velocity = fields.velocity.data() + dim * node;
      const double factor          = kick * fields.inverse_mass[node];
      const double drag            = stage.mass_damping * fields.mass[node];
      const double contact_share   = stage.damps_contact_force ? 1. : 0.;
      Kicked<dim> result;
      for (int d = 0; d < dim; ++d)
        {
          result.old[d] = velocity[d];
          double force  = load[d] - internal[d] - drag * velocity[d];
          if (has_viscous)
            force -= viscous[d];
          result.change[d] = factor * force;
          if (has_local)
            {
              force += contact_share * contact[d];
              result.damping[d] =
                local_damping_change(velocity[d], factor * force, alpha);
              result.change[d] += result.damping[d];
            }
        }
      return result;
    }

    template <int dim, bool has_viscous, bool has_local>
    void
    predict_ranges(const Stage &stage,
                   const double kick,
                   const NodeRanges &ranges,
                   Fields<dim> &fields)
    {
      for (const auto &[begin, end] : ranges)
        for (unsigned int node = begin; node < end; ++node)
          {
            // the contact step damps clusters itself
            const double alpha =
              stage.damps_contact_force && fields.is_in_cluster[node]
                ? 0.
                : stage.local_damping;
            const auto kicked = kick_node<dim, has_viscous, has_local>(
              stage, kick, alpha, node, fields);
            for (int d = 0; d < dim; ++d)
              {
                const unsigned int i = dim * node + d;
                fields.velocity[i]   = kicked.old[d] + kicked.change[d];
                if (has_local)
                  fields.local_damping[i] =
                    fields.mass[node] * kicked.damping[d];
              }
          }
    }

    /** Twice the work per unit of kick, of each component: kept apart, so that
     * sums do not wait for each other. */
    template <int dim>
    struct ComponentWork
    {
      double external[dim]{}, viscous[dim]{}, momentum[dim]{}, local[dim]{};
    };

    template <int dim, bool has_viscous, bool has_local, bool is_large>
    NodeWork
    advance_ranges(const Stage &stage,
                   const double kick,
                   const double dt,
                   Fields<dim> &fields)
    {
      constexpr unsigned int n_sums = 4;
      ComponentWork<dim> sums[n_sums];
      const bool has_drag = stage.mass_damping > 0.;
      const auto advance  = [&](const unsigned int node,
                               ComponentWork<dim> &sum) {
        const auto kicked = kick_node<dim, has_viscous, has_local>(
          stage, kick, stage.local_damping, node, fields);
        for (int d = 0; d < dim; ++d)
          {
            const unsigned int i  = dim * node + d;
            const double velocity = kicked.old[d] + kicked.change[d];
            const double both     = kicked.old[d] + velocity;
            sum.external[d] += fields.load[i] * both;
            if (has_viscous)
              sum.viscous[d] += fields.damping_force[i] * both;
            if (has_local)
              sum.local[d] += fields.mass[node] * kicked.damping[d] * both;
            if (has_drag)
              sum.momentum[d] += fields.mass[node] * kicked.old[d] * both;
            fields.velocity[i] = velocity;
            fields.displacement[i] += dt * velocity;
            if (is_large)
              {
                fields.rate[i] = velocity;
                fields.position[i] =
                  fields.reference[i] + fields.displacement[i];
              }
          }
      };
      for (const auto &[begin, end] : fields.inner_nodes)
        {
          unsigned int node = begin;
          for (; node + n_sums <= end; node += n_sums)
            for (unsigned int k = 0; k < n_sums; ++k)
              advance(node + k, sums[k]);
          for (; node < end; ++node)
            advance(node, sums[0]);
        }
      NodeWork work;
      for (const ComponentWork<dim> &sum : sums)
        for (int d = 0; d < dim; ++d)
          {
            work.external += 0.5 * kick * sum.external[d];
            work.stiffness_damping += 0.5 * kick * sum.viscous[d];
            work.mass_damping +=
              0.5 * kick * stage.mass_damping * sum.momentum[d];
            work.local_damping -= 0.5 * sum.local[d];
          }
      return work;
    }
  } // namespace



  template <int dim>
  void
  predict(const Stage &stage,
          const double kick,
          const NodeRanges &ranges,
          Fields<dim> &fields)
  {
    const bool has_viscous = stage.damping_ratio > 0.;
    if (stage.local_damping > 0.)
      has_viscous
        ? predict_ranges<dim, true, true>(stage, kick, ranges, fields)
        : predict_ranges<dim, false, true>(stage, kick, ranges, fields);
    else
      has_viscous
        ? predict_ranges<dim, true, false>(stage, kick, ranges, fields)
        : predict_ranges<dim, false, false>(stage, kick, ranges, fields);
  }



  template <int dim>
  NodeWork
  advance_inner_nodes(const Stage &stage,
                      const double kick,
                      const double dt,
                      const bool is_large,
                      Fields<dim> &fields)
  {
    const bool has_viscous = stage.damping_ratio > 0.;
    const auto run         = [&](auto viscous, auto local) {
      return is_large ? advance_ranges<dim, viscous.value, local.value, true>(
                          stage, kick, dt, fields)
                              : advance_ranges<dim, viscous.value, local.value, false>(
                          stage, kick, dt, fields);
    };
    if (stage.local_damping > 0.)
      return has_viscous ? run(std::true_type(), std::true_type())
                         : run(std::false_type(), std::true_type());
    return has_viscous ? run(std::true_type(), std::false_type())
                       : run(std::false_type(), std::false_type());
  }

  template void
  predict(const Stage &, const double, const NodeRanges &, Fields<2> &);
  template void
  predict(const Stage &, const double, const NodeRanges &, Fields<3> &);
  template NodeWork advance_inner_nodes(const Stage &,
                                        const double,
                                        const double,
                                        const bool,
                                        Fields<2> &);
  template NodeWork advance_inner_nodes(const Stage &,
                                        const double,
                                        const double,
                                        const bool,
                                        Fields<3> &);
} // namespace Keyblock
