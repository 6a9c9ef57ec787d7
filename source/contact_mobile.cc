// SPDX-License-Identifier: LGPL-2.1-or-later
// Contact of nodes that slid or met a face: search, coupling, solution on all
// ranks alike.
#include <keyblock/contact.h>
#include <keyblock/mpi.h>

#include <algorithm>
#include <map>
#include <numeric>

namespace Keyblock
{
  template <int dim>
  void
  Contact<dim>::refresh_normals()
  {
    const std::vector<double> position = gather_positions();
    for (Vector<dim> &n : normal)
      n.fill(0.);
    std::map<std::array<unsigned int, 2>, unsigned int> face_at;
    for (unsigned int f = 0; f < interface.surface.size(); ++f)
      face_at[{{interface.surface[f].cell, interface.surface[f].face}}] = f;
    std::map<std::array<unsigned int, 2>, std::vector<unsigned int>> faces_of;
    for (const JointFace &face : interface.joint_faces)
      for (const unsigned int v :
           split.mesh.face_vertices(face.minus_cell, face.minus_face))
        faces_of[{{v, face.joint}}].push_back(
          face_at[{{face.minus_cell, face.minus_face}}]);
    for (unsigned int p = 0; p < normal.size(); ++p)
      {
        Vector<dim> sum{};
        for (const unsigned int f :
             faces_of[{{interface.pairs[p].minus, interface.pairs[p].joint}}])
          sum = add<dim>(sum, 1., search.face_normal(position, f));
        normal[p] = add<dim>(Vector<dim>{}, 1. / norm<dim>(sum), sum);
      }
  }



  template <int dim>
  void
  Contact<dim>::convert_slid_pairs()
  {
    for (unsigned int p = 0; p < state.size(); ++p)
      {
        if (state[p].is_removed || state[p].is_converted ||
            state[p].status == ContactStatus::sticking)
          continue;
        const unsigned int minus =
          numbering.local_node(interface.pairs[p].minus);
        const unsigned int plus = numbering.local_node(interface.pairs[p].plus);
        if (minus == none || plus == none)
          continue;
        Vector<dim> slip;
        for (int d = 0; d < dim; ++d)
          slip[d] = fields.displacement[dim * plus + d] -
                    fields.displacement[dim * minus + d];
        slip = add<dim>(slip, -dot<dim>(slip, normal[p]), normal[p]);
        if (norm<dim>(slip) >
            scene.contact.slip_tolerance * interface.pairs[p].face_size)
          {
            state[p].is_converted = true;
            is_search_due         = true;
          }
      }
  }



  template <int dim>
  void
  Contact<dim>::update_mobility(const ContactStep &step)
  {
    convert_slid_pairs();
    // has anything moved by half the skin since the last search? Looked at
    // again before the fastest node can have gone an eighth of it
    if (!searched_position.empty() && n_steps >= next_look)
      {
        double square = 0., speed = 0.;
        for (unsigned int slot = 0; slot < search.n_slots(); ++slot)
          if (node_of_slot[slot] < numbering.n_owned())
            {
              double moved = 0., fast = 0.;
              for (int d = 0; d < dim; ++d)
                {
                  const unsigned int dof = dim * node_of_slot[slot] + d;
                  const double way       = fields.reference[dof] +
                                     fields.displacement[dof] -
                                     searched_position[dim * slot + d];
                  moved += way * way;
                  fast += fields.velocity[dof] * fields.velocity[dof];
                }
              square = std::max(square, moved);
              speed  = std::max(speed, fast);
            }
        square = dealii::Utilities::MPI::max(square, world());
        speed  = std::sqrt(dealii::Utilities::MPI::max(speed, world()));
        is_search_due =
          is_search_due || square > 0.25 * search.skin() * search.skin();
        const double eighth = 0.125 * search.skin();
        next_look           = n_steps + 1;
        if (speed * step.step * 20. < eighth)
          next_look += 19;
      }
    if (n_ranks() > 1)
      is_search_due =
        dealii::Utilities::MPI::max(is_search_due ? 1 : 0, world()) > 0;
    if (!is_search_due)
      return;

    is_search_due     = false;
    searched_position = gather_positions();
    ++n_searches;
    // every rank needs the state of every pair that may become mobile
    std::vector<int> converted(state.size(), 0);
    for (unsigned int p = 0; p < state.size(); ++p)
      converted[p] = state[p].is_converted;
    std::vector<PairState<dim>> all = gather_pair_states();
    dealii::Utilities::MPI::max(converted, world(), converted);
    for (unsigned int p = 0; p < state.size(); ++p)
      {
        if (!is_mobile_group[group_of_pair[p]])
          state[p] = all[p];
        state[p].is_converted = converted[p];
      }
    list_candidates();
    mark_mobile_slots();
  }



