// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_scene_network_output_h
#define keyblock_scene_network_output_h

#include <keyblock/scene/scene.h>

namespace Keyblock
{
  /**
   * Write all joints of @p scene as a table that `Joints/File` can name, in the
   * grid of `Domain/Origin`, numbers exact (without an origin). Throws
   * InputError if the file cannot be written, as does the next one.
   */
  template <int dim>
  void write_joint_table(const std::string &file_name, const Scene<dim> &scene);

  /**
   * Write the joints as they are given, whole and not cut off at each other, as
   * a VTU file: discs with 32 sides, polygons, and infinite joints as far as
   * the box around @p vertices; in 2D lines. By joint: its index and the number
   * of its set, with their names, dip and dip direction [deg], friction angle
   * [deg].
   */
  template <int dim>
  void write_joint_planes(const std::string &file_name,
                          const Scene<dim> &scene,
                          const std::vector<Point<dim>> &vertices);

  /** Sets of joints as numbers, for files of results. */
  struct JointSetNumbers
  {
    std::vector<std::string> names;     ///< by number; 0: none
    std::vector<unsigned int> of_joint; ///< by index into Scene::joints
  };

  /** Number the sets as they come in the list of joints. */
  template <int dim>
  JointSetNumbers number_joint_sets(const Scene<dim> &scene);

  /** Names of things of a scene, such as Scene::joints. */
  template <typename List>
  std::vector<std::string>
  names_of(const List &things)
  {
    std::vector<std::string> names;
    names.reserve(things.size());
    for (const auto &thing : things)
      names.push_back(thing->name);
    return names;
  }
} // namespace Keyblock

#endif
