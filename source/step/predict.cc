// SPDX-License-Identifier: LGPL-2.1-or-later
// The passes over the nodes between the cells' forces and contact.
#include <keyblock/base/simd.h>
#include <keyblock/contact/damping.h>
#include <keyblock/step/predict.h>

#include <type_traits>

namespace Keyblock
{
  namespace
  {
    /** Value number @p value of an array of one entry per node, as if it had
     * one per component. */
    template <int dim, typename Number>
    KEYBLOCK_ALWAYS_INLINE Number
    load_per_node(const double *from, const int value)
    {
      if constexpr (n_lanes<Number> == 1)
        return from[value / dim];
      else
        return Number{from[2 * value / dim], from[(2 * value + 1) / dim]};
    }

    /** Change of velocity by local damping (contact/damping.h), lane by lane.
     */
    template <typename Number>
    KEYBLOCK_ALWAYS_INLINE Number
    damp(const Number velocity, const Number total, const double alpha)
    {
      if constexpr (n_lanes<Number> == 1)
        return local_damping_change(velocity, total, alpha);
      else
        return Number{local_damping_change(velocity[0], total[0], alpha),
                      local_damping_change(velocity[1], total[1], alpha)};
    }

    /** Velocities of one node, or two, before the kick, and what changes them
     * [m/s]. */
    template <int dim, typename Number>
    struct Kicked
    {
      Number old[dim], change[dim];
      Number damping[dim]; ///< part of the change: local damping
    };

    /** Twice the work per unit of kick, of each component: kept apart, so that
     * sums do not wait for each other. */
    template <int dim, typename Number>
    struct ComponentWork
    {
      Number external[dim]{}, viscous[dim]{}, momentum[dim]{}, local[dim]{};
    };

    /** What acts on nodes besides cells and loads. */
    template <bool viscous, bool local, bool drag>
    struct Damping
    {
      static constexpr bool has_viscous = viscous, has_local = local,
                            has_drag = drag;
    };

