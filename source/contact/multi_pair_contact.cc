// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/contact/damping.h>
#include <keyblock/contact/multi_pair_contact.h>
#include <keyblock/law/friction.h>

#include <algorithm>

namespace Keyblock
{
  template <int dim>
  MultiPairContact<dim>::MultiPairContact(const PairTopology<dim> &topology,
                                          const ContactStrength<dim> &strength,
                                          const CellArrays<dim> &cells,
                                          SurfaceNodes<dim> &nodes,
                                          PointSolver<dim> &solver,
                                          JointSprings<dim> &springs,
                                          Fields<dim> &fields,
                                          ContactMemory<dim> &memory)
    : topology(topology)
    , interface(topology.interface)
    , surface(topology.surface)
    , scene(topology.scene)
    , strength(strength)
    , nodes(nodes)
    , solver(solver)
    , springs(springs)
    , fields(fields)
    , memory(memory)
    , tractions(topology, cells, pairs)
  {
    for (unsigned int g = 0; g < interface.n_groups(); ++g)
      if (!topology.is_single(g, nodes.projection))
        {
          groups.emplace_back();
          groups.back().group     = g;
          const auto [begin, end] = topology.pairs_of_group(g);
          for (unsigned int p = begin; p < end; ++p)
            pairs.push_back(p);
        }
    list_nodes();
    activate_nodes();
    set_up();
  }



  template <int dim>
  void
  MultiPairContact<dim>::set_up()
  {
    for (Group &group : groups)
      group.set_up(topology, nodes, memory.state);
    tractions.set_up();
  }


  template <int dim>
  void
  MultiPairContact<dim>::list_nodes()
  {
    for (Group &group : groups)
      {
        group.surface_nodes.clear();
        for (unsigned int i = interface.group_begin[group.group];
             i < interface.group_begin[group.group + 1];
             ++i)
          {
            const unsigned int node =
              surface.node_of_vertex[interface.group_vertices[i]];
            if (!memory.is_removed_block[surface.block_of_node[node]])
              group.surface_nodes.push_back(node);
          }
      }
  }



  template <int dim>
  void
  MultiPairContact<dim>::activate_nodes()
  {
    std::vector<bool> is_active = memory.is_surface_contact_node;
    for (const Group &group : groups)
      for (const unsigned int node : group.surface_nodes)
        if (nodes.local_node[node] != none)
          is_active[node] = true;
    nodes.activate(is_active);
  }



  template <int dim>
  void
  MultiPairContact<dim>::list_surface_contact_groups()
  {
    memory.surface_contact_groups.clear();
    for (unsigned int i = 0; i < groups.size(); ++i)
      if (memory.is_surface_contact_group[groups[i].group])
        memory.surface_contact_groups.push_back(i);
  }



  template <int dim>
  void
  MultiPairContact<dim>::solve(const ContactStep &step)
  {
    for (Group &group : groups)
      if (!memory.is_surface_contact_group[group.group] &&
          !group.surface_nodes.empty() &&
          nodes.local_node[group.surface_nodes[0]] != none)
        solve_group(group, step);
  }



  template <int dim>
  std::vector<unsigned int>
  MultiPairContact<dim>::solve_untouched(const std::vector<bool> &is_touched,
                                         const ContactStep &step)
  {
    std::vector<unsigned int> touched;
    for (const unsigned int i : memory.surface_contact_groups)
      if (std::none_of(groups[i].surface_nodes.begin(),
                       groups[i].surface_nodes.end(),
                       [&](const unsigned int node) {
                         return is_touched[node];
                       }))
        solve_group(groups[i], step);
      else
        {
          const auto [begin, end] = topology.pairs_of_group(groups[i].group);
          for (unsigned int p = begin; p < end; ++p)
            if (!memory.state[p].is_converted && !memory.state[p].is_removed)
              touched.push_back(p);
        }
    return touched;
  }


