// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_mesh_joint_cut_h
#define keyblock_mesh_joint_cut_h

#include <keyblock/mesh/report.h>
#include <keyblock/mesh/simplex_mesh.h>

namespace Keyblock
{
  /**
   * Cut all joints of @p scene into @p mesh, whose facets on the outlines of
   * domain and excavations are marked, and mend the cells.
   *
   * On which side of a joint a vertex lies is decided once: vertices nearer
   * than @p snap times the target size are moved onto the joint, if that turns
   * no cell bad, or else only declared to lie on it. Edges between the two
   * sides are bisected; the joint is what then separates cells of different
   * sides. No geometry is asked after that, so this cannot fail. In return
   * joints move by up to a part of the target size, pieces thinner than that
   * vanish, and rims are staircases (a joint that ends on another surface
   * closes against it). @p coarsening is the target size over the size of the
   * cells that the simplices will be cut into. Returns what was simplified.
   */
  template <int dim>
  MeshReport<dim> cut_joints(SimplexMesh<dim> &mesh,
                             const Scene<dim> &scene,
                             const double snap,
                             const double coarsening);
} // namespace Keyblock

#endif
