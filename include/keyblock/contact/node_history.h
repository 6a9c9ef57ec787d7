// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_contact_node_history_h
#define keyblock_contact_node_history_h

#include <keyblock/contact/state.h>

#include <algorithm>
#include <utility>

namespace Keyblock
{
  /** Where the history of a node on a joint is, or is to be inserted, in a list
   * that is sorted by node and joint. */
  template <typename Histories>
  auto
  place_of_history(Histories &histories,
                   const unsigned int node,
                   const unsigned int joint)
  {
    return std::lower_bound(histories.begin(),
                            histories.end(),
                            std::make_pair(node, joint),
                            [](const NodeHistory &entry, const auto &key) {
                              return std::make_pair(entry.node, entry.joint) <
                                     key;
                            });
  }



  /** That history; that of a node that has not slid if there is none. */
  template <typename Histories>
  JointHistory
  find_history(const Histories &histories,
               const unsigned int node,
               const unsigned int joint)
  {
    const auto place = place_of_history(histories, node, joint);
    return place != histories.end() && place->node == node &&
               place->joint == joint
             ? place->history
             : JointHistory();
  }
} // namespace Keyblock

#endif
