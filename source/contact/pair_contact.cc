// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/contact/damping.h>
#include <keyblock/contact/pair_contact.h>
#include <keyblock/law/friction.h>

#include <algorithm>

namespace Keyblock
{
  template <int dim>
  PairContact<dim>::PairContact(const PairTopology<dim> &topology,
                                const ContactStrength<dim> &strength,
                                const std::vector<const double *> &projection,
                                PointSolver<dim> &solver,
                                JointSprings<dim> &springs,
                                Fields<dim> &fields,
                                ContactMemory<dim> &memory)
    : topology(topology)
    , interface(topology.interface)
    , scene(topology.scene)
    , strength(strength)
    , solver(solver)
    , springs(springs)
    , fields(fields)
    , memory(memory)
    , point(1)
    , broken(1)
  {
    for (unsigned int g = 0; g < interface.n_groups(); ++g)
      if (topology.is_single(g, projection))
        {
          const unsigned int pair = interface.group_pairs_begin[g];
          const unsigned int minus =
            topology.numbering.local_node(interface.pairs[pair].minus);
          const unsigned int plus =
            topology.numbering.local_node(interface.pairs[pair].plus);
          if (minus != none && plus != none)
            single_pairs.push_back({pair, minus, plus});
        }
  }



  template <int dim>
  bool
  PairContact<dim>::stick(const SinglePair &single,
                          const PointStrength &strength_now,
                          const ContactStep &step)
  {
    PairState<dim> &s     = memory.state[single.pair];
    double *v             = fields.velocity.data();
    const unsigned int pm = dim * single.minus, pp = dim * single.plus;
    const double wm = fields.inverse_mass[single.minus];
    const double wp = fields.inverse_mass[single.plus];
    if (s.status != ContactStatus::sticking ||
        scene.contact.is_published_variant())
      return false;
    Vector<dim> impulse, common;
    // one velocity for both: the sum of momenta over the sum of masses
    for (int d = 0; d < dim; ++d)
      {
        common[d]  = (wp * v[pm + d] + wm * v[pp + d]) / (wm + wp);
        impulse[d] = (v[pm + d] - v[pp + d]) / (wm + wp);
      }
    if (!(violation<dim>(impulse, memory.normal[single.pair], strength_now) <=
          0.))
      return false;
    if (step.local_damping > 0. && wm > 0. && wp > 0. &&
        fields.is_in_cluster[single.plus])
      {
        Vector<dim> old;
        for (int d = 0; d < dim; ++d)
          old[d] = fields.old_velocity[pp + d];
        const Vector<dim> change =
          damp_cluster<dim>(common, old, step.local_damping);
        common = add<dim>(common, 1., change);
        for (int d = 0; d < dim; ++d)
          {
            fields.local_damping[pm + d] = change[d] / wm;
            fields.local_damping[pp + d] = change[d] / wp;
          }
      }
    for (int d = 0; d < dim; ++d)
      v[pm + d] = v[pp + d] = common[d];
    s.impulse = impulse;
    if (springs.are_any())
      springs.take_up_rigid(single.pair, impulse);
    // a gap that closed in the step before still moved in it
    bool moved = false;
    for (int d = 0; d < dim; ++d)
      moved =
        moved || fields.old_velocity[pm + d] != fields.old_velocity[pp + d];
    if (moved && step.keeps_ledger &&
        topology.numbering.is_owned(interface.pairs[single.pair].minus))
      {
        ContactPoint<dim> p;
        p.n_nodes = 2;
        p.node    = {{single.plus, single.minus}};
        p.weight  = {{1., -1.}};
        p.normal  = memory.normal[single.pair];
        p.impulse = impulse;
        solver.book(p, fields.old_velocity.data(), v);
      }
    return true;
  }



