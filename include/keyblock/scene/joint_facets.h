// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_scene_joint_facets_h
#define keyblock_scene_joint_facets_h

#include <keyblock/scene/scene.h>

namespace Keyblock
{
  /**
   * Put plane facets in the place of the joints of @p scene that are polylines,
   * surfaces in files (read on rank 0) or physical groups of the mesh file.
   * They are polygons called NAME_1, NAME_2, ..., have the strength of the
   * joint and name it as their surface; those of a group keep its form: they
   * are where the mesh file says. Throws InputError for what cannot be used
   * (collective).
   */
  template <int dim>
  void make_facets(const Communicator &communicator, Scene<dim> &scene);

  /** Indices of the joints that are cut together: the facets of each piece of a
   * surface, every other joint by itself; in the order of the scene. */
  template <int dim>
  std::vector<std::vector<unsigned int>>
  joints_by_surface(const Scene<dim> &scene);

  /** Bent joints whose plane parts are much smaller than the cells that the
   * scene asks for, one sentence each. */
  template <int dim>
  std::vector<std::string> warnings_of_facets(const Scene<dim> &scene);
} // namespace Keyblock

#endif
