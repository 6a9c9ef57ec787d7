// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_rock_nodal_force_h
#define keyblock_rock_nodal_force_h

#include <keyblock/base/vector.h>
#include <keyblock/rock/fields.h>

namespace Keyblock
{
  /** What is out of balance at a node but for its supports: load, stresses and
   * contact, without damping [N]. */
  template <int dim>
  inline Vector<dim>
  out_of_balance_force(const Fields<dim> &fields, const unsigned int node)
  {
    Vector<dim> force;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const unsigned int i = dim * node + d;
        force[d] =
          fields.load[i] - fields.internal_force[i] + fields.contact_force[i];
      }
    return force;
  }

  /** Take from @p force [N] what the supports of a node bear.
   * @param action called for each direction that is held with the force borne
   *        along it [N] and the direction */
  template <int dim, typename Action>
  inline void
  take_support_reactions(const Fields<dim> &fields,
                         const unsigned int node,
                         Vector<dim> &force,
                         const Action &action)
  {
    const int s = fields.support_of_node[node];
    if (s < 0)
      return;
    for (unsigned int k = 0; k < fields.supports[s].n_directions; ++k)
      {
        const auto &direction = fields.supports[s].directions[k];
        const double held     = dot<dim>(direction, force);
        action(held, direction);
        for (unsigned int d = 0; d < dim; ++d)
          force[d] -= held * direction[d];
      }
  }
} // namespace Keyblock

#endif
