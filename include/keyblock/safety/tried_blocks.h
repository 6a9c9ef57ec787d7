// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_safety_tried_blocks_h
#define keyblock_safety_tried_blocks_h

#include <algorithm>
#include <vector>

namespace Keyblock
{
  /** The block that a trial looks at, and those whose joints it weakens with
   * its own; by index. */
  struct TriedBlocks
  {
    unsigned int block = 0;
    std::vector<unsigned int> companions;

    /** Companions carry the block along, so that it may not slip on what it
     * touches: its slip is its displacement. */
    bool is_carried = false;

    /** Factor by limit equilibrium, where that knows all that acts on the
     * block; 0: where it does not. */
    double limit = 0.;

    /** The same without in-situ stress, which pushes a block only until it has
     * made way: below it one that moves off may come to rest; 0: not known. */
    double limit_without_stress = 0.;

    /** Others that lean on these, on those, and so on: they push, and take what
     * room they get. */
    std::vector<unsigned int> row;

    /** Whether the block alone is tried at a @p factor at which it should slide
     * by limit equilibrium. */
    bool
    is_above_limit(const double factor) const
    {
      return companions.empty() && limit > 0. && factor > limit;
    }

    /** Whether the block alone moves off at a @p factor at which it should not
     * go on. */
    bool
    may_come_to_rest(const double factor) const
    {
      return companions.empty() && factor < limit_without_stress;
    }

    std::vector<unsigned int>
    all() const
    {
      std::vector<unsigned int> indices = companions;
      indices.push_back(block);
      return indices;
    }

    /** All that may move with the one that is looked at. */
    std::vector<unsigned int>
    others() const
    {
      std::vector<unsigned int> indices = companions;
      indices.insert(indices.end(), row.begin(), row.end());
      return indices;
    }

    bool
    contains(const unsigned int other) const
    {
      return other == block ||
             std::find(companions.begin(), companions.end(), other) !=
               companions.end();
    }

    /** These and @p others. */
    TriedBlocks
    with(const std::vector<unsigned int> &others) const
    {
      TriedBlocks more = *this;
      more.companions.insert(more.companions.end(),
                             others.begin(),
                             others.end());
      return more;
    }
  };
} // namespace Keyblock

#endif
