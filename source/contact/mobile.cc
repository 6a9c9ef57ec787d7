// SPDX-License-Identifier: LGPL-2.1-or-later
// Contact of nodes that slid or met a face: coupling, and the solution on all
// ranks alike. Points are numbered through: surface contacts first, then pairs.
#include <keyblock/base/mpi.h>
#include <keyblock/contact/contact.h>
#include <keyblock/law/joint_law.h>

#include <algorithm>
#include <map>
#include <numeric>

namespace Keyblock
{
  template <int dim>
  void
  Contact<dim>::put_masters_into(ContactPoint<dim> &point) const
  {
    const auto hangs = [&](const unsigned int slot) {
      return split.is_hanging(search.vertex_of_slot[slot]);
    };
    if (std::none_of(point.node.begin(),
                     point.node.begin() + point.n_nodes,
                     hangs))
      return;
    std::map<unsigned int, double> shares;
    for (int k = 0; k < point.n_nodes; ++k)
      split.for_each_carrier(search.vertex_of_slot[point.node[k]],
                             [&](const unsigned int vertex,
                                 const double share) {
                               shares[search.slot_of_vertex[vertex]] +=
                                 share * point.weight[k];
                             });
    AssertThrow(shares.size() <= point.node.size(),
                ComputationError(
                  "A contact point has more nodes than there is room for; "
                  "refine the faces on both sides of the joint alike."));
    point.n_nodes = 0;
    for (const auto &[slot, weight] : shares)
      {
        point.node[point.n_nodes]     = slot;
        point.weight[point.n_nodes++] = weight;
      }
  }



  template <int dim>
  void
  Contact<dim>::find_surface_contacts(const ContactStep &step,
                                      const double reach)
  {
    const std::vector<SurfaceContact<dim>> previous = contacts;
    double square                                   = 0.;
    for (const unsigned int slot : mobile_slots)
      {
        double way = 0.;
        for (unsigned int i = dim * slot; i < dim * (slot + 1); ++i)
          way += (slot_position[i] - searched_position[i]) *
                 (slot_position[i] - searched_position[i]);
        square = std::max(square, way);
      }
    search.evaluate(slot_position, reach, std::sqrt(square), contacts);
    if (std::find(is_removed_block.begin(), is_removed_block.end(), true) !=
        is_removed_block.end())
      contacts.erase(
        std::remove_if(
          contacts.begin(),
          contacts.end(),
          [&](const SurfaceContact<dim> &contact) {
            return is_removed_block[contact.master_block] ||
                   is_removed_block[search.block_of_slot[contact.slave]];
          }),
        contacts.end());

    const auto before = [](const SurfaceContact<dim> *a,
                           const SurfaceContact<dim> *b) {
      return a->slave < b->slave;
    };
    std::vector<const SurfaceContact<dim> *> by_slave;
    for (const SurfaceContact<dim> &contact : previous)
      by_slave.push_back(&contact);
    std::stable_sort(by_slave.begin(), by_slave.end(), before);
    const double scale = step.kick / last_kick;
    for (SurfaceContact<dim> &contact : contacts)
      {
        if (!split.hanging.empty())
          put_masters_into(contact.point);
        const auto range =
          std::equal_range(by_slave.begin(), by_slave.end(), &contact, before);
        if (range.first == range.second && !contact.is_ridge)
          contact.point.impulse = impulse_of_slid_pair(contact, scale);
        for (auto it = range.first; it != range.second; ++it)
          if ((*it)->is_ridge == contact.is_ridge &&
              dot<dim>((*it)->point.normal, contact.point.normal) > 0.99)
            contact.point.impulse =
              add<dim>(Vector<dim>{}, scale, (*it)->point.impulse);
      }
    share_areas();
    for (SurfaceContact<dim> &contact : contacts)
      contact.point.strength = surface_strength(contact, step.kick);
  }



  template <int dim>
  Vector<dim>
  Contact<dim>::impulse_of_slid_pair(const SurfaceContact<dim> &contact,
                                     const double scale) const
  {
    const unsigned int g = group_of_slot[contact.slave];
    if (g == none)
      return {};
    const unsigned int v = search.vertex_of_slot[contact.slave];
    for (unsigned int p = interface.group_pairs_begin[g];
         p < interface.group_pairs_begin[g + 1];
         ++p)
      {
        const Pair<dim> &pair = interface.pairs[p];
        if (!state[p].is_converted || pair.joint != contact.joint ||
            (pair.minus != v && pair.plus != v))
          continue;
        const double side = pair.plus == v ? 1. : -1.;
        if (side * dot<dim>(normal[p], contact.point.normal) > 0.99)
          return add<dim>(Vector<dim>{}, side * scale, state[p].impulse);
      }
    return {};
  }



