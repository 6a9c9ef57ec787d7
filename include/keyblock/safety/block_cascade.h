// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_safety_block_cascade_h
#define keyblock_safety_block_cascade_h

#include <keyblock/safety/block_statics.h>
#include <keyblock/safety/once_gone.h>

#include <algorithm>

namespace Keyblock
{
  /** What limit equilibrium says of a block with a free face among the others.
   */
  template <int dim>
  struct JudgedBlock
  {
    unsigned int block; ///< index
    BlockStatics<dim> statics;

    /** The factor between neighbours that stay, or the least one when others
     * that fail have gone [-]. */
    double least_factor;

    OnceGone once_gone;

    /** Whether it has a free face only once those have gone: all above is of
     * then. */
    bool is_uncovered = false;
  };

  /**
   * judge_block() for all blocks with a free face at the stage of @p ground.
   * Those with a factor below 1 fall out, and so do those that a run took away
   * @p gone_since (by index): what rested on them is judged again without them,
   * and what they uncover, too, until no more fall. The remarks say what that
   * changes.
   */
  template <int dim>
  std::vector<JudgedBlock<dim>>
  judge_exposed_blocks(const Ground<dim> &ground,
                       const FreeFaces<dim> &free,
                       const Blocks<dim> &blocks,
                       const double time,
                       const BrokenSegments &broken        = {},
                       const std::vector<bool> &gone_since = {});

  /** Which blocks (by index) are gone from the ground. */
  template <int dim>
  std::vector<bool>
  removed_from(const Ground<dim> &ground, const std::size_t n_blocks)
  {
    return ground.is_removed && !ground.is_removed->empty()
             ? *ground.is_removed
             : std::vector<bool>(n_blocks, false);
  }

  /** What a block is at the stage of the ground. */
  template <int dim>
  BlockClass
  class_now(const Ground<dim> &ground, const Block<dim> &block)
  {
    const auto &classes = block.class_of_stage;
    return classes[std::min<std::size_t>(ground.stage_number,
                                         classes.size() - 1)];
  }

  /**
   * Add a remark to one of the blocks that judge_exposed_blocks() gave, if it
   * can move: which others would if it had gone, so that they may lean on it,
   * hidden ones, too, those that lean on these, and so on as long as they lack
   * the @p wanted factor (one if none is); and what support it needs more for
   * that if they push with all that they lack.
   */
  template <int dim>
  void note_leaning_blocks(const Ground<dim> &ground,
                           const FreeFaces<dim> &free,
                           const Blocks<dim> &blocks,
                           const double time,
                           const double wanted,
                           const std::vector<JudgedBlock<dim>> &judged,
                           JudgedBlock<dim> &below);

  /** judge_exposed_blocks() with note_leaning_blocks() for all of them. */
  template <int dim>
  std::vector<JudgedBlock<dim>>
  judge_leaning_blocks(const Ground<dim> &ground,
                       const FreeFaces<dim> &free,
                       const Blocks<dim> &blocks,
                       const double time,
                       const double wanted,
                       const std::vector<bool> &gone_since = {});

  /**
   * Ways (unit vectors, by index) that the blocks which are wanted would take
   * without support by limit equilibrium; zero: none. One with support that
   * others close in, as what hangs below it on the same bolts does, takes the
   * way that it has once those have gone that can move.
   */
  template <int dim>
  std::vector<Tensor<1, dim>>
  find_ways_without_support(const Ground<dim> &ground,
                            const FreeFaces<dim> &free,
                            const Blocks<dim> &blocks,
                            const std::vector<bool> &is_wanted,
                            const double time);

  /** Something to be done for the ground of a stage. */
  template <int dim>
  using GroundAction =
    std::function<void(const Ground<dim> &, const FreeFaces<dim> &)>;

  /** Call @p action for the ground at the start and after each stage that
   * changes anything. */
  template <int dim>
  void for_each_changed_ground(const Scene<dim> &scene,
                               const SplitMesh<dim> &split,
                               const GroundAction<dim> &action);
} // namespace Keyblock

#endif
