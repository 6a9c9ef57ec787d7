// SPDX-License-Identifier: LGPL-2.1-or-later
// Blocks that a trial moves, and those that support ties to them.
#include <keyblock/safety/strength_trial.h>
#include <keyblock/step/block_balance.h>

#include <algorithm>

namespace Keyblock
{
  namespace
  {
    /** Add those that support ties to a block of @p is_wanted: they may hang on
     * it. */
    template <int dim>
    void
    add_tied_blocks(const SplitMesh<dim> &split,
                    const Blocks<dim> &blocks,
                    std::vector<bool> &is_wanted)
    {
      const std::vector<bool> is_tried = is_wanted;
      const auto add = [&](const std::array<unsigned int, 2> &tied) {
        for (unsigned int side = 0; side < 2; ++side)
          if (const unsigned int other = tied[1 - side];
              tied[side] != none && is_tried[tied[side]] && other != none &&
              !blocks.blocks[other].is_infinite &&
              !blocks.blocks[other].is_rigid)
            is_wanted[other] = true;
      };
      for (const Bolt<dim> &bolt : split.bolts)
        for (const BoltCrossing<dim> &crossing : bolt.crossings)
          add(crossing.block);
      for (const LaidLiner<dim> &liner : split.liners)
        for (const LinerTrace<dim> &trace : liner.traces)
          add(trace.block);
    }
  } // namespace



  template <int dim>
  std::vector<bool>
  StrengthTrials<dim>::mark_tied_blocks(const unsigned int block) const
  {
    std::vector<bool> is_marked(blocks.blocks.size(), false);
    if (scene.safety.reduced_joints == ReducedJoints::all)
      for (unsigned int b = 0; b < is_marked.size(); ++b)
        is_marked[b] =
          !blocks.blocks[b].is_infinite && !blocks.blocks[b].is_rigid;
    is_marked[block] = true;
    for (const unsigned int b : companions)
      is_marked[b] = true;
    add_tied_blocks(split, blocks, is_marked);
    return is_marked;
  }



  template <int dim>
  double
  StrengthTrials<dim>::unbalanced_with_tied(const unsigned int block,
                                            const double own) const
  {
    std::vector<bool> is_tied(blocks.blocks.size(), false), before;
    is_tied[block] = true;
    while (is_tied != before)
      {
        before = is_tied;
        add_tied_blocks(split, blocks, is_tied);
      }
    double largest = own;
    for (unsigned int b = 0; b < is_tied.size(); ++b)
      if (is_tied[b] && b != block &&
          !run.conditions.active_cells.is_removed_block(b))
        largest =
          std::max(largest,
                   measure_balance(run.fields, nodes_of_block[b], communicator)
                     .unbalanced_ratio());
    return largest;
  }



  template <int dim>
  SupportState<dim>
  StrengthTrials<dim>::support_of(const unsigned int block) const
  {
    return measure_support(run.conditions.elements,
                           run.fields,
                           nodes_of_block,
                           mark_tied_blocks(block),
                           communicator);
  }

  template std::vector<bool>
  StrengthTrials<2>::mark_tied_blocks(const unsigned int) const;
  template std::vector<bool>
  StrengthTrials<3>::mark_tied_blocks(const unsigned int) const;
  template double StrengthTrials<2>::unbalanced_with_tied(const unsigned int,
                                                          const double) const;
  template double StrengthTrials<3>::unbalanced_with_tied(const unsigned int,
                                                          const double) const;
  template SupportState<2>
  StrengthTrials<2>::support_of(const unsigned int) const;
  template SupportState<3>
  StrengthTrials<3>::support_of(const unsigned int) const;
} // namespace Keyblock
