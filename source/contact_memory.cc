// SPDX-License-Identifier: LGPL-2.1-or-later
// What contact remembers: for checkpoints and trials of strength.
#include <keyblock/contact.h>

namespace Keyblock
{
  template <int dim>
  ContactMemory<dim>
  Contact<dim>::remember() const
  {
    ContactMemory<dim> memory;
    memory.state            = state;
    memory.normal           = normal;
    memory.is_removed_block = is_removed_block;
    memory.is_mobile_group  = is_mobile_group;
    memory.is_mobile_slot   = is_mobile_slot;
    memory.mobile_slots     = mobile_slots;
    memory.mobile_corners   = mobile_corners;
    memory.contacts         = contacts;
    memory.n_steps          = n_steps;
    memory.last_kick        = last_kick;

    memory.searched_position = searched_position;
    memory.is_search_due     = is_search_due;
    memory.next_look         = next_look;
    return memory;
  }



  template <int dim>
  void
  Contact<dim>::recall(const ContactMemory<dim> &memory)
  {
    state            = memory.state;
    normal           = memory.normal;
    is_removed_block = memory.is_removed_block;
    is_mobile_group  = memory.is_mobile_group;
    is_mobile_slot   = memory.is_mobile_slot;
    mobile_slots     = memory.mobile_slots;
    mobile_corners   = memory.mobile_corners;
    contacts         = memory.contacts;
    n_steps          = memory.n_steps;
    last_kick        = memory.last_kick;
    n_mobile         = mobile_slots.size();
    is_search_due    = true;
    next_look        = n_steps;
    list_corner_slots();
    rebuild_active_slots();
  }



  template <int dim>
  void
  Contact<dim>::resume(const ContactMemory<dim> &memory)
  {
    recall(memory);
    searched_position = memory.searched_position;
    is_search_due     = memory.is_search_due;
    next_look         = memory.next_look;
    if (!searched_position.empty())
      list_candidates();
  }

  template ContactMemory<2> Contact<2>::remember() const;
  template void Contact<2>::recall(const ContactMemory<2> &);
  template void Contact<2>::resume(const ContactMemory<2> &);
  template ContactMemory<3> Contact<3>::remember() const;
  template void Contact<3>::recall(const ContactMemory<3> &);
  template void Contact<3>::resume(const ContactMemory<3> &);
} // namespace Keyblock
