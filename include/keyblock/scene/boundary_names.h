// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_scene_boundary_names_h
#define keyblock_scene_boundary_names_h

#include <keyblock/scene/scene.h>

#include <functional>
#include <string>
#include <vector>

namespace Keyblock
{
  /** Names of the sides of a domain, two per axis, the lower one first: left,
   * right, (front, back,) bottom, top. */
  template <int dim>
  const std::vector<std::string> &boundary_names();

  /** Call @p action with each name in the entries of the scene that name outer
   * boundaries, and the entry. */
  template <int dim>
  void for_each_boundary_name(
    const Scene<dim> &scene,
    const std::function<void(const std::string &name, const std::string &entry)>
      &action);

  /** Throw InputError if an entry names a boundary that there cannot be. Groups
   * of a mesh file are left to the mesh (check_boundary_groups()). */
  template <int dim>
  void check_boundary_names(const Scene<dim> &scene);
} // namespace Keyblock

#endif
