// SPDX-License-Identifier: LGPL-2.1-or-later
// Contact of two nodes that have not slid, solved on the fields themselves.
#include <keyblock/base/mpi.h>
#include <keyblock/contact/contact.h>
#include <keyblock/contact/damping.h>
#include <keyblock/law/friction.h>

#include <algorithm>
#include <map>

namespace Keyblock
{
  template <int dim>
  void
  Contact<dim>::solve_single_pairs(const ContactStep &step)
  {
    const double scale = step.kick / last_kick;
    double *v          = fields.velocity.data();
    std::vector<ContactPoint<dim>> point(1);
    std::vector<PointStrength> broken(1);
    const ContactNodes<dim> nodes{v, fields.inverse_mass.data(), nullptr};
    // a joint runs across the order of the nodes: what its pairs need comes
    // from anywhere in memory
    const auto prefetch = [&](const SinglePair &single)
      __attribute__((always_inline))
    {
      __builtin_prefetch(&state[single.pair]);
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
        prefetch(
          single_pairs[std::min<std::size_t>(i + 8, single_pairs.size() - 1)]);
        const SinglePair &single = single_pairs[i];
        PairState<dim> &s        = state[single.pair];
        const unsigned int pm = dim * single.minus, pp = dim * single.plus;
        const double wm = fields.inverse_mass[single.minus];
        const double wp = fields.inverse_mass[single.plus];
        if (s.is_removed || wm + wp == 0. ||
            is_mobile_group[group_of_pair[single.pair]])
          continue;
        const PointStrength strength =
          pair_strength(single.pair, s.is_intact, step.kick);
        Vector<dim> impulse, common;
        // one velocity for both: the sum of momenta over the sum of masses
        for (int d = 0; d < dim; ++d)
          {
            common[d]  = (wp * v[pm + d] + wm * v[pp + d]) / (wm + wp);
            impulse[d] = (v[pm + d] - v[pp + d]) / (wm + wp);
          }
        const bool was_sticking = s.status == ContactStatus::sticking;
        if (was_sticking && !is_published_variant() &&
            violation<dim>(impulse, normal[single.pair], strength) <= 0.)
          {
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
            // a gap that closed in the step before still moved in it
            bool moved = false;
            for (int d = 0; d < dim; ++d)
              moved = moved || fields.old_velocity[pm + d] !=
                                 fields.old_velocity[pp + d];
            if (moved && step.keeps_ledger &&
                numbering.is_owned(interface.pairs[single.pair].minus))
              {
                ContactPoint<dim> p;
                p.n_nodes = 2;
                p.node    = {{single.plus, single.minus}};
                p.weight  = {{1., -1.}};
                p.normal  = normal[single.pair];
                p.impulse = impulse;
                book_work(p, fields.old_velocity.data(), v);
              }
          }
        else
          {
            ContactPoint<dim> &p = point[0];
            p                    = ContactPoint<dim>();
            p.n_nodes            = 2;
            p.node[0]            = single.plus;
            p.node[1]            = single.minus;
            p.weight[0]          = 1.;
            p.weight[1]          = -1.;
            p.normal             = normal[single.pair];
            if (!was_sticking || is_published_variant())
              for (int d = 0; d < dim; ++d)
                p.gap += p.normal[d] * (fields.displacement[pp + d] -
                                        fields.displacement[pm + d]);
            p.is_intact = s.is_intact;
            p.strength  = strength;
            p.impulse   = add<dim>(Vector<dim>{}, scale, s.impulse);
            broken[0]   = pair_strength(single.pair, false, step.kick);
            solve_points(point, broken, nodes, step.step);
            s.impulse   = p.impulse;
            s.is_intact = p.is_intact;
            s.status    = p.status;
            if (step.keeps_ledger &&
                numbering.is_owned(interface.pairs[single.pair].minus))
              book_work(p, fields.old_velocity.data(), v);
          }
        const bool is_cluster =
          s.status == ContactStatus::sticking && wm > 0. && wp > 0.;
        fields.is_in_cluster[single.minus] = is_cluster;
        fields.is_in_cluster[single.plus]  = is_cluster;
        for (int d = 0; d < dim; ++d)
          {
            fields.contact_force[pp + d] = s.impulse[d] / step.kick;
            fields.contact_force[pm + d] = -s.impulse[d] / step.kick;
          }
      }
  }



  template void Contact<2>::solve_single_pairs(const ContactStep &);
  template void Contact<3>::solve_single_pairs(const ContactStep &);
} // namespace Keyblock
