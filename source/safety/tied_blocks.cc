// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/safety/tied_blocks.h>

namespace Keyblock
{
  template <int dim>
  TiedBlocks<dim>::TiedBlocks(const Scene<dim> &scene,
                              const SplitMesh<dim> &split,
                              const Blocks<dim> &blocks)
    : scene(scene)
    , split(split)
    , blocks(blocks)
  {}



  template <int dim>
  void
  TiedBlocks<dim>::add_neighbors(std::vector<bool> &is_marked) const
  {
    const std::vector<bool> is_first = is_marked;
    const auto add = [&](const std::array<unsigned int, 2> &tied) {
      for (unsigned int side = 0; side < 2; ++side)
        if (const unsigned int other = tied[1 - side];
            tied[side] != none && is_first[tied[side]] && other != none &&
            !blocks.blocks[other].is_infinite)
          is_marked[other] = true;
    };
    for (const Bolt<dim> &bolt : split.bolts)
      for (const BoltCrossing<dim> &crossing : bolt.crossings)
        add(crossing.block);
    for (const LaidLiner<dim> &liner : split.liners)
      for (const LinerTrace<dim> &trace : liner.traces)
        add(trace.block);
  }



  template <int dim>
  std::vector<bool>
  TiedBlocks<dim>::mark_neighbors(const TriedBlocks &tried) const
  {
    std::vector<bool> is_marked(blocks.blocks.size(), false);
    if (scene.safety.reduced_joints == ReducedJoints::all)
      for (unsigned int b = 0; b < is_marked.size(); ++b)
        is_marked[b] = !blocks.blocks[b].is_infinite;
    for (const unsigned int b : tried.all())
      is_marked[b] = true;
    add_neighbors(is_marked);
    return is_marked;
  }



  template <int dim>
  std::vector<bool>
  TiedBlocks<dim>::mark_row(const unsigned int block) const
  {
    std::vector<bool> is_marked(blocks.blocks.size(), false), before;
    is_marked[block] = true;
    while (is_marked != before)
      {
        before = is_marked;
        add_neighbors(is_marked);
      }
    return is_marked;
  }



  template <int dim>
  bool
  can_hang(const Blocks<dim> &blocks, const unsigned int block)
  {
    return block != none && !blocks.blocks[block].is_infinite &&
           !blocks.blocks[block].is_rigid;
  }



  template bool can_hang(const Blocks<2> &, const unsigned int);
  template bool can_hang(const Blocks<3> &, const unsigned int);
  template class TiedBlocks<2>;
  template class TiedBlocks<3>;
} // namespace Keyblock
