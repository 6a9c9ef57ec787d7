// SPDX-License-Identifier: LGPL-2.1-or-later
// The numbers of what contact remembers, in the order of checkpoints.
#ifndef keyblock_checkpoint_contact_numbers_h
#define keyblock_checkpoint_contact_numbers_h

#include <keyblock/contact/state.h>

namespace Keyblock
{
  template <typename Action>
  void
  for_each_number(JointHistory &history, const Action &action)
  {
    action(history.slip);
    action(history.dilation);
    action(history.damage);
  }

  template <int dim, typename Action>
  void
  for_each_number(PairState<dim> &pair, const Action &action)
  {
    for (double &component : pair.impulse)
      action(component);
    action(pair.status);
    action(pair.is_intact);
    action(pair.is_converted);
    action(pair.is_welded);
    action(pair.is_removed);
    action(pair.has_opened);
    action(pair.bend_shear);
    action(pair.bend_tension);
    action(pair.weld_shear);
    action(pair.weld_tension);
  }

  template <int dim, typename Action>
  void
  for_each_number(SpringState<dim> &spring, const Action &action)
  {
    for (int d = 0; d < dim; ++d)
      {
        action(spring.force[d]);
        action(spring.stretch[d]);
      }
  }

  template <int dim, typename Action>
  void
  for_each_number(NodeSpring<dim> &entry, const Action &action)
  {
    action(entry.node);
    action(entry.joint);
    for_each_number(entry.state, action);
    for (double &component : entry.normal)
      action(component);
    action(entry.offset);
    action(entry.has_offset);
    action(entry.stored);
    action(entry.last_step);
  }

  template <typename Action>
  void
  for_each_number(NodeHistory &entry, const Action &action)
  {
    action(entry.node);
    action(entry.joint);
    for_each_number(entry.history, action);
  }

  template <int dim, typename Action>
  void
  for_each_number(SurfaceContact<dim> &contact, const Action &action)
  {
    ContactPoint<dim> &point = contact.point;
    action(contact.slave);
    action(contact.face);
    action(contact.joint);
    action(contact.master_block);
    action(contact.is_ridge);
    action(point.n_nodes);
    for (int k = 0; k < point.max_nodes; ++k)
      {
        action(point.node[k]);
        action(point.weight[k]);
      }
    for (int d = 0; d < dim; ++d)
      {
        action(point.normal[d]);
        action(point.impulse[d]);
      }
    action(point.gap);
    action(point.strength.static_friction);
    action(point.strength.kinetic_friction);
    action(point.strength.cohesion);
    action(point.strength.tension);
    action(point.is_intact);
    action(point.status);
  }
} // namespace Keyblock

#endif
