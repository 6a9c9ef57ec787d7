// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_safety_tied_blocks_h
#define keyblock_safety_tied_blocks_h

#include <keyblock/blocks/blocks.h>
#include <keyblock/blocks/interface.h>
#include <keyblock/safety/tried_blocks.h>
#include <keyblock/scene/scene.h>

namespace Keyblock
{
  /** Which blocks bolts and shotcrete tie to others: they may hang on these.
   * Answers mark blocks by index, finite ones and those that were asked for. */
  template <int dim>
  class TiedBlocks
  {
  public:
    TiedBlocks(const Scene<dim> &scene,
               const SplitMesh<dim> &split,
               const Blocks<dim> &blocks);

    /** Those whose joints a trial weakens, and those tied to one of them. */
    std::vector<bool> mark_neighbors(const TriedBlocks &tried) const;

    /** @p block, those tied to it, those tied to these, and so on. */
    std::vector<bool> mark_row(const unsigned int block) const;

  private:
    void add_neighbors(std::vector<bool> &is_marked) const;

    const Scene<dim> &scene;
    const SplitMesh<dim> &split;
    const Blocks<dim> &blocks;
  };

  /** Whether a block (by index, or none) can move with what it hangs on. */
  template <int dim>
  bool can_hang(const Blocks<dim> &blocks, const unsigned int block);
} // namespace Keyblock

#endif
