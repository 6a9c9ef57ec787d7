// SPDX-License-Identifier: LGPL-2.1-or-later
// What contact remembers: for checkpoints and trials of strength.
#include <keyblock/contact/contact.h>

namespace Keyblock
{
  template <int dim>
  void
  Contact<dim>::recall(const ContactMemory<dim> &memory)
  {
    ContactMemory<dim>::operator=(memory);
    n_mobile      = mobile_slots.size();
    is_search_due = true;
    next_look     = n_steps;
    list_corner_slots();
    rebuild_active_slots();
  }



  template <int dim>
  void
  Contact<dim>::resume(const ContactMemory<dim> &memory)
  {
    recall(memory);
    is_search_due = memory.is_search_due;
    next_look     = memory.next_look;
    if (!searched_position.empty())
      list_candidates(true);
  }

  template void Contact<2>::recall(const ContactMemory<2> &);
  template void Contact<2>::resume(const ContactMemory<2> &);
  template void Contact<3>::recall(const ContactMemory<3> &);
  template void Contact<3>::resume(const ContactMemory<3> &);
} // namespace Keyblock
