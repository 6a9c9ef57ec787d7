// SPDX-License-Identifier: LGPL-2.1-or-later
// Which surface contacts there are now, and with which strength.
#include <keyblock/base/errors.h>
#include <keyblock/contact/surface_contacts.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace Keyblock
{
  template <int dim>
  void
  SurfaceContacts<dim>::put_masters_into(ContactPoint<dim> &point) const
  {
    const auto hangs = [&](const unsigned int node) {
      return split.is_hanging(surface.vertex_of_node[node]);
    };
    if (std::none_of(point.node.begin(),
                     point.node.begin() + point.n_nodes,
                     hangs))
      return;
    std::map<unsigned int, double> shares;
    for (int k = 0; k < point.n_nodes; ++k)
      split.for_each_carrier(surface.vertex_of_node[point.node[k]],
                             [&](const unsigned int vertex,
                                 const double share) {
                               shares[surface.node_of_vertex[vertex]] +=
                                 share * point.weight[k];
                             });
    AssertThrow(shares.size() <= point.node.size(),
                ComputationError(
                  "A contact point has more nodes than there is room for; "
                  "refine the faces on both sides of the joint alike."));
    point.n_nodes = 0;
    for (const auto &[node, weight] : shares)
      {
        point.node[point.n_nodes]     = node;
        point.weight[point.n_nodes++] = weight;
      }
  }



  template <int dim>
  double
  SurfaceContacts<dim>::find_reach(const double step) const
  {
    double speed = 0.;
    for (const unsigned int node : memory.surface_contact_nodes)
      for (int d = 0; d < dim; ++d)
        speed = std::max(speed, std::abs(nodes.velocity[dim * node + d]));
    return 2. * dim * speed * step + 1e-6 * surface.skin();
  }



  template <int dim>
  void
  SurfaceContacts<dim>::drop_removed_blocks()
  {
    if (std::find(memory.is_removed_block.begin(),
                  memory.is_removed_block.end(),
                  true) != memory.is_removed_block.end())
      memory.contacts.erase(
        std::remove_if(
          memory.contacts.begin(),
          memory.contacts.end(),
          [&](const SurfaceContact<dim> &contact) {
            return memory.is_removed_block[contact.master_block] ||
                   memory
                     .is_removed_block[surface.block_of_node[contact.slave]];
          }),
        memory.contacts.end());
  }



  template <int dim>
  void
  SurfaceContacts<dim>::take_over_impulses(
    const std::vector<SurfaceContact<dim>> &previous,
    const double scale)
  {
    const auto before = [](const SurfaceContact<dim> *a,
                           const SurfaceContact<dim> *b) {
      return a->slave < b->slave;
    };
    std::vector<const SurfaceContact<dim> *> by_slave;
    by_slave.reserve(previous.size());
    for (const SurfaceContact<dim> &contact : previous)
      by_slave.push_back(&contact);
    std::stable_sort(by_slave.begin(), by_slave.end(), before);
    for (SurfaceContact<dim> &contact : memory.contacts)
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
  }


  template <int dim>
  void
  SurfaceContacts<dim>::find_contacts(const ContactStep &step,
                                      const double reach)
  {
    const std::vector<SurfaceContact<dim>> previous = memory.contacts;
    double square                                   = 0.;
    for (const unsigned int node : memory.surface_contact_nodes)
      {
        double way = 0.;
        for (unsigned int i = dim * node; i < dim * (node + 1); ++i)
          way += (nodes.position[i] - memory.searched_position[i]) *
                 (nodes.position[i] - memory.searched_position[i]);
        square = std::max(square, way);
      }
    springs.measure_offsets();
    search.evaluate(nodes.position,
                    reach + history.largest_dilation() +
                      springs.largest_offset(),
                    std::sqrt(square),
                    memory.contacts);
    drop_removed_blocks();
    take_over_impulses(previous, step.kick / memory.last_kick);
    areas.share();
    if (strength.needs_pressure)
      areas.average_pressure(step.kick);
    for (SurfaceContact<dim> &contact : memory.contacts)
      {
        JointHistory past;
        if (strength.has_memory)
          past = history.of(contact);
        // (the offset of a spring has its dilation, without a jump where the
        // history of another face begins)
        if (!contact.is_ridge && !springs.has_spring(contact))
          contact.point.gap -= past.dilation;
        contact.point.strength = strength.of_surface(contact,
                                                     areas.of(contact),
                                                     past,
                                                     areas.pressure_at(contact),
                                                     step.kick);
      }
    springs.put_into_contacts(step.keeps_ledger &&
                              topology.numbering.communicator.is_root());
  }


  template <int dim>
  Vector<dim>
  SurfaceContacts<dim>::impulse_of_slid_pair(const SurfaceContact<dim> &contact,
                                             const double scale) const
  {
    const unsigned int g = topology.group_of_node[contact.slave];
    if (g == none)
      return {};
    const unsigned int v = surface.vertex_of_node[contact.slave];
    for (unsigned int p = interface.group_pairs_begin[g];
         p < interface.group_pairs_begin[g + 1];
         ++p)
      {
        const Pair<dim> &pair = interface.pairs[p];
        if (!memory.state[p].is_converted || pair.joint != contact.joint ||
            (pair.minus != v && pair.plus != v))
          continue;
        const double side = pair.plus == v ? 1. : -1.;
        if (side * dot<dim>(memory.normal[p], contact.point.normal) > 0.99)
          return add<dim>(Vector<dim>{}, side * scale, memory.state[p].impulse);
      }
    return {};
  }

  template void SurfaceContacts<2>::put_masters_into(ContactPoint<2> &) const;
  template double SurfaceContacts<2>::find_reach(const double) const;
  template void SurfaceContacts<2>::drop_removed_blocks();
  template void
  SurfaceContacts<2>::take_over_impulses(const std::vector<SurfaceContact<2>> &,
                                         const double);
  template void SurfaceContacts<2>::find_contacts(const ContactStep &,
                                                  const double);
  template Vector<2>
  SurfaceContacts<2>::impulse_of_slid_pair(const SurfaceContact<2> &,
                                           const double) const;
  template void SurfaceContacts<3>::put_masters_into(ContactPoint<3> &) const;
  template double SurfaceContacts<3>::find_reach(const double) const;
  template void SurfaceContacts<3>::drop_removed_blocks();
  template void
  SurfaceContacts<3>::take_over_impulses(const std::vector<SurfaceContact<3>> &,
                                         const double);
  template void SurfaceContacts<3>::find_contacts(const ContactStep &,
                                                  const double);
  template Vector<3>
  SurfaceContacts<3>::impulse_of_slid_pair(const SurfaceContact<3> &,
                                           const double) const;
} // namespace Keyblock
