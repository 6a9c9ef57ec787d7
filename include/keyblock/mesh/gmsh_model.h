// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_mesh_gmsh_model_h
#define keyblock_mesh_gmsh_model_h

#include <deal.II/base/point.h>

#include <gmsh.h>
#include <keyblock/mesh/size.h>
#include <keyblock/scene/scene.h>

#include <set>
#include <vector>

namespace Keyblock
{
  /** What is left of a scene in Gmsh's current model after everything was cut
   * by everything, as lists of its entities (dimension, tag). */
  template <int dim>
  struct GmshModel
  {
    gmsh::vectorpair domain;

    /** Pieces of each joint, by index of the joint; empty if the model was
     * built without joints. */
    std::vector<gmsh::vectorpair> joints;

    /** Tags of the entities of dimension dim - 1 that bound an excavation,
     * also where a joint lies on them. */
    std::set<int> outlines;
  };

  /**
   * Build the domain of @p scene, its excavations and, if @p with_joints, its
   * joints in Gmsh's current model with OpenCASCADE, cut them by each other and
   * drop what reaches beyond the domain. Discs become polygons whose sides are
   * about @p coarsening times the wanted @p size of cells, and what is nearer
   * to something else than the @p tolerance [m] ends on it. Throws what Gmsh
   * throws (strings or std::exception).
   */
  template <int dim>
  GmshModel<dim> build_gmsh_model(const Scene<dim> &scene,
                                  const bool with_joints,
                                  const double tolerance,
                                  const MeshSize<dim> &size,
                                  const double coarsening);
} // namespace Keyblock

#endif
