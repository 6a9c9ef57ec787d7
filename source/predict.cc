// SPDX-License-Identifier: LGPL-2.1-or-later
// The passes over the nodes between the cells' forces and contact.
#include <keyblock/damping.h>
#include <keyblock/predict.h>

#include <type_traits>

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

    /** Twice the work per unit of kick, of each component: kept apart, so that
     * sums do not wait for each other. */
    template <int dim>
    struct ComponentWork
    {
      double external[dim]{}, viscous[dim]{}, momentum[dim]{}, local[dim]{};
    };

    /** What acts on nodes besides cells and loads. */
    template <bool viscous, bool local, bool drag>
    struct Damping
    {
      static constexpr bool has_viscous = viscous, has_local = local,
                            has_drag = drag;
    };

    template <int dim, typename Damping>
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
      const double contact_share   = stage.damps_contact_force ? 1. : 0.;
      Kicked<dim> result;
      for (int d = 0; d < dim; ++d)
        {
          result.old[d] = velocity[d];
          double force  = load[d] - internal[d];
          if (Damping::has_drag)
            force -= stage.mass_damping * fields.mass[node] * velocity[d];
          if (Damping::has_viscous)
            force -= viscous[d];
          result.change[d] = factor * force;
          if (Damping::has_local)
            {
              force += contact_share * contact[d];
              result.damping[d] =
                local_damping_change(velocity[d], factor * force, alpha);
              result.change[d] += result.damping[d];
            }
        }
      return result;
    }

    template <int dim, typename Damping>
    void
    predict_run(const Stage &stage,
                const double kick,
                const NodeRun &run,
                Fields<dim> &fields)
    {
      for (unsigned int node = run.begin; node < run.end; ++node)
        {
          // the contact step damps clusters itself
          const double alpha =
            stage.damps_contact_force && fields.is_in_cluster[node]
              ? 0.
              : stage.local_damping;
          const auto kicked =
            kick_node<dim, Damping>(stage, kick, alpha, node, fields);
          for (int d = 0; d < dim; ++d)
            {
              const unsigned int i   = dim * node + d;
              fields.old_velocity[i] = kicked.old[d];
              fields.velocity[i]     = kicked.old[d] + kicked.change[d];
              if (Damping::has_local)
                fields.local_damping[i] = fields.mass[node] * kicked.damping[d];
            }
        }
    }

    template <int dim, typename Damping>
    inline void
    advance_node(const Stage &stage,
                 const NodePass &pass,
                 const unsigned int node,
                 Fields<dim> &fields,
                 ComponentWork<dim> &work)
    {
      const auto kicked = kick_node<dim, Damping>(
        stage, pass.kick, stage.local_damping, node, fields);
      for (int d = 0; d < dim; ++d)
        {
          const unsigned int i  = dim * node + d;
          const double velocity = kicked.old[d] + kicked.change[d];
          const double both     = kicked.old[d] + velocity;
          work.external[d] += fields.load[i] * both;
          if (Damping::has_viscous)
            work.viscous[d] += fields.damping_force[i] * both;
          if (Damping::has_local)
            work.local[d] += fields.mass[node] * kicked.damping[d] * both;
          if (Damping::has_drag)
            work.momentum[d] += fields.mass[node] * kicked.old[d] * both;
          fields.velocity[i] = velocity;
          fields.displacement[i] += pass.dt * velocity;
        }
    }

    template <int dim, typename Damping>
    NodeWork
    predict_runs(const Stage &stage, const NodePass &pass, Fields<dim> &fields)
    {
      constexpr unsigned int n_sums = 4;
      ComponentWork<dim> sums[n_sums];
      for (const NodeRun &run : pass.runs)
        {
          if (!run.is_inner || !pass.moves_inner)
            {
              predict_run<dim, Damping>(stage, pass.kick, run, fields);
              continue;
            }
          unsigned int node = run.begin;
          for (; node + n_sums <= run.end; node += n_sums)
            for (unsigned int k = 0; k < n_sums; ++k)
              advance_node<dim, Damping>(
                stage, pass, node + k, fields, sums[k]);
          for (; node < run.end; ++node)
            advance_node<dim, Damping>(stage, pass, node, fields, sums[0]);
          if (pass.is_large)
            for (unsigned int i = dim * run.begin; i < dim * run.end; ++i)
              {
                fields.rate[i] = fields.velocity[i];
                fields.position[i] =
                  fields.reference[i] + fields.displacement[i];
              }
        }
      NodeWork work;
      for (const ComponentWork<dim> &sum : sums)
        for (int d = 0; d < dim; ++d)
          {
            work.external += 0.5 * pass.kick * sum.external[d];
            work.stiffness_damping += 0.5 * pass.kick * sum.viscous[d];
            work.mass_damping +=
              0.5 * pass.kick * stage.mass_damping * sum.momentum[d];
            work.local_damping -= 0.5 * sum.local[d];
          }
      return work;
    }
  } // namespace



  template <int dim>
  NodeWork
  predict(const Stage &stage, const NodePass &pass, Fields<dim> &fields)
  {
    const auto run = [&](const auto viscous,
                         const auto local,
                         const auto drag) {
      return predict_runs<dim, Damping<viscous.value, local.value, drag.value>>(
        stage, pass, fields);
    };
    const auto with_drag = [&](const auto viscous, const auto local) {
      return stage.mass_damping > 0. ? run(viscous, local, std::true_type())
                                     : run(viscous, local, std::false_type());
    };
    const auto with_local = [&](const auto viscous) {
      return stage.local_damping > 0. ? with_drag(viscous, std::true_type())
                                      : with_drag(viscous, std::false_type());
    };
    return stage.damping_ratio > 0. ? with_local(std::true_type())
                                    : with_local(std::false_type());
  }

  template NodeWork predict(const Stage &, const NodePass &, Fields<2> &);
  template NodeWork predict(const Stage &, const NodePass &, Fields<3> &);
} // namespace Keyblock