  template <int dim>
  void
  PairContact<dim>::solve_alone(const SinglePair &single,
                                const PointStrength &strength_now,
                                const ContactStep &step)
  {
    PairState<dim> &s     = memory.state[single.pair];
    double *v             = fields.velocity.data();
    const unsigned int pm = dim * single.minus, pp = dim * single.plus;
    const ContactNodes<dim> nodes{v, fields.inverse_mass.data(), nullptr};
    ContactPoint<dim> &p = point[0];
    p                    = ContactPoint<dim>();
    p.n_nodes            = 2;
    p.node[0]            = single.plus;
    p.node[1]            = single.minus;
    p.weight[0]          = 1.;
    p.weight[1]          = -1.;
    p.normal             = memory.normal[single.pair];
    if (s.status != ContactStatus::sticking ||
        scene.contact.is_published_variant())
      for (int d = 0; d < dim; ++d)
        p.gap += p.normal[d] *
                 (fields.displacement[pp + d] - fields.displacement[pm + d]);
    if (s.status != ContactStatus::sticking)
      p.gap -= memory.dilation_of(single.pair);
    p.is_intact = s.is_intact;
    p.strength  = strength_now;
    p.impulse =
      add<dim>(Vector<dim>{}, step.kick / memory.last_kick, s.impulse);
    springs.put_into_pair(single.pair,
                          fields.inverse_mass[single.plus] +
                            fields.inverse_mass[single.minus],
                          false,
                          p);
    broken[0] = strength.of_pair(single.pair, false, step.kick);
    solver.solve(point, broken, nodes, step.step, !strength.is_tied);
    s.impulse   = p.impulse;
    s.is_intact = p.is_intact;
    s.status    = p.status;
    springs.take_up_pair(single.pair, p, relative_velocity<dim>(p, v));
    if (step.keeps_ledger &&
        topology.numbering.is_owned(interface.pairs[single.pair].minus))
      solver.book(p, fields.old_velocity.data(), v);
  }



  template <int dim>
  void
  PairContact<dim>::solve(const ContactStep &step)
  {
    // as a function of its own it would be left out: it has no effect
    const auto prefetch = [&](const SinglePair &single)
      __attribute__((always_inline))
    {
      __builtin_prefetch(&memory.state[single.pair]);
      __builtin_prefetch(&interface.pairs[single.pair]);
      for (const unsigned int node : {single.minus, single.plus})
        {
          __builtin_prefetch(&fields.velocity[dim * node]);
          __builtin_prefetch(&fields.old_velocity[dim * node]);
          __builtin_prefetch(&fields.contact_force[dim * node]);
          __builtin_prefetch(&fields.inverse_mass[node]);
          __builtin_prefetch(&fields.is_in_cluster[node]);
        }
    };
    for (unsigned int i = 0; i < single_pairs.size(); ++i)
      {
        // a joint runs across the order of the nodes
        prefetch(
          single_pairs[std::min<std::size_t>(i + 8, single_pairs.size() - 1)]);
        const SinglePair &single = single_pairs[i];
        PairState<dim> &s        = memory.state[single.pair];
        const unsigned int pm = dim * single.minus, pp = dim * single.plus;
        const double wm       = fields.inverse_mass[single.minus];
        const double wp       = fields.inverse_mass[single.plus];
        const bool is_elastic = springs.is_elastic(single.pair);
        if (s.is_removed || (wm + wp == 0. && !is_elastic) ||
            memory
              .is_surface_contact_group[topology.group_of_pair[single.pair]])
          continue;
        const PointStrength strength_now =
          strength.of_pair(single.pair, s.is_intact, step.kick);
        if (is_elastic || !stick(single, strength_now, step))
          solve_alone(single, strength_now, step);
        const bool is_cluster = !is_elastic &&
                                s.status == ContactStatus::sticking &&
                                wm > 0. && wp > 0.;
        fields.is_in_cluster[single.minus] = is_cluster;
        fields.is_in_cluster[single.plus]  = is_cluster;
        for (int d = 0; d < dim; ++d)
          {
            fields.contact_force[pp + d] = s.impulse[d] / step.kick;
            fields.contact_force[pm + d] = -s.impulse[d] / step.kick;
          }
      }
  }

  template class PairContact<2>;
  template class PairContact<3>;
} // namespace Keyblock