  template <int dim>
  std::vector<bool>
  Contact<dim>::list_converted_groups() const
  {
    std::vector<bool> has_converted(interface.n_groups(), false);
    for (unsigned int p = 0; p < state.size(); ++p)
      if (state[p].is_converted)
        has_converted[group_of_pair[p]] = true;
    return has_converted;
  }



  template <int dim>
  void
  Contact<dim>::list_candidates()
  {
    const std::vector<bool> has_converted = list_converted_groups();
    search.search(
      searched_position, [&](const unsigned int slot, const unsigned int face) {
        const unsigned int g = group_of_slot[slot];
        if (g == none)
          return false;
        if (!has_converted[g])
          for (const unsigned int other : search.face_slots[face])
            if (group_of_slot[other] == g)
              return true;
        for (unsigned int p = interface.group_pairs_begin[g];
             p < interface.group_pairs_begin[g + 1];
             ++p)
          {
            const Pair<dim> &pair = interface.pairs[p];
            const unsigned int v  = search.vertex_of_slot[slot];
            if (state[p].is_converted || (pair.minus != v && pair.plus != v))
              continue;
            const unsigned int partner =
              search.slot_of_vertex[pair.minus == v ? pair.plus : pair.minus];
            const SurfaceFace<dim> &surface = interface.surface[face];
            if (search.block_of_slot[partner] == surface.block &&
                (pair.joint == surface.joint ||
                 (surface.joint == none && !has_converted[g])))
              return true;
          }
        return false;
      });
  }



  template <int dim>
  void
  Contact<dim>::mark_mobile_slots()
  {
    std::fill(is_mobile_slot.begin(), is_mobile_slot.end(), false);
    is_mobile_group = list_converted_groups();
    for (const unsigned int slot : search.candidate_slots())
      {
        is_mobile_slot[slot] = true;
        if (group_of_slot[slot] != none)
          is_mobile_group[group_of_slot[slot]] = true;
      }
    for (const HangingVertex &hanging : split.hanging)
      if (search.slot_of_vertex[hanging.vertex] != none &&
          is_mobile_slot[search.slot_of_vertex[hanging.vertex]])
        for (const auto &[master, weight] : hanging.masters)
          {
            const unsigned int slot = search.slot_of_vertex[master];
            is_mobile_slot[slot]    = true;
            if (group_of_slot[slot] != none)
              is_mobile_group[group_of_slot[slot]] = true;
          }
    for (unsigned int slot = 0; slot < search.n_slots(); ++slot)
      if (group_of_slot[slot] != none && is_mobile_group[group_of_slot[slot]])
        is_mobile_slot[slot] = true;
    mobile_slots.clear();
    for (unsigned int slot = 0; slot < search.n_slots(); ++slot)
      if (is_mobile_slot[slot])
        {
          mobile_slots.push_back(slot);
          if (node_of_slot[slot] != none)
            fields.is_in_cluster[node_of_slot[slot]] = false;
        }
    mobile_corners.clear();
    for (unsigned int c = 0; c < corners.size(); ++c)
      if (is_mobile_group[corners[c].group])
        mobile_corners.push_back(c);
    n_mobile = mobile_slots.size();
    rebuild_active_slots();
  }



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
  void
  Contact<dim>::solve_mobile(const ContactStep &step)
  {
    const double scale = step.kick / last_kick;
    double speed       = 0.;
    for (const unsigned int slot : mobile_slots)
      for (int d = 0; d < dim; ++d)
        speed = std::max(speed, std::abs(slot_velocity[dim * slot + d]));
    const double reach = 2. * dim * speed * step.step + 1e-6 * search.skin();

    // surface contacts, starting from the impulse of the step before
    const std::vector<SurfaceContact<dim>> previous = contacts;
    search.evaluate(slot_position, reach, contacts);
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
    std::multimap<unsigned int, const SurfaceContact<dim> *> before;
    for (const SurfaceContact<dim> &contact : previous)
      before.emplace(contact.slave, &contact);
    for (SurfaceContact<dim> &contact : contacts)
      {
        if (!split.hanging.empty())
          put_masters_into(contact.point);
        double tangent = default_tangent, kinetic = default_tangent;
        if (contact.joint != none)
          {
            tangent = static_tangent[contact.joint];
            kinetic = kinetic_tangent[contact.joint];
          }
        if (override_tangent >= 0.)
          tangent = kinetic = override_tangent;
        const double share =
          reduction.share_between(search.block_of_slot[contact.slave],
                                  contact.master_block,
                                  contact.joint);
        const auto area = slave_area.find({{contact.slave, contact.joint}});
        if (area != slave_area.end())
          contact.point.strength.cohesion =
            scene.joints[contact.joint]->residual_cohesion * area->second *
            step.kick * share;
        contact.point.strength.static_friction  = tangent * share;
        contact.point.strength.kinetic_friction = kinetic * share;
        const auto range = before.equal_range(contact.slave);
        for (auto it = range.first; it != range.second; ++it)
          if (it->second->is_ridge == contact.is_ridge &&
              dot<dim>(it->second->point.normal, contact.point.normal) > 0.99)
            contact.point.impulse =
              add<dim>(Vector<dim>{}, scale, it->second->point.impulse);
      }

    // points by number: surface contacts first, then pairs
    std::vector<unsigned int> parent(search.n_slots());
    std::iota(parent.begin(), parent.end(), 0);
    std::vector<ContactPoint<dim>> points;
    for (const SurfaceContact<dim> &contact : contacts)
      points.push_back(contact.point);
    std::vector<unsigned int> pairs;
    std::vector<unsigned char> touched(search.n_slots(), 0);
    for (const ContactPoint<dim> &point : points)
      for (int k = 0; k < point.n_nodes; ++k)
        if (point.weight[k] != 0. && slot_inverse_mass[point.node[k]] > 0.)
          touched[point.node[k]] = 1;
    for (const unsigned int c : mobile_corners)
      if (std::none_of(corners[c].slots.begin(),
                       corners[c].slots.end(),
                       [&](const unsigned int slot) { return touched[slot]; }))
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
    std::vector<unsigned int> kept_pairs;
    for (const unsigned int p : pairs)
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
        kept_pairs.push_back(p);
      }

