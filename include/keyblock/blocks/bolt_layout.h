// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_blocks_bolt_layout_h
#define keyblock_blocks_bolt_layout_h

#include <keyblock/blocks/ground.h>

namespace Keyblock
{
  /**
   * All bolts of the scene, those of patterns set out on the faces that their
   * stage has laid bare, with the rock around them then. Throws InputError if a
   * bolt does not end in the rock, or a pattern has no face. The same on every
   * rank.
   */
  template <int dim>
  std::vector<Bolt<dim>> lay_out_bolts(const Scene<dim> &scene,
                                       const SplitMesh<dim> &split);

  /** Whether the rock at a point is there at the stage of @p ground. */
  template <int dim>
  bool
  is_there(const CellPoint<dim> &point, const Ground<dim> &ground)
  {
    return point.cell != none && !ground.is_excavated(point.cell);
  }

  /** The same for each node of a bolt. */
  template <int dim>
  std::vector<bool> list_held_nodes(const Bolt<dim> &bolt,
                                    const Ground<dim> &ground);
} // namespace Keyblock

#endif
