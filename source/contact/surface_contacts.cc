// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/disjoint_sets.h>
#include <keyblock/base/errors.h>
#include <keyblock/contact/surface_contacts.h>

#include <algorithm>
#include <cmath>

namespace Keyblock
{
  namespace
  {
    /** Share of an overlap that a step takes back [-]. */
    constexpr double corrected_share = 0.1;
  } // namespace



  template <int dim>
  SurfaceContacts<dim>::SurfaceContacts(const ContactSearch<dim> &search,
                                        const PairTopology<dim> &topology,
                                        const ContactStrength<dim> &strength,
                                        ContactAreas<dim> &areas,
                                        const ContactHistory<dim> &history,
                                        MultiPairContact<dim> &pairs_on_nodes,
                                        SurfaceNodes<dim> &nodes,
                                        PointSolver<dim> &solver,
                                        JointSprings<dim> &springs,
                                        ContactMemory<dim> &memory)
    : search(search)
    , topology(topology)
    , split(topology.split)
    , interface(topology.interface)
    , surface(topology.surface)
    , strength(strength)
    , areas(areas)
    , history(history)
    , pairs_on_nodes(pairs_on_nodes)
    , nodes(nodes)
    , solver(solver)
    , springs(springs)
    , memory(memory)
  {}


  template <int dim>
  bool
  SurfaceContacts<dim>::can_move(const ContactPoint<dim> &point,
                                 const int k) const
  {
    return point.weight[k] != 0. && nodes.inverse_mass[point.node[k]] > 0.;
  }



  template <int dim>
  std::vector<unsigned int>
  SurfaceContacts<dim>::list_pairs(const ContactStep &step)
  {
    std::vector<bool> is_touched(surface.n_nodes(), false);
    for (const SurfaceContact<dim> &contact : memory.contacts)
      for (int k = 0; k < contact.point.n_nodes; ++k)
        if (can_move(contact.point, k))
          is_touched[contact.point.node[k]] = true;
    std::vector<unsigned int> pairs =
      pairs_on_nodes.solve_untouched(is_touched, step);
    for (unsigned int g = 0; g < interface.n_groups(); ++g)
      {
        const unsigned int p = interface.group_pairs_begin[g];
        if (memory.is_surface_contact_group[g] &&
            !memory.state[p].is_converted && !memory.state[p].is_removed &&
            topology.is_single(g, nodes.projection))
          pairs.push_back(p);
      }
    return pairs;
  }



  template <int dim>
  std::vector<std::vector<unsigned int>>
  SurfaceContacts<dim>::group_points(
    const std::vector<ContactPoint<dim>> &points) const
  {
    DisjointSets sets(surface.n_nodes());
    std::vector<unsigned int> first(points.size(), none);
    for (unsigned int i = 0; i < points.size(); ++i)
      for (int k = 0; k < points[i].n_nodes; ++k)
        if (can_move(points[i], k))
          {
            if (first[i] == none)
              first[i] = points[i].node[k];
            else
              sets.join(first[i], points[i].node[k]);
          }
    std::vector<std::vector<unsigned int>> groups;
    std::vector<unsigned int> group_of_root(surface.n_nodes(), none);
    for (unsigned int i = 0; i < points.size(); ++i)
      if (first[i] != none)
        {
          unsigned int &group = group_of_root[sets.root(first[i])];
          if (group == none)
            {
              group = groups.size();
              groups.emplace_back();
            }
          groups[group].push_back(i);
        }
    return groups;
  }



  template <int dim>
  void
  SurfaceContacts<dim>::show_on_converted_pairs()
  {
    for (PairState<dim> &pair : memory.state)
      if (pair.is_converted)
        {
          pair.impulse = Vector<dim>{};
          pair.status  = ContactStatus::open;
        }
    for (const SurfaceContact<dim> &contact : memory.contacts)
      {
        const unsigned int g = topology.group_of_node[contact.slave];
        if (g == none || contact.is_ridge ||
            contact.point.status == ContactStatus::open)
          continue;
        for (unsigned int p = interface.group_pairs_begin[g];
             p < interface.group_pairs_begin[g + 1];
             ++p)
          {
            const Pair<dim> &pair = interface.pairs[p];
            const bool is_plus =
              contact.slave == surface.node_of_vertex[pair.plus];
            const bool is_minus =
              contact.slave == surface.node_of_vertex[pair.minus];
            if (!memory.state[p].is_converted || (!is_plus && !is_minus) ||
                contact.joint != pair.joint)
              continue;
            memory.state[p].status  = contact.point.status;
            memory.state[p].impulse = add<dim>(Vector<dim>{},
                                               is_plus ? 1. : -1.,
                                               contact.point.impulse);
          }
      }
  }



