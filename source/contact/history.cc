// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/contact/history.h>
#include <keyblock/contact/node_history.h>
#include <keyblock/law/joint_law.h>

#include <algorithm>

namespace Keyblock
{
  template <int dim>
  ContactHistory<dim>::ContactHistory(const PairTopology<dim> &topology,
                                      const ContactStrength<dim> &strength,
                                      const ContactAreas<dim> &areas,
                                      const SurfaceNodes<dim> &nodes,
                                      const Fields<dim> &fields,
                                      ContactMemory<dim> &memory)
    : topology(topology)
    , interface(topology.interface)
    , surface(topology.surface)
    , strength(strength)
    , areas(areas)
    , nodes(nodes)
    , fields(fields)
    , memory(memory)
  {}


  template <int dim>
  JointHistory
  ContactHistory<dim>::find(const unsigned int node,
                            const unsigned int joint) const
  {
    return find_history(memory.node_histories, node, joint);
  }



  template <int dim>
  JointHistory
  ContactHistory<dim>::of(const SurfaceContact<dim> &contact) const
  {
    const JointHistory own = find(contact.slave, contact.joint);
    JointHistory mean;
    for (int k = 0; k < contact.point.n_nodes; ++k)
      if (contact.point.weight[k] < 0.)
        {
          const JointHistory one = find(contact.point.node[k], contact.joint);
          mean.slip -= contact.point.weight[k] * one.slip;
          mean.dilation -= contact.point.weight[k] * one.dilation;
          mean.damage -= contact.point.weight[k] * one.damage;
        }
    return own.slip < mean.slip ? mean : own;
  }



  template <int dim>
  JointHistory &
  ContactHistory<dim>::at(const unsigned int node, const unsigned int joint)
  {
    const auto place = place_of_history(memory.node_histories, node, joint);
    if (place != memory.node_histories.end() && place->node == node &&
        place->joint == joint)
      return place->history;
    return memory.node_histories.insert(place, {node, joint, {}})->history;
  }



  template <int dim>
  double
  ContactHistory<dim>::largest_dilation() const
  {
    double largest = 0.;
    for (const NodeHistory &entry : memory.node_histories)
      largest = std::max(largest, entry.history.dilation);
    return largest;
  }



  template <int dim>
  double
  ContactHistory<dim>::dilation_of(const unsigned int pair) const
  {
    double dilation = memory.dilation_of(pair);
    if (memory.is_surface_contact_group[topology.group_of_pair[pair]])
      for (const unsigned int vertex :
           {interface.pairs[pair].minus, interface.pairs[pair].plus})
        dilation = std::max(dilation,
                            find(surface.node_of_vertex[vertex],
                                 interface.pairs[pair].joint)
                              .dilation);
    return dilation;
  }



  template <int dim>
  void
  ContactHistory<dim>::pass_on(const unsigned int pair)
  {
    const Pair<dim> &p = interface.pairs[pair];
    for (const unsigned int vertex : {p.minus, p.plus})
      {
        JointHistory &history = at(surface.node_of_vertex[vertex], p.joint);
        if (history.slip < memory.pair_histories[pair].slip)
          history = memory.pair_histories[pair];
      }
  }



  template <int dim>
  bool
  ContactHistory<dim>::find_velocity(const unsigned int pair,
                                     Vector<dim> &velocity) const
  {
    const Pair<dim> &p = interface.pairs[pair];
    const bool is_surface_contact =
      memory.is_surface_contact_group[topology.group_of_pair[pair]];
    const auto index_of = [&](const unsigned int vertex) {
      return is_surface_contact ? surface.node_of_vertex[vertex]
                                : topology.numbering.local_node(vertex);
    };
    const unsigned int plus = index_of(p.plus), minus = index_of(p.minus);
    if (plus == none || minus == none)
      return false;
    const double *v =
      is_surface_contact ? nodes.velocity.data() : fields.velocity.data();
    for (int d = 0; d < dim; ++d)
      velocity[d] = v[dim * plus + d] - v[dim * minus + d];
    return true;
  }



  template <int dim>
  void
  ContactHistory<dim>::advance(const double step)
  {
    const auto slip_of = [&](const Vector<dim> &velocity,
                             const Vector<dim> &n) {
      return step * norm<dim>(add<dim>(velocity, -dot<dim>(velocity, n), n));
    };
    for (unsigned int p = 0; p < memory.state.size(); ++p)
      {
        const PairState<dim> &pair = memory.state[p];
        const JointLaw &law        = *strength.laws[interface.pairs[p].joint];
        Vector<dim> velocity;
        if (law.has_memory() && !pair.is_converted && !pair.is_removed &&
            pair.status == ContactStatus::sliding && find_velocity(p, velocity))
          memory.pair_histories[p] =
            law.advance(memory.pair_histories[p],
                        slip_of(velocity, memory.normal[p]),
                        strength.needs_pressure ? strength.pressure_of_pair(p)
                                                : 0.);
      }
    for (const SurfaceContact<dim> &contact : memory.contacts)
      {
        const ContactPoint<dim> &point = contact.point;
        if (contact.joint == none || contact.is_ridge ||
            !strength.laws[contact.joint]->has_memory() ||
            point.status != ContactStatus::sliding)
          continue;
        at(contact.slave, contact.joint) =
          strength.laws[contact.joint]->advance(
            of(contact),
            slip_of(relative_velocity<dim>(point, nodes.velocity.data()),
                    point.normal),
            areas.pressure_at(contact));
      }
  }

  template class ContactHistory<2>;
  template class ContactHistory<3>;
} // namespace Keyblock
