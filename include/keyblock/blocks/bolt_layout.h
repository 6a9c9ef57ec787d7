// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_blocks_bolt_layout_h
#define keyblock_blocks_bolt_layout_h

#include <keyblock/blocks/ground.h>

namespace Keyblock
{
  /**
   * All bolts of the scene, those of patterns set out on the faces that their
   * stage has laid bare, with the rock around them then. Throws InputError if a
   * bolt does not end in the rock or cannot bear its pretension there, or a
   * pattern has no face. The same on every rank.
   */
  template <int dim>
  std::vector<Bolt<dim>> lay_out_bolts(const Scene<dim> &scene,
                                       const SplitMesh<dim> &split);

  /** The same bolts, with the same nodes, in other cells of the same rock:
   * those of a mesh between planes. */
  template <int dim>
  std::vector<Bolt<dim>> lay_out_bolts_like(const std::vector<Bolt<dim>> &bolts,
                                            const Scene<dim> &scene,
                                            const SplitMesh<dim> &split);

  /** Whether the rock at a point is there at the stage of @p ground. */
  template <int dim>
  bool
  is_there(const CellPoint<dim> &point, const Ground<dim> &ground)
  {
    return point.cell != none && !ground.is_excavated(point.cell);
  }

  /** What of a bolt is left at a stage. */
  struct BoltRemains
  {
    std::vector<bool> is_held; ///< nodes: by rock
    std::vector<bool> is_cut;  ///< segments: dug with the rock around them
    double cut_length = 0.;    ///< of all of these [m]

    /** The rock that is a node's, by distances from the head: to the joint
     * between two blocks, to where the rock ends, else to the middle between
     * two nodes [m]. */
    std::vector<std::array<double, 2>> grout;

    /** Of the whole bolt in the rock, with nothing before @p free_length [m].
     */
    double grouted_length(const double free_length) const;
  };

  /**
   * Rock that is dug or taken away after a bolt was installed takes the bolt
   * with it, for good, also if it is filled again: nodes in it are held no more
   * and segments that touch it are cut.
   */
  template <int dim>
  BoltRemains find_remains(const Bolt<dim> &bolt, const Ground<dim> &ground);
} // namespace Keyblock

#endif
