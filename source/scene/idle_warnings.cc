// SPDX-License-Identifier: LGPL-2.1-or-later
// Entries that are allowed and have no effect beside others are warned of.
#include <keyblock/base/number_text.h>
#include <keyblock/scene/idle_entries.h>

#include <algorithm>

namespace Keyblock
{
  namespace
  {
    bool
    is_level(const std::string &text)
    {
      return !text.empty() && text != no_water;
    }

    /** Whether any joint has water at some time by its own entries; by levels
     * of the scene. */
    template <int dim>
    bool
    has_pressures(const Scene<dim> &scene)
    {
      return std::any_of(scene.joints.begin(),
                         scene.joints.end(),
                         [](const auto &joint) {
                           return !joint->water_pressure.empty();
                         });
    }

    template <int dim>
    bool
    has_levels(const Scene<dim> &scene)
    {
      return is_level(scene.water.level) ||
             std::any_of(scene.joints.begin(),
                         scene.joints.end(),
                         [](const auto &joint) {
                           return is_level(joint->water_level);
                         }) ||
             std::any_of(scene.stages.begin(),
                         scene.stages.end(),
                         [](const auto &stage) {
                           return is_level(stage->water_level);
                         });
    }

    template <int dim>
    void
    look_at_water(const Scene<dim> &scene, std::vector<std::string> &found)
    {
      const bool levels = has_levels(scene);
      if (!levels && scene.water.unit_weight != WaterSettings().unit_weight)
        found.push_back("The entry 'Water/Unit weight' is " +
                        text_of(scene.water.unit_weight) +
                        " N/m3, but there is no water level, so that it has no "
                        "effect; set 'Water/Level', or leave it out.");
      for (const auto &stage : scene.stages)
        if (!stage->drained_joints.empty() && !levels && !has_pressures(scene))
          found.push_back("The entry 'Stages/" + stage->name +
                          "/Drained joints' names '" +
                          stage->drained_joints[0] +
                          "', but no joint has water, so that it has no "
                          "effect; set 'Water/Level' or 'Water pressure' of "
                          "joints, or leave it out.");
    }

    template <int dim>
    void
    look_at_dilation(const Scene<dim> &scene, std::vector<std::string> &found)
    {
      for (const auto &joint : scene.joints)
        if (joint->value_of("Dilation slip") > 0. &&
            joint->value_of("Dilation angle") <= 0.)
          {
            found.push_back(
              "The entry 'Joints/" + joint->name + "/Dilation slip' is " +
              text_of(joint->value_of("Dilation slip")) +
              " m, but 'Dilation angle' is 0, so that it has no effect; give "
              "the angle, or leave the slip out.");
            return;
          }
    }
  } // namespace



  template <int dim>
  std::vector<std::string>
  warnings_of_idle_entries(const Scene<dim> &scene)
  {
    std::vector<std::string> found;
    for (const auto &set : scene.bolts)
      if (!set->is_pattern() && set->length > 0.)
        found.push_back("The entry 'Bolts/" + set->name + "/Length' is " +
                        text_of(set->length) +
                        " m, but 'Heads' and 'Ends' say how long the bolts "
                        "are, so that it has no effect; leave it out.");
    if (scene.safety.is_by_statics() && scene.stages.empty())
      found.push_back("The entry 'Safety factor/Method' is limit equilibrium, "
                      "which judges blocks after stages, but there is none, so "
                      "that no factor is found; name a stage in "
                      "'Stages/Names', or run with --validate, which tells "
                      "the factors at the start.");
    look_at_water(scene, found);
    look_at_dilation(scene, found);
    return found;
  }

  template std::vector<std::string> warnings_of_idle_entries(const Scene<2> &);
  template std::vector<std::string> warnings_of_idle_entries(const Scene<3> &);
} // namespace Keyblock
