// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_mesh_report_h
#define keyblock_mesh_report_h

#include <deal.II/base/point.h>

#include <keyblock/scene.h>

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

    /** Joints that share faces, and how much area [m^(dim-1)]. */
    struct Merged
    {
      unsigned int joint, other;
      double area;
    };
    std::vector<Merged> merged;

    /** Joints without a single face: smaller than the cells where they lie,
     * or outside the model. */
    std::vector<unsigned int> lost, outside;

    /** Pieces of rock too small for a cell that went to a neighbour. */
    unsigned int n_lost_blocks = 0;
    double largest_lost_volume = 0.; ///< [m^dim]
    Point<dim> largest_lost_place;
  };

  /** The report for people, one sentence each; nothing for other meshes. */
  template <int dim>
  void print_mesh_report(std::ostream &out,
                         const MeshReport<dim> &report,
                         const Scene<dim> &scene);
} // namespace Keyblock

#endif
