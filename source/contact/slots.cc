// SPDX-License-Identifier: LGPL-2.1-or-later
// Slots, the nodes of faces that may touch, with the same numbers on all ranks:
// their masses and supports, and their values to and from the fields.
#include <keyblock/base/mpi.h>
#include <keyblock/contact/contact.h>

namespace Keyblock
{
  template <int dim>
  void
  Contact<dim>::measure_slots()
  {
    node_of_slot.resize(search.n_slots());
    slot_projection.assign(search.n_slots(), nullptr);
    slot_inverse_mass.assign(search.n_slots(), 0.);
    slot_mass.assign(search.n_slots(), 0.);
    std::vector<double> held(search.n_slots() * dim * dim, 0.);
    for (unsigned int slot = 0; slot < search.n_slots(); ++slot)
      {
        const unsigned int node =
          numbering.local_node(search.vertex_of_slot[slot]);
        node_of_slot[slot] = node;
        if (node >= numbering.n_owned())
          continue;
        slot_inverse_mass[slot] = fields.inverse_mass[node];
        slot_mass[slot]         = fields.mass[node];
        const int support       = fields.support_of_node[node];
        if (support >= 0 && !fields.supports[support].is_fixed())
          for (unsigned int k = 0; k < fields.supports[support].n_directions;
               ++k)
            for (int d = 0; d < dim; ++d)
              for (int e = 0; e < dim; ++e)
                held[(slot * dim + d) * dim + e] +=
                  fields.supports[support].directions[k][d] *
                  fields.supports[support].directions[k][e];
      }
    sum_lists(slot_inverse_mass);
    sum_lists(slot_mass);
    sum_lists(held);

    projection_storage.resize(search.n_slots());
    for (unsigned int slot = 0; slot < search.n_slots(); ++slot)
      {
        bool is_held = false;
        for (int i = 0; i < dim * dim; ++i)
          {
            const double h              = held[slot * dim * dim + i];
            is_held                     = is_held || h != 0.;
            projection_storage[slot][i] = (i % (dim + 1) == 0 ? 1. : 0.) - h;
          }
        if (is_held)
          slot_projection[slot] = projection_storage[slot].data();
      }
    slot_nodes = {slot_velocity.data(),
                  slot_inverse_mass.data(),
                  &slot_projection};
  }



  template <int dim>
  void
  Contact<dim>::rebuild_active_slots()
  {
    std::vector<bool> is_active = is_mobile_slot;
    for (const CornerGroup &corner : corners)
      for (const unsigned int slot : corner.slots)
        if (node_of_slot[slot] != none)
          is_active[slot] = true;
    active_slots.clear();
    for (unsigned int slot = 0; slot < is_active.size(); ++slot)
      if (is_active[slot])
        active_slots.push_back(slot);
  }



  template <int dim>
  void
  Contact<dim>::gather_slots(const bool with_displacement)
  {
    const auto copy = [&](const std::vector<double> &from,
                          std::vector<double> &to) {
      for (const unsigned int slot : active_slots)
        if (node_of_slot[slot] != none)
          for (int d = 0; d < dim; ++d)
            to[dim * slot + d] = from[dim * node_of_slot[slot] + d];
      if (n_ranks() == 1 || mobile_slots.empty())
        return;
      std::vector<double> buffer(dim * mobile_slots.size(), 0.);
      for (unsigned int i = 0; i < mobile_slots.size(); ++i)
        if (node_of_slot[mobile_slots[i]] < numbering.n_owned())
          for (int d = 0; d < dim; ++d)
            buffer[dim * i + d] = from[dim * node_of_slot[mobile_slots[i]] + d];
      sum_lists(buffer);
      for (unsigned int i = 0; i < mobile_slots.size(); ++i)
        for (int d = 0; d < dim; ++d)
          to[dim * mobile_slots[i] + d] = buffer[dim * i + d];
    };
    if (active_slots.empty())
      return;
    copy(fields.velocity, slot_velocity);
    if (with_displacement)
      {
        copy(fields.old_velocity, slot_old_velocity);
        copy(fields.displacement, slot_displacement);
        for (const unsigned int slot : active_slots)
          {
            const Point<dim> &x = search.place_of_slot[slot];
            for (int d = 0; d < dim; ++d)
              slot_position[dim * slot + d] =
                x[d] + slot_displacement[dim * slot + d];
          }
      }
    for (const unsigned int slot : active_slots)
      for (int d = 0; d < dim; ++d)
        slot_impulse[dim * slot + d] = 0.;
  }



  template <int dim>
  void
  Contact<dim>::scatter_slots()
  {
    for (const unsigned int slot : active_slots)
      if (node_of_slot[slot] != none)
        for (int d = 0; d < dim; ++d)
          {
            const unsigned int dof = dim * node_of_slot[slot] + d;
            fields.velocity[dof]   = slot_velocity[dim * slot + d];
            fields.contact_force[dof] =
              slot_impulse[dim * slot + d] / last_kick;
          }
  }



  template <int dim>
  std::vector<double>
  Contact<dim>::gather_positions() const
  {
    std::vector<double> position(dim * search.n_slots(), 0.);
    for (unsigned int slot = 0; slot < search.n_slots(); ++slot)
      if (node_of_slot[slot] < numbering.n_owned())
        for (int d = 0; d < dim; ++d)
          position[dim * slot + d] =
            search.place_of_slot[slot][d] +
            fields.displacement[dim * node_of_slot[slot] + d];
    if (n_ranks() > 1)
      sum_lists(position);
    return position;
  }



  template <int dim>
  std::vector<unsigned int>
  Contact<dim>::list_mobile_nodes() const
  {
    std::vector<unsigned int> nodes;
    for (const unsigned int slot : mobile_slots)
      if (node_of_slot[slot] != none)
        nodes.push_back(node_of_slot[slot]);
    return nodes;
  }

  template void Contact<2>::measure_slots();
  template void Contact<2>::rebuild_active_slots();
  template void Contact<2>::gather_slots(const bool);
  template void Contact<2>::scatter_slots();
  template std::vector<double> Contact<2>::gather_positions() const;
  template std::vector<unsigned int> Contact<2>::list_mobile_nodes() const;
  template void Contact<3>::measure_slots();
  template void Contact<3>::rebuild_active_slots();
  template void Contact<3>::gather_slots(const bool);
  template void Contact<3>::scatter_slots();
  template std::vector<double> Contact<3>::gather_positions() const;
  template std::vector<unsigned int> Contact<3>::list_mobile_nodes() const;
} // namespace Keyblock
