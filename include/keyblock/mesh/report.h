// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_mesh_report_h
#define keyblock_mesh_report_h

#include <deal.II/base/point.h>

#include <keyblock/scene/scene.h>

#include <iosfwd>
#include <string>
#include <vector>

namespace Keyblock
{
  /** What the mesh makes of the scene's joints. Lengths in m, and over the
   * cell size that is wanted at the place [-]. Known on rank 0. */
  template <int dim>
  struct MeshReport
  {
    /** exact: joints are where the scene has them; cut: they were cut into
     * a mesh of the rest, see cut_joints(); empty: not made by Gmsh. */
    std::string way;

    /** Why joints were cut though they could have been exact; or empty. */
    std::string reason;

    double largest_shift = 0., largest_shift_in_cells = 0.;
    double percentile_99 = 0., percentile_99_in_cells = 0.;

    /** Area of the finite joints wholly in the model over what the scene gives
     * them, in the mean [-]; 1 if there are none. */
    double area_ratio = 1.;

    /** The same of those whose radius (half length, half width) is at least two
     * edges of the simplices that they were cut into. */
    double area_ratio_of_large = 1.;

    /** Joints that share faces, of which the first rules, how much area
     * [m^(dim-1)], and whether that is all of the other. */
    struct Merged
    {
      unsigned int joint, other;
      double area;
      bool is_all_of_other = false;
    };
    std::vector<Merged> merged;

    /** Joints without a single face: smaller than the cells where they lie,
     * or outside the model; of meshes that Gmsh did not make the latter. */
    std::vector<unsigned int> lost, outside;

    /** A bent joint some of whose plane parts, though they have their middle in
     * the box around the model, have not a single face. */
    struct LostParts
    {
      unsigned int joint; ///< its first plane part
      unsigned int n_lost, n_parts;
      double width; ///< of the largest lost one, about [m]
      double size;  ///< of cells that would have kept it, about [m]
    };
    std::vector<LostParts> lost_parts;

    /** Pieces of rock too small for a cell that went to a neighbour. */
    unsigned int n_lost_blocks = 0;
    double largest_lost_volume = 0.; ///< [m^dim]
    Point<dim> largest_lost_place;

    /** Those of them with a face on an excavation, in whatever order. */
    struct LostBlock
    {
      double volume; ///< [m^dim]
      Point<dim> place;
    };
    std::vector<LostBlock> lost_exposed;

    /** Rock between joints that became no block of its own. */
    struct LostRock
    {
      Point<dim> place;
      double thickness; ///< about [m]
    };
    std::vector<LostRock> lost_rock;

    /** Rock between a joint and an outline nearly parallel to it, so thin for
     * the cells that the joint was led onto the outline. */
    struct ThinRock
    {
      unsigned int joint;
      Point<dim> place;
      double thickness; ///< the least there is [m]
    };
    std::vector<ThinRock> thin_rock; ///< one at most for each joint

    /** How often the scene was meshed for its blocks. */
    unsigned int n_passes = 1;

    /** Blocks that joints closed in the mesh alone, joined to the rock again.
     */
    unsigned int n_welded = 0;
  };

  /** Whether joint @p a rules where it shares faces with joint @p b: the
   * weaker, of equal ones the first. */
  template <int dim>
  bool
  rules(const Scene<dim> &scene, const unsigned int a, const unsigned int b)
  {
    const JointStrength &first = *scene.joints[a], &second = *scene.joints[b];
    if (first.is_weaker_than(second) || second.is_weaker_than(first))
      return first.is_weaker_than(second);
    return a < b;
  }

  /** The report for people, one sentence each. */
  template <int dim>
  void print_mesh_report(std::ostream &out,
                         const MeshReport<dim> &report,
                         const Scene<dim> &scene);
} // namespace Keyblock

#endif
