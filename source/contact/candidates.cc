// SPDX-License-Identifier: LGPL-2.1-or-later
// Which nodes slid or met a face: present normals, search, and the slots that
// are solved on all ranks alike.
#include <keyblock/base/mpi.h>
#include <keyblock/contact/contact.h>

#include <algorithm>
#include <map>

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
  bool
  Contact<dim>::convert_slid_pairs()
  {
    bool has_slid = false;
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
            has_slid              = true;
          }
      }
    return has_slid;
  }



  template <int dim>
  void
  Contact<dim>::update_mobility(const ContactStep &step)
  {
    const bool has_slid = convert_slid_pairs();
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
        square = max_over_ranks(square);
        speed  = std::sqrt(max_over_ranks(speed));
        is_search_due =
          is_search_due || square > 0.25 * search.skin() * search.skin();
        const double eighth = 0.125 * search.skin();
        next_look           = n_steps + 1;
        if (speed * step.step * 20. < eighth)
          next_look += 19;
      }
    int due = is_search_due ? 2 : has_slid ? 1 : 0;
    if (n_ranks() > 1) // every step: alone, nobody needs to be asked
      due = max_over_ranks(due);
    if (due == 0)
      return;

    const bool is_moved = due == 2;
    is_search_due       = false;
    if (is_moved)
      searched_position = gather_positions();
    ++n_searches;
    // every rank needs the state of every pair that may become mobile
    std::vector<int> converted(state.size(), 0);
    for (unsigned int p = 0; p < state.size(); ++p)
      converted[p] = state[p].is_converted;
    std::vector<PairState<dim>> all = gather_pair_states();
    max_lists(converted);
    for (unsigned int p = 0; p < state.size(); ++p)
      {
        if (!is_mobile_group[group_of_pair[p]])
          state[p] = all[p];
        if (has_memory && converted[p] && !all[p].is_converted)
          pass_on_history(p);
        state[p].is_converted = converted[p];
      }
    list_candidates(is_moved);
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
  Contact<dim>::list_candidates(const bool is_moved)
  {
    const std::vector<bool> has_converted = list_converted_groups();
    std::vector<bool> converted(state.size()), has_changed;
    for (unsigned int p = 0; p < state.size(); ++p)
      converted[p] = state[p].is_converted;
    if (!is_moved)
      {
        std::vector<bool> changes(interface.n_groups(), false);
        for (unsigned int p = 0; p < state.size(); ++p)
          if (converted[p] != listed_converted[p])
            changes[group_of_pair[p]] = true;
        for (const unsigned int g : group_of_slot)
          has_changed.push_back(g != none && changes[g]);
      }
    listed_converted = converted;
    search.search(
      searched_position,
      [&](const unsigned int slot, const unsigned int face) {
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
            if (search.is_on_block(partner, surface.block) &&
                (pair.joint == surface.joint ||
                 (surface.joint == none && !has_converted[g])))
              return true;
          }
        return false;
      },
      has_changed);
    if (is_moved && std::find(needs_areas.begin(), needs_areas.end(), true) !=
                      needs_areas.end())
      overlaps = search.list_overlaps(searched_position, needs_areas);
    shared_among = {};
    covered_area.clear();
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

  template void Contact<2>::refresh_normals();
  template void Contact<3>::refresh_normals();
  template bool Contact<2>::convert_slid_pairs();
  template bool Contact<3>::convert_slid_pairs();
  template void Contact<2>::update_mobility(const ContactStep &);
  template void Contact<3>::update_mobility(const ContactStep &);
  template void Contact<2>::list_candidates(const bool);
  template void Contact<3>::list_candidates(const bool);
  template void Contact<2>::mark_mobile_slots();
  template void Contact<3>::mark_mobile_slots();
} // namespace Keyblock
