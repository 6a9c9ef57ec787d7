// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_blocks_bolt_layout_h
#define keyblock_blocks_bolt_layout_h

#include <keyblock/blocks/ground.h>
#include <keyblock/mesh/cell_locator.h>

namespace Keyblock
{
  /**
   * All bolts of the scene, those of patterns set out on the faces that their
   * stage has laid bare. Throws InputError if a bolt has no end in the rock, or
   * a pattern no face. The same on every rank.
   */
  template <int dim>
  std::vector<Bolt<dim>> lay_out_bolts(const Scene<dim> &scene,
                                       const SplitMesh<dim> &split);

  /** The cells that are there at the stage of @p ground. */
  template <int dim>
  CellLocator<dim> locate_rock(const Ground<dim> &ground);
} // namespace Keyblock

#endif