  template <int dim>
  ContactPoint<dim>
  MultiPairContact<dim>::as_point(const unsigned int pair,
                                  const double kick) const
  {
    const Pair<dim> &p = interface.pairs[pair];
    ContactPoint<dim> point;
    point.n_nodes   = 2;
    point.node[0]   = surface.node_of_vertex[p.plus];
    point.node[1]   = surface.node_of_vertex[p.minus];
    point.weight[0] = 1.;
    point.weight[1] = -1.;
    point.normal    = memory.normal[pair];
    for (int d = 0; d < dim; ++d)
      point.gap +=
        point.normal[d] * (nodes.displacement[dim * point.node[0] + d] -
                           nodes.displacement[dim * point.node[1] + d]);
    point.gap -= memory.dilation_of(pair);
    point.is_intact = memory.state[pair].is_intact;
    point.strength  = strength.of_pair(pair, point.is_intact, kick);
    point.status    = memory.state[pair].status;
    if (memory.last_kick > 0.)
      point.impulse = add<dim>(Vector<dim>{},
                               kick / memory.last_kick,
                               memory.state[pair].impulse);
    if (memory.state[pair].status == ContactStatus::sticking &&
        !scene.contact.is_published_variant())
      point.gap = 0.;
    if (springs.are_any())
      springs.put_into_pair(pair,
                            nodes.inverse_mass[point.node[0]] +
                              nodes.inverse_mass[point.node[1]],
                            nodes.projection[point.node[0]] != nullptr ||
                              nodes.projection[point.node[1]] != nullptr,
                            point);
    return point;
  }



  template <int dim>
  bool
  MultiPairContact<dim>::books(const unsigned int group,
                               const ContactStep &step) const
  {
    return step.keeps_ledger && (memory.is_surface_contact_group[group]
                                   ? topology.numbering.communicator.is_root()
                                   : topology.is_primary(group));
  }



  template <int dim>
  bool
  MultiPairContact<dim>::may_be_cluster(const Group &group) const
  {
    if (group.is_oblique || !group.is_connected ||
        scene.contact.is_published_variant())
      return false;
    const auto [begin, end] = topology.pairs_of_group(group.group);
    for (unsigned int p = begin; p < end; ++p)
      if (!memory.state[p].is_removed &&
          (memory.state[p].status != ContactStatus::sticking ||
           memory.state[p].is_converted || springs.is_elastic(p)))
        return false;
    return true;
  }



  template <int dim>
  bool
  MultiPairContact<dim>::bears(const Group &group,
                               const ContactStep &step) const
  {
    const auto [begin, end] = topology.pairs_of_group(group.group);
    for (unsigned int p = begin; p < end; ++p)
      if (!memory.state[p].is_removed &&
          violation<dim>(
            memory.state[p].impulse,
            memory.normal[p],
            strength.of_pair(p, memory.state[p].is_intact, step.kick)) > 0.)
        return false;
    return true;
  }



  template <int dim>
  void
  MultiPairContact<dim>::move_together(const Group &group,
                                       const bool is_damped,
                                       const ContactStep &step,
                                       Vector<dim> common)
  {
    if (step.local_damping > 0. && is_damped &&
        fields.is_in_cluster[nodes.local_node[group.surface_nodes[0]]])
      {
        Vector<dim> old;
        for (int d = 0; d < dim; ++d)
          old[d] = nodes.old_velocity[dim * group.surface_nodes[0] + d];
        const Vector<dim> change =
          damp_cluster<dim>(common, old, step.local_damping);
        common = add<dim>(common, 1., change);
        for (const unsigned int node : group.surface_nodes)
          if (nodes.local_node[node] != none)
            for (int d = 0; d < dim; ++d)
              fields.local_damping[dim * nodes.local_node[node] + d] =
                change[d] / nodes.inverse_mass[node];
      }
    for (const unsigned int node : group.surface_nodes)
      {
        for (int d = 0; d < dim; ++d)
          nodes.velocity[dim * node + d] = common[d];
        if (nodes.local_node[node] != none)
          fields.is_in_cluster[nodes.local_node[node]] = is_damped;
      }
  }