  template <int dim>
  PointStrength
  Contact<dim>::surface_strength(const SurfaceContact<dim> &contact,
                                 const double kick) const
  {
    const double share =
      reduction.share_between(search.block_of_slot[contact.slave],
                              contact.master_block,
                              contact.joint);
    // surfaces lie on each other where pairs have slid
    JointPointState state{false, false, {}, 0.};
    const auto area =
      covered_area.find({{contact.slave, contact.joint, contact.master_block}});
    if (has_memory)
      {
        if (const auto *history = find_history(contact.slave, contact.joint))
          state.history = *history;
        state.pressure = pressure_of(contact.point.impulse,
                                     contact.point.normal,
                                     area_of(contact));
      }
    const StrengthEnvelope envelope = envelope_of(contact.joint, state);
    if (area != covered_area.end() && !contact.is_ridge)
      return envelope.of_point(share, area->second, kick);
    PointStrength strength = envelope.of_point(share, 0., kick);
    strength.cohesion      = contact.point.strength.cohesion;
    return strength;
  }



  template <int dim>
  bool
  Contact<dim>::can_move(const ContactPoint<dim> &point, const int k) const
  {
    return point.weight[k] != 0. && slot_inverse_mass[point.node[k]] > 0.;
  }



  template <int dim>
  std::vector<unsigned int>
  Contact<dim>::list_mobile_pairs(const ContactStep &step)
  {
    std::vector<bool> is_touched(search.n_slots(), false);
    for (const SurfaceContact<dim> &contact : contacts)
      for (int k = 0; k < contact.point.n_nodes; ++k)
        if (can_move(contact.point, k))
          is_touched[contact.point.node[k]] = true;
    std::vector<unsigned int> pairs;
    for (const unsigned int c : mobile_corners)
      if (std::none_of(corners[c].slots.begin(),
                       corners[c].slots.end(),
                       [&](const unsigned int slot) {
                         return is_touched[slot];
                       }))
        solve_corner(corners[c], step);
      else
        for (unsigned int p = interface.group_pairs_begin[corners[c].group];
             p < interface.group_pairs_begin[corners[c].group + 1];
             ++p)
          if (!state[p].is_converted && !state[p].is_removed)
            pairs.push_back(p);
    for (unsigned int g = 0; g < interface.n_groups(); ++g)
      {
        const unsigned int p = interface.group_pairs_begin[g];
        if (is_mobile_group[g] && interface.group_pairs_begin[g + 1] == p + 1 &&
            !state[p].is_converted && !state[p].is_removed &&
            slot_projection[search.slot_of_vertex[interface.pairs[p].minus]] ==
              nullptr &&
            slot_projection[search.slot_of_vertex[interface.pairs[p].plus]] ==
              nullptr)
          pairs.push_back(p);
      }
    return pairs;
  }



  namespace
  {
    /** Root of the set of @p slot, with path halving. */
    unsigned int
    root_of(std::vector<unsigned int> &parent, unsigned int slot)
    {
      while (parent[slot] != slot)
        slot = parent[slot] = parent[parent[slot]];
      return slot;
    }
  } // namespace



