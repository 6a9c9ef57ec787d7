// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_step_block_balance_h
#define keyblock_step_block_balance_h

#include <keyblock/base/communicator.h>
#include <keyblock/base/vector.h>
#include <keyblock/rock/fields.h>

namespace Keyblock
{
  /** What drives a block, and what that is to be compared with. */
  template <int dim>
  struct BlockBalance
  {
    /** Resultant of everything but damping and supports [N]. */
    Vector<dim> unbalanced_force{};

    /** Resultant of gravity and tractions, at least a small share of the
     * contact forces [N]. */
    double load = 0.;

    /** The one over the other [-]; zero without load. */
    double unbalanced_ratio() const;
  };

  /** Of the block with these local nodes (collective).
   * @param nodes of the block, those that this rank owns */
  template <int dim>
  BlockBalance<dim> measure_balance(const Fields<dim> &fields,
                                    const std::vector<unsigned int> &nodes,
                                    const Communicator &communicator);
} // namespace Keyblock

#endif
