// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/contact/contact_detection.h>
#include <keyblock/contact/pair_exchange.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace Keyblock
{
  namespace
  {
    /** Way of a node from which on contacts are searched again, over the skin
     * [-]: two of them that approach each other use it up. */
    constexpr double used_up_way = 0.5;

    /** Steps for which motion is not measured where nodes move less than a way
     * in them, over the skin [-]. */
    constexpr unsigned int slow_steps = 20;
    constexpr double slow_way         = 0.125;

    /** Sine of the angle to the direction in which a node is held, squared, up
     * to which a normal has it [-]. */
    constexpr double along_support = 1e-4;
  } // namespace



  template <int dim>
  ContactDetection<dim>::ContactDetection(ContactSearch<dim> &search,
                                          const PairTopology<dim> &topology,
                                          const ContactStrength<dim> &strength,
                                          const SurfaceNodes<dim> &nodes,
                                          ContactAreas<dim> &areas,
                                          ContactHistory<dim> &history,
                                          JointSprings<dim> &springs,
                                          MultiPairContact<dim> &multi_pairs,
                                          Fields<dim> &fields,
                                          ContactMemory<dim> &memory)
    : search(search)
    , surface(search.surface)
    , topology(topology)
    , scene(topology.scene)
    , split(topology.split)
    , interface(topology.interface)
    , numbering(topology.numbering)
    , strength(strength)
    , nodes(nodes)
    , areas(areas)
    , history(history)
    , springs(springs)
    , multi_pairs(multi_pairs)
    , fields(fields)
    , memory(memory)
  {}


  template <int dim>
  void
  ContactDetection<dim>::refresh_normals()
  {
    const std::vector<double> position         = nodes.gather_positions();
    const std::vector<Vector<dim>> old_normals = memory.normal;
    for (Vector<dim> &n : memory.normal)
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
    for (unsigned int p = 0; p < memory.normal.size(); ++p)
      {
        Vector<dim> sum{};
        for (const unsigned int f :
             faces_of[{{interface.pairs[p].minus, interface.pairs[p].joint}}])
          sum = add<dim>(sum, 1., surface.face_normal(position, f));
        memory.normal[p] = add<dim>(Vector<dim>{}, 1. / norm<dim>(sum), sum);
      }
    springs.turn_pairs(old_normals);
  }



  template <int dim>
  bool
  ContactDetection<dim>::stays_pair(const unsigned int pair) const
  {
    const Vector<dim> &normal = memory.normal[pair];
    const auto is_held        = [&](const unsigned int node) {
      const double *p = nodes.view.projection_of(node);
      double free     = nodes.inverse_mass[node] > 0. && p == nullptr ? 1. : 0.;
      for (int d = 0; d < dim && p != nullptr; ++d)
        for (int e = 0; e < dim; ++e)
          free += normal[d] * p[dim * d + e] * normal[e];
      return free <= along_support;
    };
    const Pair<dim> &ends = interface.pairs[pair];
    bool has_free         = false;
    for (const unsigned int v : {ends.minus, ends.plus})
      {
        const unsigned int node = surface.node_of_vertex[v];
        if (!is_held(node))
          return false;
        for (const unsigned int f : surface.faces_of_node[node])
          if (interface.surface[f].joint == ends.joint)
            for (const unsigned int other : surface.nodes_of_face[f])
              has_free = has_free || !is_held(other);
      }
    return has_free;
  }



  template <int dim>
  bool
  ContactDetection<dim>::convert_slid_pairs()
  {
    bool has_slid = false;
    for (unsigned int p = 0; p < memory.state.size(); ++p)
      {
        if (memory.state[p].is_removed || memory.state[p].is_converted ||
            memory.state[p].status == ContactStatus::sticking)
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
        slip =
          add<dim>(slip, -dot<dim>(slip, memory.normal[p]), memory.normal[p]);
        if (norm<dim>(slip) >
              scene.contact.slip_tolerance * interface.pairs[p].face_size &&
            !stays_pair(p))
          {
            memory.state[p].is_converted = true;
            has_slid                     = true;
          }
      }
    return has_slid;
  }



  template <int dim>
  void
  ContactDetection<dim>::measure_motion(const double step)
  {
    if (!memory.searched_position.empty() &&
        memory.n_steps >= memory.next_motion_check)
      {
        double square = 0., speed = 0.;
        for (unsigned int node = 0; node < surface.n_nodes(); ++node)
          if (nodes.local_node[node] < numbering.n_owned())
            {
              double moved = 0., fast = 0.;
              for (int d = 0; d < dim; ++d)
                {
                  const unsigned int dof = dim * nodes.local_node[node] + d;
                  const double way       = surface.place_of_node[node][d] +
                                     fields.displacement[dof] -
                                     memory.searched_position[dim * node + d];
                  moved += way * way;
                  fast += fields.velocity[dof] * fields.velocity[dof];
                }
              square = std::max(square, moved);
              speed  = std::max(speed, fast);
            }
        square = numbering.communicator.max(square);
        speed  = std::sqrt(numbering.communicator.max(speed));
        memory.is_search_due =
          memory.is_search_due ||
          square > used_up_way * used_up_way * surface.skin() * surface.skin();
        const bool is_slow =
          speed * step * slow_steps < slow_way * surface.skin();
        memory.next_motion_check = memory.n_steps + (is_slow ? slow_steps : 1);
      }
  }



  template <int dim>
  void
  ContactDetection<dim>::share_pair_states()
  {
    std::vector<int> converted(memory.state.size(), 0);
    for (unsigned int p = 0; p < memory.state.size(); ++p)
      converted[p] = memory.state[p].is_converted;
    std::vector<PairState<dim>> all = gather_pair_states(topology, memory);
    numbering.communicator.max_lists(converted);
    std::vector<JointHistory> histories;
    if (strength.has_memory)
      histories = gather_pair_histories(topology, memory);
    std::vector<SpringState<dim>> stretched;
    if (springs.are_any())
      stretched = gather_pair_springs(topology, memory);
    for (unsigned int p = 0; p < memory.state.size(); ++p)
      {
        const unsigned int g = topology.group_of_pair[p];
        if (!memory.is_surface_contact_group[g])
          memory.state[p] = all[p];
        if (strength.has_memory && !memory.is_surface_contact_group[g])
          memory.pair_histories[p] = histories[p];
        if (strength.has_memory && converted[p])
          history.pass_on(p);
        if (springs.are_any() && !memory.is_surface_contact_group[g])
          memory.pair_springs[p] = stretched[p];
        if (converted[p])
          springs.pass_on(p);
        memory.state[p].is_converted = converted[p];
      }
  }



  template <int dim>
  bool
  ContactDetection<dim>::update(const double step)
  {
    const bool has_slid = convert_slid_pairs();
    measure_motion(step);
    int due = memory.is_search_due ? 2 : has_slid ? 1 : 0;
    if (numbering.communicator.size() >
        1) // every step: alone, nobody needs to be asked
      due = numbering.communicator.max(due);
    if (due == 0)
      return false;

    const bool is_moved  = due == 2;
    memory.is_search_due = false;
    if (is_moved)
      memory.searched_position = nodes.gather_positions();
    share_pair_states();
    if (is_moved)
      memory.searched_gap =
        history.largest_dilation() + springs.largest_offset();
    list_candidates(is_moved);
    mark_surface_contacts();
    return true;
  }



  template <int dim>
  void
  ContactDetection<dim>::search_again()
  {
    if (!memory.searched_position.empty())
      list_candidates(true);
  }


  template <int dim>
  std::vector<bool>
  ContactDetection<dim>::list_converted_groups() const
  {
    std::vector<bool> has_converted(interface.n_groups(), false);
    for (unsigned int p = 0; p < memory.state.size(); ++p)
      if (memory.state[p].is_converted)
        has_converted[topology.group_of_pair[p]] = true;
    return has_converted;
  }



  template <int dim>
  bool
  ContactDetection<dim>::is_paired(const unsigned int node,
                                   const unsigned int face,
                                   const std::vector<bool> &has_converted) const
  {
    const unsigned int g = topology.group_of_node[node];
    if (g == none)
      return false;
    if (!has_converted[g])
      for (const unsigned int other : surface.nodes_of_face[face])
        if (topology.group_of_node[other] == g)
          return true;
    for (unsigned int p = interface.group_pairs_begin[g];
         p < interface.group_pairs_begin[g + 1];
         ++p)
      {
        const Pair<dim> &pair = interface.pairs[p];
        const unsigned int v  = surface.vertex_of_node[node];
        if (memory.state[p].is_converted || (pair.minus != v && pair.plus != v))
          continue;
        const unsigned int partner =
          surface.node_of_vertex[pair.minus == v ? pair.plus : pair.minus];
        const SurfaceFace<dim> &other = interface.surface[face];
        if (surface.is_on_block(partner, other.block) &&
            (pair.joint == other.joint ||
             (other.joint == none && !has_converted[g])))
          return true;
      }
    return false;
  }


  template <int dim>
  void
  ContactDetection<dim>::list_candidates(const bool is_moved)
  {
    const std::vector<bool> has_converted = list_converted_groups();
    std::vector<bool> converted(memory.state.size()), has_changed;
    for (unsigned int p = 0; p < memory.state.size(); ++p)
      converted[p] = memory.state[p].is_converted;
    if (!is_moved)
      {
        std::vector<bool> changes(interface.n_groups(), false);
        for (unsigned int p = 0; p < memory.state.size(); ++p)
          if (converted[p] != listed_converted[p])
            changes[topology.group_of_pair[p]] = true;
        for (const unsigned int g : topology.group_of_node)
          has_changed.push_back(g != none && changes[g]);
      }
    listed_converted = converted;
    search.widen(memory.searched_gap);
    search.search(
      memory.searched_position,
      [&](const unsigned int node, const unsigned int face) {
        return is_paired(node, face, has_converted);
      },
      has_changed);
    areas.find_overlaps(is_moved);
  }



  template <int dim>
  void
  ContactDetection<dim>::mark_surface_contacts()
  {
    std::fill(memory.is_surface_contact_node.begin(),
              memory.is_surface_contact_node.end(),
              false);
    memory.is_surface_contact_group = list_converted_groups();
    for (const unsigned int node : search.candidate_nodes())
      {
        memory.is_surface_contact_node[node] = true;
        if (topology.group_of_node[node] != none)
          memory.is_surface_contact_group[topology.group_of_node[node]] = true;
      }
    for (const HangingVertex &hanging : split.hanging)
      if (surface.node_of_vertex[hanging.vertex] != none &&
          memory
            .is_surface_contact_node[surface.node_of_vertex[hanging.vertex]])
        for (const auto &[master, weight] : hanging.masters)
          {
            const unsigned int node = surface.node_of_vertex[master];
            memory.is_surface_contact_node[node] = true;
            if (topology.group_of_node[node] != none)
              memory.is_surface_contact_group[topology.group_of_node[node]] =
                true;
          }
    for (unsigned int node = 0; node < surface.n_nodes(); ++node)
      if (topology.group_of_node[node] != none &&
          memory.is_surface_contact_group[topology.group_of_node[node]])
        memory.is_surface_contact_node[node] = true;
    memory.surface_contact_nodes.clear();
    for (unsigned int node = 0; node < surface.n_nodes(); ++node)
      if (memory.is_surface_contact_node[node])
        {
          memory.surface_contact_nodes.push_back(node);
          if (nodes.local_node[node] != none)
            fields.is_in_cluster[nodes.local_node[node]] = false;
        }
    multi_pairs.list_surface_contact_groups();
    multi_pairs.activate_nodes();
  }

  template class ContactDetection<2>;
  template class ContactDetection<3>;
} // namespace Keyblock