    /** Kick the node @p first, or two nodes from there on. */
    template <int dim, typename Damping, typename Number>
    KEYBLOCK_ALWAYS_INLINE Kicked<dim, Number>
    kick_nodes(const Stage &stage,
               const double kick,
               const double alpha,
               const std::size_t first,
               const Fields<dim> &fields)
    {
      const double contact_share = stage.damps_contact_force ? 1. : 0.;
      const auto component       = [first](const std::vector<double> &field,
                                     const int value) {
        return load<Number>(field.data() + dim * first +
                            n_lanes<Number> * value);
      };
      Kicked<dim, Number> result;
      for (int k = 0; k < dim; ++k)
        {
          const Number factor =
            kick *
            load_per_node<dim, Number>(fields.inverse_mass.data() + first, k);
          const Number velocity = component(fields.velocity, k);
          Number force =
            component(fields.load, k) - component(fields.internal_force, k);
          if (Damping::has_drag)
            force -= stage.mass_damping *
                     load_per_node<dim, Number>(fields.mass.data() + first, k) *
                     velocity;
          if (Damping::has_viscous)
            force -= component(fields.damping_force, k);
          result.old[k]    = velocity;
          result.change[k] = factor * force;
          if (Damping::has_local)
            {
              force += contact_share * component(fields.contact_force, k);
              result.damping[k] = damp<Number>(velocity, factor * force, alpha);
              result.change[k] += result.damping[k];
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
      for (std::size_t node = run.begin; node < run.end; ++node)
        {
          // the contact step damps clusters itself
          const double alpha =
            stage.damps_contact_force && fields.is_in_cluster[node]
              ? 0.
              : stage.local_damping;
          const auto kicked =
            kick_nodes<dim, Damping, double>(stage, kick, alpha, node, fields);
          for (int d = 0; d < dim; ++d)
            {
              const std::size_t i    = dim * node + d;
              fields.old_velocity[i] = kicked.old[d];
              fields.velocity[i]     = kicked.old[d] + kicked.change[d];
              if (Damping::has_local)
                fields.local_damping[i] = fields.mass[node] * kicked.damping[d];
            }
        }
    }

    /** Kick and move the node @p first, or two nodes from there on. */
    template <int dim, typename Damping, typename Number>
    KEYBLOCK_ALWAYS_INLINE void
    advance_nodes(const Stage &stage,
                  const NodePass &pass,
                  const std::size_t first,
                  Fields<dim> &fields,
                  ComponentWork<dim, Number> &work)
    {
      const auto kicked = kick_nodes<dim, Damping, Number>(
        stage, pass.kick, stage.local_damping, first, fields);
      for (int k = 0; k < dim; ++k)
        {
          const std::size_t i   = dim * first + n_lanes<Number> * k;
          const Number velocity = kicked.old[k] + kicked.change[k];
          const Number both     = kicked.old[k] + velocity;
          work.external[k] += load<Number>(fields.load.data() + i) * both;
          if (Damping::has_viscous)
            work.viscous[k] +=
              load<Number>(fields.damping_force.data() + i) * both;
          if (Damping::has_local || Damping::has_drag)
            {
              const Number momentum =
                load_per_node<dim, Number>(fields.mass.data() + first, k) *
                both;
              if (Damping::has_local)
                work.local[k] += kicked.damping[k] * momentum;
              if (Damping::has_drag)
                work.momentum[k] += kicked.old[k] * momentum;
            }
          store(velocity, fields.velocity.data() + i);
          double *const displacement = fields.displacement.data() + i;
          store(load<Number>(displacement) + pass.dt * velocity, displacement);
        }
    }

    /** The sum of the lanes of one component's work [J]. */
    template <int dim, typename Number>
    void
    add_work(const ComponentWork<dim, Number> &sum,
             const Stage &stage,
             const double kick,
             NodeWork &work)
    {
      const auto add =
        [](const Number &value, const double factor, double &to) {
          double lanes[n_lanes<Number>];
          store(value, lanes);
          for (const double lane : lanes)
            to += factor * lane;
        };
      for (int k = 0; k < dim; ++k)
        {
          add(sum.external[k], 0.5 * kick, work.external);
          add(sum.viscous[k], 0.5 * kick, work.stiffness_damping);
          add(sum.momentum[k],
              0.5 * kick * stage.mass_damping,
              work.mass_damping);
          add(sum.local[k], -0.5, work.local_damping);
        }
    }

    template <int dim, typename Damping>
    NodeWork
    predict_runs(const Stage &stage, const NodePass &pass, Fields<dim> &fields)
    {
      ComponentWork<dim, Lanes2> pairs;
      ComponentWork<dim, double> single;
      for (const NodeRun &run : pass.runs)
        {
          if (!run.is_inner || !pass.moves_inner)
            {
              predict_run<dim, Damping>(stage, pass.kick, run, fields);
              continue;
            }
          std::size_t node = run.begin;
          for (; node + 2 <= run.end; node += 2)
            advance_nodes<dim, Damping>(stage, pass, node, fields, pairs);
          if (node < run.end)
            advance_nodes<dim, Damping>(stage, pass, node, fields, single);
          if (pass.is_large)
            for (std::size_t i = dim * run.begin; i < dim * run.end; ++i)
              {
                fields.rate[i] = fields.velocity[i];
                fields.position[i] =
                  fields.reference[i] + fields.displacement[i];
              }
        }
      NodeWork work;
      add_work(pairs, stage, pass.kick, work);
      add_work(single, stage, pass.kick, work);
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
    return pass.has_damping ? with_local(std::true_type())
                            : with_local(std::false_type());
  }

  template NodeWork predict(const Stage &, const NodePass &, Fields<2> &);
  template NodeWork predict(const Stage &, const NodePass &, Fields<3> &);
} // namespace Keyblock
