// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_run_moving_blocks_h
#define keyblock_run_moving_blocks_h

#include <keyblock/run/model.h>
#include <keyblock/step/block_balance.h>

namespace Keyblock
{
  /** Whether a block moves at @p velocity [m/s] as forces drive it: its
   * @p balance leaves a notable share of its own load along that. */
  template <int dim>
  bool is_driven(const BlockBalance<dim> &balance, const Vector<dim> &velocity);

  /**
   * Whether any finite block moves off, though forces may be in balance over
   * the whole of the model: a small block weighs next to nothing beside what an
   * excavation sets free. It is out of balance by a notable share of its own
   * load, moves against the rock in the direction of what drives it, and
   * farther than loads deform it; by a large share, however slow it is; by more
   * than half, in whatever direction (collective).
   * @param n_steps in which it moves as far
   */
  template <int dim>
  bool is_any_block_moving_off(const Model<dim> &model,
                               const unsigned int n_steps);

  /** Finite blocks (by index, ascending) that have left their places in a stage
   * and lie on faces that they do not touch there, see is_caught_elsewhere()
   * (collective).
   * @param motions of all blocks since the stage began */
  template <int dim>
  std::vector<unsigned int>
  list_caught_blocks(const Model<dim> &model,
                     const std::vector<BlockMotion<dim>> &motions);
} // namespace Keyblock

#endif
