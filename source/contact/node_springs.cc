// SPDX-License-Identifier: LGPL-2.1-or-later
// Springs of nodes that have slid: which, and from one face to the next.
#include <keyblock/contact/joint_springs.h>

#include <algorithm>

namespace Keyblock
{
  namespace
  {
    /** Where that of a node on a joint is, or is to be inserted. */
    template <typename Springs>
    auto
    place_of_spring(Springs &springs,
                    const unsigned int node,
                    const unsigned int joint)
    {
      return std::lower_bound(springs.begin(),
                              springs.end(),
                              std::make_pair(node, joint),
                              [](const auto &entry, const auto &key) {
                                return std::make_pair(entry.node, entry.joint) <
                                       key;
                              });
    }
  } // namespace



  template <int dim>
  NodeSpring<dim> *
  JointSprings<dim>::find(const unsigned int node, const unsigned int joint)
  {
    const auto place = place_of_spring(memory.node_springs, node, joint);
    return place != memory.node_springs.end() && place->node == node &&
               place->joint == joint
             ? &*place
             : nullptr;
  }



  template <int dim>
  NodeSpring<dim> &
  JointSprings<dim>::at(const unsigned int node, const unsigned int joint)
  {
    if (NodeSpring<dim> *const spring = find(node, joint))
      return *spring;
    NodeSpring<dim> fresh;
    fresh.node  = node;
    fresh.joint = joint;
    return *memory.node_springs.insert(
      place_of_spring(memory.node_springs, node, joint), fresh);
  }



  template <int dim>
  double
  JointSprings<dim>::area_of(const unsigned int node,
                             const unsigned int joint) const
  {
    const unsigned int g = topology.group_of_node[node];
    if (g == none)
      return 0.;
    const unsigned int v = surface.vertex_of_node[node];
    double sum = 0., largest = 0.;
    const auto [begin, end] = topology.pairs_of_group(g);
    for (unsigned int p = begin; p < end; ++p)
      {
        const Pair<dim> &pair = interface.pairs[p];
        if (pair.minus != v && pair.plus != v)
          continue;
        largest = std::max(largest, pair.area);
        if (pair.joint == joint && memory.state[p].is_converted)
          sum += pair.area;
      }
    return sum > 0. ? sum : largest;
  }



  template <int dim>
  double
  JointSprings<dim>::largest_offset() const
  {
    double largest = 0.;
    for (const NodeSpring<dim> &spring : memory.node_springs)
      largest = std::max({largest,
                          -spring.offset,
                          spring.has_offset
                            ? 0.
                            : -dot<dim>(spring.state.stretch, spring.normal)});
    return largest;
  }



  template <int dim>
  void
  JointSprings<dim>::measure_offsets()
  {
    for (NodeSpring<dim> &spring : memory.node_springs)
      {
        if (spring.has_offset || spring.last_step != memory.n_steps ||
            norm<dim>(spring.normal) == 0.)
          continue;
        const unsigned int v = surface.vertex_of_node[spring.node];
        const auto [begin, end] =
          topology.pairs_of_group(topology.group_of_node[spring.node]);
        for (unsigned int p = begin; p < end; ++p)
          {
            const Pair<dim> &pair = interface.pairs[p];
            if (pair.joint != spring.joint ||
                (pair.minus != v && pair.plus != v))
              continue;
            const unsigned int partner =
              surface.node_of_vertex[pair.minus == v ? pair.plus : pair.minus];
            double gap = 0.;
            for (int d = 0; d < dim; ++d)
              gap += (nodes.position[dim * spring.node + d] -
                      nodes.position[dim * partner + d]) *
                     spring.normal[d];
            spring.offset = dot<dim>(spring.state.stretch, spring.normal) - gap;
            break;
          }
      }
  }



  template <int dim>
  bool
  JointSprings<dim>::has_spring(const SurfaceContact<dim> &contact) const
  {
    return contact.joint != none && !contact.is_ridge &&
           stiffness[contact.joint].is_compliant() &&
           area_of(contact.slave, contact.joint) > 0.;
  }



  template <int dim>
  NodeSpring<dim> *
  JointSprings<dim>::find_partner(const SurfaceContact<dim> &contact)
  {
    const unsigned int v = surface.vertex_of_node[contact.slave];
    const auto [begin, end] =
      topology.pairs_of_group(topology.group_of_node[contact.slave]);
    for (unsigned int p = begin; p < end; ++p)
      {
        const Pair<dim> &pair = interface.pairs[p];
        if (pair.joint == contact.joint && (pair.minus == v || pair.plus == v))
          return find(
            surface.node_of_vertex[pair.minus == v ? pair.plus : pair.minus],
            contact.joint);
      }
    return nullptr;
  }



  template <int dim>
  void
  JointSprings<dim>::replace_partner(const SurfaceContact<dim> &contact,
                                     NodeSpring<dim> &spring)
  {
    const NodeSpring<dim> *const partner = find_partner(contact);
    if (partner == nullptr || partner->last_step != memory.n_steps ||
        std::any_of(memory.contacts.begin(),
                    memory.contacts.end(),
                    [&](const SurfaceContact<dim> &other) {
                      return other.slave == partner->node &&
                             other.joint == partner->joint;
                    }))
      return;
    for (int d = 0; d < dim; ++d)
      {
        spring.state.force[d]   = -partner->state.force[d];
        spring.state.stretch[d] = -partner->state.stretch[d];
        spring.normal[d]        = -partner->normal[d];
      }
    spring.last_step = memory.n_steps;
  }



