// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_blocks_bolt_path_h
#define keyblock_blocks_bolt_path_h

#include <keyblock/blocks/ground.h>
#include <keyblock/mesh/cell_locator.h>

namespace Keyblock
{
  /** Shortest piece of a bolt that is told from what is beside it, over its
   * length [-]. */
  constexpr double shortest_bolt_piece = 1e-5;

  /** Length in which the force of a bolt dies away in elastic grout, by a
   * factor of e: sqrt(E A / K); infinite without grout [m]. */
  template <int dim>
  double decay_length(const BoltSet<dim> &set);

  /**
   * Find the way of a bolt through the cells of @p rock: its pieces, where it
   * goes from one block to another, and its nodes, unless it has them. These
   * are at equal distances of no more than the set's segment length; if it says
   * none, of a twentieth of the bolt, and closer at the head and where blocks
   * part if the grout is stiff. One more stands in each stretch in one block
   * that has none else. A node on the border of two cells is in that towards
   * the head, the head in that along the bolt.
   */
  template <int dim>
  void trace_bolt(const CellLocator<dim> &rock,
                  const SplitMesh<dim> &split,
                  const BoltSet<dim> &set,
                  Bolt<dim> &bolt);

  /** The first of the pieces of a @p bolt (index) that is in rock; their
   * number: none is. */
  template <int dim>
  unsigned int first_piece_in_rock(const Bolt<dim> &bolt);
} // namespace Keyblock

#endif