    // groups of points that share nodes which can move
    for (const ContactPoint<dim> &point : points)
      {
        unsigned int first = none;
        for (int k = 0; k < point.n_nodes; ++k)
          if (point.weight[k] != 0. && slot_inverse_mass[point.node[k]] > 0.)
            {
              if (first == none)
                first = root_of(parent, point.node[k]);
              else
                parent[root_of(parent, point.node[k])] = first;
            }
      }
    std::map<unsigned int, std::vector<unsigned int>> groups;
    for (unsigned int i = 0; i < points.size(); ++i)
      for (int k = 0; k < points[i].n_nodes; ++k)
        if (points[i].weight[k] != 0. &&
            slot_inverse_mass[points[i].node[k]] > 0.)
          {
            groups[root_of(parent, points[i].node[k])].push_back(i);
            break;
          }
    std::vector<ContactPoint<dim>> group_points;
    std::vector<PointStrength> broken;
    for (const auto &[root, members] : groups)
      {
        group_points.clear();
        broken.clear();
        for (const unsigned int i : members)
          {
            group_points.push_back(points[i]);
            broken.push_back(i < contacts.size()
                               ? points[i].strength
                               : pair_strength(kept_pairs[i - contacts.size()],
                                               false,
                                               step.kick));
          }
        solve_points(group_points, broken, slot_nodes, step.step);
        for (unsigned int i = 0; i < members.size(); ++i)
          points[members[i]] = group_points[i];
      }

    // a converted pair shows the surface contact of its nodes
    for (unsigned int p = 0; p < state.size(); ++p)
      if (state[p].is_converted)
        {
          state[p].impulse = Vector<dim>{};
          state[p].status  = ContactStatus::open;
          for (unsigned int i = 0; i < contacts.size(); ++i)
            {
              const bool is_plus =
                contacts[i].slave ==
                search.slot_of_vertex[interface.pairs[p].plus];
              const bool is_minus =
                contacts[i].slave ==
                search.slot_of_vertex[interface.pairs[p].minus];
              if (contacts[i].is_ridge || (!is_plus && !is_minus) ||
                  contacts[i].joint != interface.pairs[p].joint ||
                  points[i].status == ContactStatus::open)
                continue;
              state[p].status = points[i].status;
              state[p].impulse =
                add<dim>(Vector<dim>{}, is_plus ? 1. : -1., points[i].impulse);
            }
        }
    for (unsigned int i = 0; i < points.size(); ++i)
      {
        const ContactPoint<dim> &point = points[i];
        if (i < contacts.size())
          contacts[i].point = point;
        else
          {
            PairState<dim> &s = state[kept_pairs[i - contacts.size()]];
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

  template void Contact<2>::correct_penetration();
  template void Contact<3>::correct_penetration();
  template void Contact<2>::refresh_normals();
  template void Contact<3>::refresh_normals();
  template void Contact<2>::update_mobility(const ContactStep &);
  template void Contact<3>::update_mobility(const ContactStep &);
  template void Contact<2>::list_candidates();
  template void Contact<3>::list_candidates();
  template void Contact<2>::solve_mobile(const ContactStep &);
  template void Contact<3>::solve_mobile(const ContactStep &);
  template void Contact<2>::convert_slid_pairs();
  template void Contact<3>::convert_slid_pairs();
} // namespace Keyblock