  template <int dim>
  bool
  MultiPairContact<dim>::try_cluster(Group &group, const ContactStep &step)
  {
    if (!may_be_cluster(group))
      return false;
    const unsigned int g    = group.group;
    const auto [begin, end] = topology.pairs_of_group(g);
    Vector<dim> common;
    const bool is_free = group.find_common_velocity(nodes, common);
    std::vector<double> needed(dim * group.surface_nodes.size(), 0.);
    for (unsigned int i = 0; i < group.surface_nodes.size(); ++i)
      for (int d = 0; d < dim; ++d)
        if (group.is_free(i, d))
          needed[dim * i + d] =
            (common[d] - nodes.velocity[dim * group.surface_nodes[i] + d]) /
            nodes.inverse_mass[group.surface_nodes[i]];
    for (unsigned int p = begin; p < end; ++p)
      if (!memory.state[p].is_removed)
        memory.state[p].impulse =
          add<dim>(Vector<dim>{}, step.kick, tractions.of_pair(p));
    group.recover_impulses(topology, needed.data(), memory.state);
    if (!bears(group, step))
      return false;
    for (unsigned int p = begin; p < end && springs.are_any(); ++p)
      springs.take_up_rigid(p, memory.state[p].impulse);
    // nodes in surface contacts are damped with all others, before contact, and
    // so is a cluster that was none in the step before
    move_together(group,
                  is_free && !memory.is_surface_contact_group[g],
                  step,
                  common);
    if (books(g, step))
      for (unsigned int p = begin; p < end; ++p)
        {
          if (memory.state[p].is_removed)
            continue;
          const ContactPoint<dim> point = as_point(p, step.kick);
          const Vector<dim> old =
            relative_velocity<dim>(point, nodes.old_velocity.data());
          if (norm<dim>(old) == 0.)
            continue;
          ContactPoint<dim> held = point;
          held.impulse           = memory.state[p].impulse;
          solver.book(held, nodes.old_velocity.data(), nodes.velocity.data());
        }
    return true;
  }



  template <int dim>
  void
  MultiPairContact<dim>::iterate(Group &group, const ContactStep &step)
  {
    const unsigned int g    = group.group;
    const auto [begin, end] = topology.pairs_of_group(g);
    std::vector<ContactPoint<dim>> points;
    std::vector<PointStrength> broken;
    std::vector<unsigned int> members;
    for (unsigned int p = begin; p < end; ++p)
      {
        double w = 0.;
        for (const unsigned int v :
             {interface.pairs[p].minus, interface.pairs[p].plus})
          w += nodes.inverse_mass[surface.node_of_vertex[v]];
        if (memory.state[p].is_removed || memory.state[p].is_converted ||
            (w == 0. && !springs.is_elastic(p)))
          continue;
        points.push_back(as_point(p, step.kick));
        if (memory.state[p].status == ContactStatus::sticking)
          points.back().impulse = memory.state[p].impulse;
        broken.push_back(strength.of_pair(p, false, step.kick));
        members.push_back(p);
      }
    for (const unsigned int node : group.surface_nodes)
      if (nodes.local_node[node] != none)
        fields.is_in_cluster[nodes.local_node[node]] = false;
    solver.solve(points, broken, nodes.view, step.step, !strength.is_tied);
    const bool is_booked = books(g, step);
    for (unsigned int i = 0; i < points.size(); ++i)
      {
        memory.state[members[i]].impulse   = points[i].impulse;
        memory.state[members[i]].status    = points[i].status;
        memory.state[members[i]].is_intact = points[i].is_intact;
        springs.take_up_pair(members[i],
                             points[i],
                             relative_velocity<dim>(points[i],
                                                    nodes.velocity.data()));
        if (is_booked)
          solver.book(points[i],
                      nodes.old_velocity.data(),
                      nodes.velocity.data());
      }
  }



  template <int dim>
  void
  MultiPairContact<dim>::solve_group(Group &group, const ContactStep &step)
  {
    if (!try_cluster(group, step))
      iterate(group, step);
    const auto [begin, end] = topology.pairs_of_group(group.group);
    for (unsigned int p = begin; p < end; ++p)
      if (!memory.state[p].is_converted && !memory.state[p].is_removed)
        for (int d = 0; d < dim; ++d)
          {
            const auto plus  = surface.node_of_vertex[interface.pairs[p].plus];
            const auto minus = surface.node_of_vertex[interface.pairs[p].minus];
            nodes.impulse[dim * plus + d] += memory.state[p].impulse[d];
            nodes.impulse[dim * minus + d] -= memory.state[p].impulse[d];
          }
  }

  template class MultiPairContact<2>;
  template class MultiPairContact<3>;
} // namespace Keyblock
