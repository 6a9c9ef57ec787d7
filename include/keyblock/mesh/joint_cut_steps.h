// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_mesh_joint_cut_steps_h
#define keyblock_mesh_joint_cut_steps_h

#include <keyblock/mesh/joint_sheet.h>
#include <keyblock/mesh/report.h>
#include <keyblock/mesh/simplex_mesh.h>
#include <keyblock/mesh/snap_distance.h>

#include <vector>

namespace Keyblock
{
  /** All joints of a scene, those that are cut as a whole together. */
  template <int dim>
  struct JointSheets
  {
    std::vector<std::unique_ptr<const JointSheet<dim>>> sheets;
    std::vector<unsigned int> sheet_of_joint; ///< by index of the joint

    const JointSheet<dim> &
    of_joint(const unsigned int joint) const
    {
      return *sheets[sheet_of_joint[joint]];
    }
  };

  // The steps of cut_joints(). All lengths over the target size.

  /** How far a joint may end before another surface and still close against
   * it. */
  constexpr double closing = 0.35;

  /** Cut one joint, plane or bent, into @p mesh: move vertices nearer than
   * @p snap onto it, bisect the edges that it crosses, mark the facets between
   * its two sides. The surface of its facet i is @p surface + i of
   * SimplexMesh::surfaces. Rock that is lost beside an outline is added to
   * @p report. */
  template <int dim>
  void insert_joint(SimplexMesh<dim> &mesh,
                    const unsigned int surface,
                    const JointSheet<dim> &sheet,
                    const SnapDistance<dim> &snap,
                    MeshReport<dim> &report);

  /**
   * Drop what cuts beyond the joints' rims. A joint falls into patches between
   * other surfaces: a patch mostly outside (a flap behind the surface that the
   * joint ends on) goes as a whole, unless none is larger inside; of the others
   * each facet stays whose centre is inside, and beside another surface also
   * those that close a small gap. Ends that touch a joint in the mesh only,
   * which they would meet farther away than that gap, are parted from it.
   * @p sheets: of all joints.
   */
  template <int dim>
  void trim_joints(SimplexMesh<dim> &mesh, const JointSheets<dim> &sheets);

  /** Let pieces below a part of a cell join the largest of the neighbours with
   * which they share much area of joints, until there are none; they are
   * counted in @p report. */
  template <int dim>
  void dissolve_crumbs(SimplexMesh<dim> &mesh, MeshReport<dim> &report);

  /** Pieces of rock that moved faces have changed. */
  template <int dim>
  struct ChangedPieces
  {
    unsigned int n = 0;

    /** Their vertices on joints, with the target size there [m]. */
    typename SnapDistance<dim>::Places vertices;
  };

  /** Vertices on the joints of pieces that may fall out of an outline: all at
   * one but those inside excavations and large ones at the model's outer faces.
   */
  template <int dim>
  std::vector<unsigned int> list_block_vertices(const SimplexMesh<dim> &mesh,
                                                const Scene<dim> &scene);

  /**
   * Put the faces of pieces at an outline back into the planes of their joints,
   * where leaving these has changed the volume or the shape of a piece, as far
   * as the quality of cells allows: those of list_block_vertices().
   */
  template <int dim>
  ChangedPieces<dim> straighten_pieces(SimplexMesh<dim> &mesh,
                                       const Scene<dim> &scene);
} // namespace Keyblock

#endif
