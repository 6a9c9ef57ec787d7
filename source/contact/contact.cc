// SPDX-License-Identifier: LGPL-2.1-or-later
// Contact: its parts, and the order of the step.
#include <keyblock/contact/contact.h>

#include <algorithm>

namespace Keyblock
{
  namespace
  {
    /** Steps within a check interval at the normals of pairs, in large
     * kinematics. */
    constexpr unsigned int normals_interval = 20;

    /** That of the start, but for bonds. */
    template <int dim>
    ContactMemory<dim>
    make_memory(const SplitMesh<dim> &split,
                const Blocks<dim> &blocks,
                const ContactSurface<dim> &surface)
    {
      const Interface<dim> &interface = split.interface;
      ContactMemory<dim> memory;
      memory.state.resize(interface.pairs.size());
      for (unsigned int p = 0; p < interface.pairs.size(); ++p)
        {
          memory.state[p].is_welded = interface.pairs[p].unwelding_stage > 1;
          Vector<dim> n;
          for (int d = 0; d < dim; ++d)
            n[d] = interface.pairs[p].normal[d];
          memory.normal.push_back(n);
        }
      memory.is_removed_block.assign(blocks.blocks.size(), false);
      memory.is_surface_contact_group.assign(interface.n_groups(), false);
      memory.is_surface_contact_node.assign(surface.n_nodes(), false);
      return memory;
    }
  } // namespace



  template <int dim>
  Contact<dim>::Contact(const Scene<dim> &scene,
                        const SplitMesh<dim> &split,
                        const Blocks<dim> &blocks,
                        const Numbering<dim> &numbering,
                        const CellArrays<dim> &cells,
                        Fields<dim> &fields)
    : fields(fields)
    , surface(split, blocks, scene)
    , search(surface)
    , memory(make_memory(split, blocks, surface))
    , topology(scene, split, numbering, surface)
    , strength(topology, memory)
    , loans(topology, strength, memory)
    , nodes(topology, fields)
    , areas(topology, strength, nodes, fields, memory)
    , history(topology, strength, areas, nodes, fields, memory)
    , solver(scene, tally)
    , springs(topology, strength, nodes, solver, memory)
    , pairs(topology,
            strength,
            nodes.projection,
            solver,
            springs,
            fields,
            memory)
    , multi_pairs(topology,
                  strength,
                  cells,
                  nodes,
                  solver,
                  springs,
                  fields,
                  memory)
    , detection(search,
                topology,
                strength,
                nodes,
                areas,
                history,
                springs,
                multi_pairs,
                fields,
                memory)
    , surfaces(search,
               topology,
               strength,
               areas,
               history,
               multi_pairs,
               nodes,
               solver,
               springs,
               memory)
    , sums(search, topology, nodes, fields, memory)
    , block_motions(topology, blocks, fields, memory)
  {
    for (unsigned int p = 0; p < memory.state.size(); ++p)
      memory.state[p].is_intact =
        memory.state[p].is_welded ||
        strength.is_bonded(topology.interface.pairs[p].joint);
    keep_histories();
  }



  template <int dim>
  void
  Contact<dim>::keep_histories()
  {
    if (strength.has_memory)
      memory.pair_histories.resize(memory.state.size());
  }



  template <int dim>
  void
  Contact<dim>::solve(const ContactStep &step)
  {
    strength.weld_share = step.weld_share;
    tally.n_iterations  = 0;
    springs.begin_step(step);
    multi_pairs.estimate_tractions();
    if (step.is_large && memory.n_steps % normals_interval == 0)
      detection.refresh_normals();
    tally.n_searches += detection.update(step.step);
    nodes.gather(memory.surface_contact_nodes);
    if (memory.last_kick <= 0.)
      memory.last_kick = step.kick;
    pairs.solve(step);
    multi_pairs.solve(step);
    if (!memory.surface_contact_nodes.empty())
      surfaces.solve(step);
    memory.last_kick = step.kick;
    areas.note_openings(
      [&](const unsigned int pair) { return history.dilation_of(pair); });
    nodes.scatter(step.kick);
    if (strength.has_memory)
      history.advance(step.step);
    if (step.is_large && !memory.surface_contact_nodes.empty())
      surfaces.correct_penetration(fields, tally);
    ++memory.n_steps;
  }



