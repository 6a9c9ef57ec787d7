// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_safety_hanging_group_h
#define keyblock_safety_hanging_group_h

#include <keyblock/safety/block_statics.h>

namespace Keyblock
{
  /** A block that moves as one body with others, across shotcrete or bolts
   * that hold none of them against the rest. */
  template <int dim>
  struct HangingGroup
  {
    std::vector<unsigned int> others; ///< by index, without the block itself

    /** Of all together; of the faces those of the block alone, by the indices
     * of its own. Nothing (factor NaN) if it is no worse off with them. */
    LimitEquilibrium<dim> limit;

    bool is_by_bolts     = false;
    bool is_by_shotcrete = false;
  };

  /**
   * The group in which @p block (index) has the least factor less than that of
   * @p statics, which holds what is around it and its support: with one more
   * block after the other that the same shotcrete is sprayed on and that would
   * move without support at less than that factor, or with those of
   * for_each_tied_group(). Rotation is left out.
   */
  template <int dim>
  HangingGroup<dim> find_hanging_group(const Ground<dim> &ground,
                                       const FreeFaces<dim> &free,
                                       const Blocks<dim> &blocks,
                                       const unsigned int block,
                                       const double time,
                                       const BrokenSegments &broken,
                                       const BlockStatics<dim> &statics);

  /** What @p factor asks for of @p block (index) with what is around it and its
   * support in @p statics, but for the shotcrete on traces whose other side is
   * a block that moves without support at less than that factor, and has to be
   * held, too; of that the greatest share that the block needs by itself or in
   * one of the groups of find_hanging_group(), where each block of the group
   * gets the same share of its own. Of groups tied by bolts that lack the
   * factor it is the most that one of them needs as one body, if that is more;
   * numbers of bolts are enough for all of them. Nothing if it and they have
   * the factor.
   */
  template <int dim>
  SupportDemand find_unshared_demand(const Ground<dim> &ground,
                                     const FreeFaces<dim> &free,
                                     const Blocks<dim> &blocks,
                                     const unsigned int block,
                                     const double time,
                                     const double factor,
                                     const BlockStatics<dim> &statics);
} // namespace Keyblock

#endif