  template <int dim>
  std::vector<std::vector<unsigned int>>
  Contact<dim>::group_points(const std::vector<ContactPoint<dim>> &points) const
  {
    std::vector<unsigned int> parent(search.n_slots());
    std::iota(parent.begin(), parent.end(), 0);
    std::vector<unsigned int> first(points.size(), none);
    for (unsigned int i = 0; i < points.size(); ++i)
      for (int k = 0; k < points[i].n_nodes; ++k)
        if (can_move(points[i], k))
          {
            const unsigned int root = root_of(parent, points[i].node[k]);
            if (first[i] == none)
              first[i] = root;
            else
              parent[root] = root_of(parent, first[i]);
          }
    std::vector<std::vector<unsigned int>> groups;
    std::vector<unsigned int> group_of_root(search.n_slots(), none);
    for (unsigned int i = 0; i < points.size(); ++i)
      if (first[i] != none)
        {
          unsigned int &group = group_of_root[root_of(parent, first[i])];
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
  Contact<dim>::show_on_converted_pairs()
  {
    for (PairState<dim> &pair : state)
      if (pair.is_converted)
        {
          pair.impulse = Vector<dim>{};
          pair.status  = ContactStatus::open;
        }
    for (const SurfaceContact<dim> &contact : contacts)
      {
        const unsigned int g = group_of_slot[contact.slave];
        if (g == none || contact.is_ridge ||
            contact.point.status == ContactStatus::open)
          continue;
        for (unsigned int p = interface.group_pairs_begin[g];
             p < interface.group_pairs_begin[g + 1];
             ++p)
          {
            const Pair<dim> &pair = interface.pairs[p];
            const bool is_plus =
              contact.slave == search.slot_of_vertex[pair.plus];
            const bool is_minus =
              contact.slave == search.slot_of_vertex[pair.minus];
            if (!state[p].is_converted || (!is_plus && !is_minus) ||
                contact.joint != pair.joint)
              continue;
            state[p].status  = contact.point.status;
            state[p].impulse = add<dim>(Vector<dim>{},
                                        is_plus ? 1. : -1.,
                                        contact.point.impulse);
          }
      }
  }



  template <int dim>
  void
  Contact<dim>::solve_mobile(const ContactStep &step)
  {
    double speed = 0.;
    for (const unsigned int slot : mobile_slots)
      for (int d = 0; d < dim; ++d)
        speed = std::max(speed, std::abs(slot_velocity[dim * slot + d]));
    const double reach = 2. * dim * speed * step.step + 1e-6 * search.skin();

    // what is tied is the rock before it was cut, where no surface meets
    // another
    if (is_tied)
      contacts.clear();
    else
      find_surface_contacts(step, reach);
    std::vector<ContactPoint<dim>> points;
    for (const SurfaceContact<dim> &contact : contacts)
      points.push_back(contact.point);
    std::vector<unsigned int> pairs;
    for (const unsigned int p : list_mobile_pairs(step))
      {
        const ContactPoint<dim> point = pair_as_point(p, step.kick);
        if (point.gap > reach ||
            point_inverse_mass<dim>(point, slot_nodes) == 0.)
          {
            state[p].impulse = Vector<dim>{};
            if (point.gap > reach)
              state[p].status = ContactStatus::open;
            continue;
          }
        points.push_back(point);
        pairs.push_back(p);
      }

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
              i < contacts.size()
                ? points[i].strength
                : pair_strength(pairs[i - contacts.size()], false, step.kick));
          }
        solve_points(group, broken, slot_nodes, step.step);
        for (unsigned int i = 0; i < members.size(); ++i)
          points[members[i]] = group[i];
      }

    for (unsigned int i = 0; i < points.size(); ++i)
      {
        const ContactPoint<dim> &point = points[i];
        if (i < contacts.size())
          contacts[i].point = point;
        else
          {
            PairState<dim> &s = state[pairs[i - contacts.size()]];
            s.impulse         = point.impulse;
            s.status          = point.status;
            s.is_intact       = point.is_intact;
          }
        for (int k = 0; k < point.n_nodes; ++k)
          for (int d = 0; d < dim; ++d)
            slot_impulse[dim * point.node[k] + d] +=
              point.weight[k] * point.impulse[d];
        if (step.keeps_ledger && is_root())
          book_work(point, slot_old_velocity.data(), slot_velocity.data());
      }
    show_on_converted_pairs();
  }



  template <int dim>
  void
  Contact<dim>::correct_penetration()
  {
    // a tenth of the overlap a step, shared like an impulse: a_k / m_k
    // (a node of several points takes the mean of what they ask for)
    std::vector<double> shift(slot_velocity.size(), 0.);
    std::vector<unsigned int> n_shares(search.n_slots(), 0);
    bool is_needed = false;
    for (const SurfaceContact<dim> &contact : contacts)
      {
        const ContactPoint<dim> &point = contact.point;
        const double w = point_inverse_mass<dim>(point, slot_nodes);
        if (point.gap >= 0. || point.status == ContactStatus::open || w == 0.)
          continue;
        is_needed = true;
        for (int k = 0; k < point.n_nodes; ++k)
          n_shares[point.node[k]] += point.weight[k] != 0.;
        for (int k = 0; k < point.n_nodes; ++k)
          for (int d = 0; d < dim; ++d)
            shift[dim * point.node[k] + d] +=
              -0.1 * point.gap * point.weight[k] *
              slot_inverse_mass[point.node[k]] / w * point.normal[d];
      }
    if (!is_needed)
      return;
    for (const unsigned int slot : mobile_slots)
      if (node_of_slot[slot] != none && slot_projection[slot] == nullptr)
        for (int d = 0; d < dim; ++d)
          {
            const double length    = shift[dim * slot + d];
            const unsigned int dof = dim * node_of_slot[slot] + d;
            if (length == 0.)
              continue;
            fields.shifts.emplace_back(dof, length);
            // what the shift puts into the elastic energy
            if (node_of_slot[slot] < numbering.n_owned())
              work.penetration -= fields.internal_force[dof] * length;
          }
  }

  template void Contact<2>::solve_mobile(const ContactStep &);
  template void Contact<3>::solve_mobile(const ContactStep &);
  template void Contact<2>::correct_penetration();
  template void Contact<3>::correct_penetration();
} // namespace Keyblock