  template <int dim>
  void
  Contact<dim>::begin_stage(const unsigned int number)
  {
    nodes.measure();
    loans.unweld(number);
    multi_pairs.set_up();
  }



  template <int dim>
  void
  Contact<dim>::remove_pair(const unsigned int p)
  {
    const double kick = memory.present_kick();
    const unsigned int minus =
      topology.numbering.local_node(topology.interface.pairs[p].minus);
    const unsigned int plus =
      topology.numbering.local_node(topology.interface.pairs[p].plus);
    for (int d = 0; d < dim && !memory.state[p].is_converted; ++d)
      {
        if (plus != none)
          fields.contact_force[dim * plus + d] -=
            memory.state[p].impulse[d] / kick;
        if (minus != none)
          fields.contact_force[dim * minus + d] +=
            memory.state[p].impulse[d] / kick;
      }
    for (const unsigned int node : {minus, plus})
      if (node != none)
        fields.is_in_cluster[node] = false;
    memory.state[p].is_removed = true;
    memory.state[p].impulse    = Vector<dim>{};
    memory.state[p].status     = ContactStatus::open;
  }



  template <int dim>
  void
  Contact<dim>::remove_ties(const unsigned int number)
  {
    bool is_any = false;
    for (unsigned int p = 0; p < memory.state.size(); ++p)
      if (const Pair<dim> &pair = topology.interface.pairs[p];
          pair.is_tie() && pair.unwelding_stage <= number &&
          !memory.state[p].is_removed)
        {
          remove_pair(p);
          memory.state[p].is_welded = false;
          is_any                    = true;
        }
    if (!is_any)
      return;
    multi_pairs.list_nodes();
    memory.is_search_due = true;
  }



  template <int dim>
  void
  Contact<dim>::remove_block(const unsigned int block)
  {
    memory.is_removed_block[block] = true;
    const double kick              = memory.present_kick();
    for (unsigned int p = 0; p < memory.state.size(); ++p)
      {
        const auto sides = topology.blocks_of_pair(p);
        if (!memory.state[p].is_removed &&
            (sides[0] == block || sides[1] == block))
          remove_pair(p);
      }
    const auto is_of_block = [&](const SurfaceContact<dim> &contact) {
      return contact.master_block == block ||
             surface.block_of_node[contact.slave] == block;
    };
    for (const SurfaceContact<dim> &contact : memory.contacts)
      if (is_of_block(contact))
        for (int k = 0; k < contact.point.n_nodes; ++k)
          if (nodes.local_node[contact.point.node[k]] != none)
            for (int d = 0; d < dim; ++d)
              fields
                .contact_force[dim * nodes.local_node[contact.point.node[k]] +
                               d] -=
                contact.point.weight[k] * contact.point.impulse[d] / kick;
    // another block may be taken away at the same time
    memory.contacts.erase(std::remove_if(memory.contacts.begin(),
                                         memory.contacts.end(),
                                         is_of_block),
                          memory.contacts.end());
    multi_pairs.list_nodes();
    memory.is_search_due = true;
  }



  template <int dim>
  void
  Contact<dim>::recall(const ContactMemory<dim> &past)
  {
    memory = past;
    keep_histories();
    springs.allocate();
    memory.is_search_due     = true;
    memory.next_motion_check = memory.n_steps;
    multi_pairs.list_nodes();
    multi_pairs.activate_nodes();
  }



  template <int dim>
  void
  Contact<dim>::resume(const ContactMemory<dim> &past)
  {
    recall(past);
    memory.is_search_due     = past.is_search_due;
    memory.next_motion_check = past.next_motion_check;
    detection.search_again();
  }


  template <int dim>
  std::vector<unsigned int>
  Contact<dim>::list_surface_contact_nodes() const
  {
    std::vector<unsigned int> result;
    for (const unsigned int node : memory.surface_contact_nodes)
      if (nodes.local_node[node] != none)
        result.push_back(nodes.local_node[node]);
    return result;
  }

  template class Contact<2>;
  template class Contact<3>;
} // namespace Keyblock
