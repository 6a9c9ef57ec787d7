// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_scene_given_h
#define keyblock_scene_given_h

#include <keyblock/scene/scene.h>

#include <algorithm>

// What a scene has, by its entries.
namespace Keyblock
{
  template <int dim>
  bool
  has_rigid_material(const Scene<dim> &scene)
  {
    return std::any_of(scene.materials.begin(),
                       scene.materials.end(),
                       [](const auto &material) {
                         return material->is_rigid();
                       });
  }

  /** Whether any joint has water at some time by its own formula. */
  template <int dim>
  bool
  has_water_pressures(const Scene<dim> &scene)
  {
    return std::any_of(scene.joints.begin(),
                       scene.joints.end(),
                       [](const auto &joint) {
                         return !joint->water_pressure.empty();
                       });
  }

  /** Call @p action with the text and the entry of each water level of a scene,
   * of all, of a joint or of a stage; it may be empty. */
  template <int dim, typename Action>
  void
  for_each_water_level(const Scene<dim> &scene, const Action &action)
  {
    action(scene.water.level, "Water/Level");
    for (const auto &joint : scene.joints)
      action(joint->water_level, "Joints/" + joint->name + "/Water level");
    for (const auto &stage : scene.stages)
      action(stage->water_level, "Stages/" + stage->name + "/Water level");
  }

  /** Whether any joint has water by a level. */
  template <int dim>
  bool
  has_water_levels(const Scene<dim> &scene)
  {
    bool has_level = false;
    for_each_water_level(scene,
                         [&](const std::string &text, const std::string &) {
                           has_level =
                             has_level || (!text.empty() && text != no_water);
                         });
    return has_level;
  }
} // namespace Keyblock

#endif
