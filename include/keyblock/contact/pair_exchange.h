// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_contact_pair_exchange_h
#define keyblock_contact_pair_exchange_h

#include <keyblock/contact/state.h>
#include <keyblock/contact/topology.h>

namespace Keyblock
{

  /** Pair states of all ranks, by index of the pair (collective). */
  template <int dim>
  std::vector<PairState<dim>>
  gather_pair_states(const PairTopology<dim> &topology,
                     const ContactMemory<dim> &memory);

  /** The same of what joints' laws remember of pairs. */
  template <int dim>
  std::vector<JointHistory>
  gather_pair_histories(const PairTopology<dim> &topology,
                        const ContactMemory<dim> &memory);

  /** The same of pairs' springs. */
  template <int dim>
  std::vector<SpringState<dim>>
  gather_pair_springs(const PairTopology<dim> &topology,
                      const ContactMemory<dim> &memory);
} // namespace Keyblock

#endif
