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

  /** The same by a level, of a joint, of a stage or of all. */
  template <int dim>
  bool
  has_water_levels(const Scene<dim> &scene)
  {
    const auto is_level = [](const std::string &text) {
      return !text.empty() && text != no_water;
    };
    return is_level(scene.water.level) ||
           std::any_of(scene.joints.begin(),
                       scene.joints.end(),
                       [&](const auto &joint) {
                         return is_level(joint->water_level);
                       }) ||
           std::any_of(scene.stages.begin(),
                       scene.stages.end(),
                       [&](const auto &stage) {
                         return is_level(stage->water_level);
                       });
  }
} // namespace Keyblock

#endif