  template <int dim>
  void
  SurfaceContacts<dim>::solve_groups(std::vector<ContactPoint<dim>> &points,
                                     const std::vector<unsigned int> &pairs,
                                     const ContactStep &step)
  {
    std::vector<ContactPoint<dim>> group;
    std::vector<PointStrength> broken;
    for (const std::vector<unsigned int> &members : group_points(points))
      {
        group.clear();
        broken.clear();
        for (const unsigned int i : members)
          {
            group.push_back(points[i]);
            broken.push_back(
              i < memory.contacts.size()
                ? points[i].strength
                : strength.of_pair(pairs[i - memory.contacts.size()],
                                   false,
                                   step.kick));
          }
        solver.solve(group, broken, nodes.view, step.step, !strength.is_tied);
        for (unsigned int i = 0; i < members.size(); ++i)
          points[members[i]] = group[i];
      }
  }



  template <int dim>
  void
  SurfaceContacts<dim>::take_up(const std::vector<ContactPoint<dim>> &points,
                                const std::vector<unsigned int> &pairs,
                                const ContactStep &step)
  {
    for (unsigned int i = 0; i < points.size(); ++i)
      {
        const ContactPoint<dim> &point = points[i];
        if (i < memory.contacts.size())
          memory.contacts[i].point = point;
        else
          {
            PairState<dim> &s = memory.state[pairs[i - memory.contacts.size()]];
            s.impulse         = point.impulse;
            s.status          = point.status;
            s.is_intact       = point.is_intact;
            springs.take_up_pair(pairs[i - memory.contacts.size()],
                                 point,
                                 relative_velocity<dim>(point,
                                                        nodes.velocity.data()));
          }
        for (int k = 0; k < point.n_nodes; ++k)
          for (int d = 0; d < dim; ++d)
            nodes.impulse[dim * point.node[k] + d] +=
              point.weight[k] * point.impulse[d];
        if (step.keeps_ledger && topology.numbering.communicator.is_root())
          solver.book(point, nodes.old_velocity.data(), nodes.velocity.data());
      }
    springs.take_up_contacts(step.keeps_ledger &&
                             topology.numbering.communicator.is_root());
  }



  template <int dim>
  void
  SurfaceContacts<dim>::solve(const ContactStep &step)
  {
    const double reach = find_reach(step.step);
    // what is tied is the rock before it was cut, where no surface meets
    // another
    if (strength.is_tied)
      memory.contacts.clear();
    else
      find_contacts(step, reach);
    const std::vector<unsigned int> listed = list_pairs(step);
    std::vector<ContactPoint<dim>> points;
    points.reserve(memory.contacts.size() + listed.size());
    for (const SurfaceContact<dim> &contact : memory.contacts)
      points.push_back(contact.point);
    std::vector<unsigned int> pairs;
    for (const unsigned int p : listed)
      {
        const ContactPoint<dim> point = pairs_on_nodes.as_point(p, step.kick);
        // a spring closes where it is not stretched, and its way counts
        if (!point.spring.is_elastic &&
            (point.gap > reach ||
             point_inverse_mass<dim>(point, nodes.view) == 0.))
          {
            memory.state[p].impulse = Vector<dim>{};
            if (point.gap > reach)
              memory.state[p].status = ContactStatus::open;
            continue;
          }
        points.push_back(point);
        pairs.push_back(p);
      }

    solve_groups(points, pairs, step);
    take_up(points, pairs, step);
    show_on_converted_pairs();
  }


  template <int dim>
  void
  SurfaceContacts<dim>::correct_penetration(Fields<dim> &fields,
                                            ContactTally &tally) const
  {
    // shared like an impulse: a_k / m_k
    std::vector<double> shift(nodes.velocity.size(), 0.);
    bool is_needed = false;
    for (const SurfaceContact<dim> &contact : memory.contacts)
      {
        const ContactPoint<dim> &point = contact.point;
        const double w = point_inverse_mass<dim>(point, nodes.view);
        if (point.spring.is_elastic || point.gap >= 0. ||
            point.status == ContactStatus::open || w == 0.)
          continue;
        is_needed = true;
        for (int k = 0; k < point.n_nodes; ++k)
          for (int d = 0; d < dim; ++d)
            shift[dim * point.node[k] + d] +=
              -corrected_share * point.gap * point.weight[k] *
              nodes.inverse_mass[point.node[k]] / w * point.normal[d];
      }
    if (!is_needed)
      return;
    for (const unsigned int node : memory.surface_contact_nodes)
      if (nodes.local_node[node] != none && nodes.projection[node] == nullptr)
        for (int d = 0; d < dim; ++d)
          {
            const double length    = shift[dim * node + d];
            const unsigned int dof = dim * nodes.local_node[node] + d;
            if (length == 0.)
              continue;
            fields.shifts.emplace_back(dof, length);
            // what the shift puts into the elastic energy
            if (nodes.local_node[node] < topology.numbering.n_owned())
              tally.work.penetration -= fields.internal_force[dof] * length;
          }
  }

  template class SurfaceContacts<2>;
  template class SurfaceContacts<3>;
} // namespace Keyblock
