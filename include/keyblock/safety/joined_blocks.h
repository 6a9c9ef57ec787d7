// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_safety_joined_blocks_h
#define keyblock_safety_joined_blocks_h

#include <keyblock/safety/block_statics.h>

#include <functional>

namespace Keyblock
{
  /** One block of several that may move as one body. */
  template <int dim>
  struct JoinedBlock
  {
    unsigned int block; ///< index
    BlockSurroundings<dim> around;
    BlockSupport<dim> support;
  };

  /** Blocks of a group; more of them cost more than they tell. */
  constexpr unsigned int most_joined_blocks = 32;

  /** Factors that differ by less are the same [-]. */
  constexpr double same_factor = 1e-9;

  /** Limit equilibrium of @p members as one body: of their faces, bolts and
   * shotcrete those towards rock and other blocks, under all of their loads,
   * and a force @p pressed on them [N]; the first one's faces by the indices
   * of its own. Rotation is left out. */
  template <int dim>
  LimitEquilibrium<dim>
  solve_as_one(const std::vector<JoinedBlock<dim>> &members,
               const bool is_passive,
               const Tensor<1, dim> &pressed = Tensor<1, dim>());

  /** Looks at a group of blocks, some of which bolts tie to others, and at its
   * limit equilibrium as one body. */
  template <int dim>
  using GroupAction =
    std::function<void(const std::vector<JoinedBlock<dim>> &members,
                       const LimitEquilibrium<dim> &limit)>;

  /** Call @p action for the groups that @p first, whose factor by itself is
   * @p factor, is in with blocks tied to it by bolts, from one block to the
   * next, or by bolts and shotcrete: with one more after the other, that with
   * which all have the least factor, until some in a row have not lowered it.
   */
  template <int dim>
  void for_each_tied_group(const Ground<dim> &ground,
                           const FreeFaces<dim> &free,
                           const Blocks<dim> &blocks,
                           const double time,
                           const BrokenSegments &broken,
                           const JoinedBlock<dim> &first,
                           const double factor,
                           const GroupAction<dim> &action);

  /** What a @p factor asks for of @p members as one body, on the free faces of
   * all; nothing if they have it. */
  template <int dim>
  SupportDemand
  find_demand_of_group(const Ground<dim> &ground,
                       const FreeFaces<dim> &free,
                       const std::vector<JoinedBlock<dim>> &members,
                       const double factor);
} // namespace Keyblock

#endif