  template <int dim>
  double
  JointSprings<dim>::first_offset(const NodeSpring<dim> &spring,
                                  const SurfaceContact<dim> &contact)
  {
    if (spring.last_step == memory.n_steps && norm<dim>(spring.normal) > 0.)
      return dot<dim>(spring.state.stretch, spring.normal) - contact.point.gap;
    const NodeSpring<dim> *const partner = find_partner(contact);
    if (partner != nullptr && partner->has_offset)
      return partner->offset;
    return norm<dim>(spring.normal) > 0. ? spring.offset
                                         : std::max(0., -contact.point.gap);
  }



  template <int dim>
  void
  JointSprings<dim>::put_into_contact(SurfaceContact<dim> &contact,
                                      const bool is_booked)
  {
    ContactPoint<dim> &point = contact.point;
    NodeSpring<dim> &spring  = at(contact.slave, contact.joint);
    const Vector<dim> &n     = point.normal;
    if (spring.last_step != memory.n_steps || norm<dim>(spring.normal) == 0.)
      replace_partner(contact, spring);
    const bool bore = spring.last_step == memory.n_steps;
    if (!spring.has_offset)
      {
        spring.offset     = first_offset(spring, contact);
        spring.has_offset = true;
      }
    SpringState<dim> before;
    if (bore && norm<dim>(spring.normal) > 0.)
      {
        before.force   = turn<dim>(spring.state.force, spring.normal, n);
        before.stretch = turn<dim>(spring.state.stretch, spring.normal, n);
      }
    // along the normal the geometry says how far it is pressed
    before.stretch = add<dim>(scale_parts<dim>(before.stretch, n, 0., 1.),
                              point.gap + spring.offset,
                              n);
    const auto &projection = nodes.projection;
    const bool is_partly_held =
      std::any_of(point.node.begin(),
                  point.node.begin() + point.n_nodes,
                  [&](const unsigned int node) {
                    return projection[node] != nullptr;
                  });
    point.spring        = make_spring(contact.joint,
                               area_of(contact.slave, contact.joint),
                               point_inverse_mass<dim>(point, nodes.view),
                               is_partly_held,
                               before);
    const double energy = point.spring.energy(before.force, n);
    if (is_booked)
      solver.book_spring_energy(energy - spring.stored);
    spring.stored = energy;
  }



  template <int dim>
  void
  JointSprings<dim>::put_into_contacts(const bool is_booked)
  {
    if (!is_any || present.is_settling)
      return;
    for (SurfaceContact<dim> &contact : memory.contacts)
      if (has_spring(contact))
        put_into_contact(contact, is_booked);
  }



  template <int dim>
  void
  JointSprings<dim>::be_born(const SurfaceContact<dim> &contact,
                             NodeSpring<dim> &spring) const
  {
    const Vector<dim> &n         = contact.point.normal;
    const PointSpring<dim> stiff = make_spring(
      contact.joint, area_of(contact.slave, contact.joint), 0., false, {});
    spring.state.force =
      add<dim>(Vector<dim>{}, 1. / present.kick, contact.point.impulse);
    spring.state.stretch = scale_parts<dim>(spring.state.force,
                                            n,
                                            -1. / stiff.normal,
                                            -1. / stiff.shear);
    spring.offset     = dot<dim>(spring.state.stretch, n) - contact.point.gap;
    spring.has_offset = true;
    spring.stored     = stiff.energy(spring.state.force, n);
  }



  template <int dim>
  void
  JointSprings<dim>::take_up_contacts(const bool is_booked)
  {
    if (!is_any)
      return;
    for (const SurfaceContact<dim> &contact : memory.contacts)
      {
        const ContactPoint<dim> &point = contact.point;
        if (!has_spring(contact))
          continue;
        NodeSpring<dim> &spring = at(contact.slave, contact.joint);
        spring.last_step        = memory.n_steps + 1;
        spring.normal           = point.normal;
        if (!point.spring.is_elastic)
          {
            be_born(contact, spring);
            continue;
          }
        const SpringChange<dim> change =
          advance_spring<dim>(point.spring,
                              point.impulse,
                              point.normal,
                              relative_velocity<dim>(point,
                                                     nodes.velocity.data()),
                              point.status,
                              point.strength);
        if (point.status == ContactStatus::sliding)
          spring.offset -= point.strength.dilation * norm<dim>(change.slip);
        spring.state  = change.after;
        spring.stored = point.spring.energy(change.after.force, point.normal);
      }
    // those that have lost touch bear nothing any more
    for (NodeSpring<dim> &spring : memory.node_springs)
      if (spring.last_step != memory.n_steps + 1 && spring.stored > 0.)
        {
          if (is_booked)
            solver.book_spring_energy(-spring.stored);
          spring.stored = 0.;
        }
  }

  template class JointSprings<2>;
  template class JointSprings<3>;
} // namespace Keyblock
