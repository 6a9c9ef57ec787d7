// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_mesh_mesh_marks_h
#define keyblock_mesh_mesh_marks_h

#include <keyblock/mesh/mesh.h>

#include <set>
#include <string>

// What make_mesh() marks in the generator's cells. All throw InputError where
// the scene does not fit the mesh.
namespace Keyblock
{
  /** Numbers and names of groups of a mesh file, as `1 (ore), 2`. */
  std::string list_groups(const std::set<unsigned int> &ids,
                          const GroupNames &names);

  /** Refuse scenes that name a group of outer faces that the mesh file has
   * not. */
  template <int dim>
  void check_boundary_groups(const Mesh<dim> &mesh, const Scene<dim> &scene);

  /** Mark the faces without a neighbour on the sides of the domain: of its
   * frame if it is a box or parallelepiped, else of its bounding box; and those
   * on edges of a polygon, or that a mesh file has names for. */
  template <int dim>
  void mark_boundaries(Mesh<dim> &mesh, const Scene<dim> &scene);

  /** Set the material of each cell: the last whose region holds it. */
  template <int dim>
  void mark_materials(Mesh<dim> &mesh, const Scene<dim> &scene);

  /** Set the stage in which each cell is excavated, and by which excavation. */
  template <int dim>
  void mark_excavations(Mesh<dim> &mesh, const Scene<dim> &scene);

  /** Refuse scenes in which nothing is left at some time that can deform. */
  template <int dim>
  void check_rock_is_left(const Mesh<dim> &mesh, const Scene<dim> &scene);

  /** Set the joint on which each face of the cells lies, and on which side. */
  template <int dim>
  void mark_joints(Mesh<dim> &mesh, const Scene<dim> &scene);
} // namespace Keyblock

#endif
