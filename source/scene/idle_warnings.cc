// SPDX-License-Identifier: LGPL-2.1-or-later
// Entries that are allowed and have no effect beside others are warned of, and
// such as are hardly ever meant.
#include <keyblock/base/expression.h>
#include <keyblock/base/number_text.h>
#include <keyblock/scene/given.h>
#include <keyblock/scene/gravity.h>
#include <keyblock/scene/idle_entries.h>
#include <keyblock/scene/unit_warnings.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Keyblock
{
  namespace
  {
    template <int dim>
    void
    look_at_water(const Scene<dim> &scene, std::vector<std::string> &found)
    {
      const bool levels = has_water_levels(scene);
      if (!levels && scene.water.unit_weight != WaterSettings().unit_weight)
        found.push_back("The entry 'Water/Unit weight' is " +
                        text_of(scene.water.unit_weight) +
                        " N/m3, but there is no water level, so that it has no "
                        "effect; set 'Water/Level', or leave it out.");
      for (const auto &stage : scene.stages)
        if (!stage->drained_joints.empty() && !levels &&
            !has_water_pressures(scene))
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


    /** Highest elevation of the ground that the scene tells of [m], or infinity
     * if that is not known. */
    template <int dim>
    double
    surface_of_ground(const Scene<dim> &scene)
    {
      constexpr double unknown       = std::numeric_limits<double>::infinity();
      const InitialState<dim> &state = scene.initial_state;
      const Domain<dim> &domain      = scene.domain;
      double top                     = -unknown;
      if (scene.ground.is_given())
        return scene.ground.depth;
      if (!state.stress.empty() || !state.measured_points.empty() ||
          !scene.tractions.empty())
        return unknown;
      if (domain.shape == DomainShape::box && domain.size.size() == dim)
        top = domain.corner[dim - 1] + domain.size[dim - 1];
      for (const Point<dim> &corner : domain.polygon)
        top = std::max(top, corner[dim - 1]);
      if (top == -unknown || state.surface_stress != 0.)
        return unknown;
      return state.has_depth_stress() ? std::max(top, state.surface_elevation)
                                      : top;
    }



    /** Sentences on water levels above the ground. */
    template <int dim>
    std::vector<std::string>
    warnings_of_high_water(const Scene<dim> &scene)
    {
      const double surface = surface_of_ground(scene);
      std::vector<std::string> found;
      const auto look_at = [&](const std::string &level,
                               const std::string &entry) {
        if (level.empty() || level == no_water || !found.empty())
          return;
        constexpr unsigned int n_along = 8;
        const Expression<dim> height(level, 1, entry);
        double highest = -std::numeric_limits<double>::infinity();
        for (unsigned int i = 0; i <= n_along; ++i)
          {
            Point<dim> place = scene.domain.corner;
            for (unsigned int d = 0; d + 1 < dim; ++d)
              if (d < scene.domain.size.size())
                place[d] += scene.domain.size[d] * i / n_along;
            highest = std::max(highest, height.value(place, 0., 0));
          }
        if (highest > surface)
          found.push_back(
            "The entry '" + entry + "' is up to " + text_of(highest) +
            " m, above the top of the ground at " + text_of(surface) +
            " m: water presses in joints as deep as they lie "
            "below it, but not on faces of the ground; lower it, "
            "or give what stands above by 'Tractions'.");
      };
      for_each_water_level(scene, look_at);
      return found;
    }



    /** Sentences on gravity that no ground has, or across a profile. */
    template <int dim>
    std::vector<std::string>
    warnings_of_gravity(const Scene<dim> &scene)
    {
      constexpr double least = 1., largest = 30.; // [m/s2]
      const Gravity<dim> gravity(scene);
      const Tensor<1, dim> here = gravity.at(Point<dim>(), 0.);
      const double size         = here.norm();
      std::vector<std::string> found;
      if (gravity.is_varying || size == 0.)
        return found;
      const std::string entry = "The entry 'Initial state/Gravity' is '" +
                                scene.initial_state.gravity + "', ";
      if (size < least || size > largest)
        found.push_back(entry + text_of(size) +
                        " m/s2: is it in m/s2? It is an acceleration, of 9.81 "
                        "on Earth, which times 'Density' is the weight.");
      for (const auto &excavation : scene.excavations)
        if (excavation->width > 0. && excavation->height > 0. &&
            size + here[dim - 1] > 1e-3 * size)
          {
            found.push_back(entry + "not down the axis " + "xyz"[dim - 1] +
                            ", along which the excavation '" +
                            excavation->name +
                            "' stands by its shape; turn gravity, or draw the "
                            "outline by 'Vertices'.");
            break;
          }
      return found;
    }



    /** Sentences on benches that are dug before what is above them. */
    template <int dim>
    std::vector<std::string>
    warnings_of_benches(const Scene<dim> &scene)
    {
      std::vector<std::string> found;
      for (unsigned int i = 1; i < scene.excavations.size(); ++i)
        {
          const Excavation<dim> &above = *scene.excavations[i - 1],
                                &below = *scene.excavations[i];
          if (below.bench > 0 &&
              scene.stage_number(below.stage) < scene.stage_number(above.stage))
            found.push_back("The excavation '" + below.name + "' is dug in '" +
                            below.stage + "', before '" + above.name +
                            "' above it in '" + above.stage +
                            "'; give 'Bench stages' from the top down, if that "
                            "is not meant.");
        }
      return found;
    }



    /** A sentence on dips of at least three joints or sets that all look as if
     * they were in radians. */
    template <int dim>
    std::vector<std::string>
    warnings_of_dips(const Scene<dim> &scene)
    {
      constexpr double largest_dip = 1.6, largest_direction = 6.3; // [rad]
      constexpr double default_direction = 90.;                    // [deg]
      constexpr unsigned int least       = 3;
      std::string entry;
      double first     = 0.;
      unsigned int n   = 0;
      bool all_radians = true;
      const auto count = [&](const auto &plane, const std::string &section) {
        all_radians = all_radians && plane.dip < largest_dip &&
                      (dim == 2 || plane.dip_direction <= largest_direction ||
                       plane.dip_direction == default_direction);
        if (plane.dip > 0. && n++ == 0)
          {
            entry = section + '/' + plane.name + "/Dip";
            first = plane.dip;
          }
      };
      for (const auto &joint : scene.joints)
        if (joint->normal_entry.empty() && joint->form == JointForm::plane &&
            joint->surface.empty() && joint->extent != JointShape::polygon)
          count(*joint, "Joints");
      for (const auto &set : scene.joint_sets)
        if (set->is_made())
          count(*set, "Joint sets");
      if (!all_radians || n < least)
        return {};
      return {"The entry '" + entry + "' is " + text_of(first) +
              " degrees, and no dip of the scene is above 1.6: are they in "
              "radians? That would be " +
              text_of(first * 180. / std::acos(-1.), 3) + " degrees."};
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



  template <int dim>
  std::vector<std::string>
  warnings_of_mistakes(const Scene<dim> &scene)
  {
    std::vector<std::string> found;
    for (const auto &warnings : {warnings_of_high_water(scene),
                                 warnings_of_gravity(scene),
                                 warnings_of_benches(scene),
                                 warnings_of_dips(scene)})
      found.insert(found.end(), warnings.begin(), warnings.end());
    return found;
  }

  template std::vector<std::string> warnings_of_idle_entries(const Scene<2> &);
  template std::vector<std::string> warnings_of_idle_entries(const Scene<3> &);
  template std::vector<std::string> warnings_of_mistakes(const Scene<2> &);
  template std::vector<std::string> warnings_of_mistakes(const Scene<3> &);
} // namespace Keyblock
