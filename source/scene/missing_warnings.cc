// SPDX-License-Identifier: LGPL-2.1-or-later
// Scenes that lack what loads the rock, or what holds it, are warned of.
#include <keyblock/base/number_text.h>
#include <keyblock/scene/given.h>
#include <keyblock/scene/gravity.h>
#include <keyblock/scene/unit_warnings.h>

#include <algorithm>

namespace Keyblock
{
  namespace
  {
    template <int dim>
    bool
    has_gravity(const Scene<dim> &scene)
    {
      const Gravity<dim> gravity(scene);
      return gravity.is_varying || gravity.at(Point<dim>(), 0.).norm() > 0.;
    }

    /** Whether anything acts on the rock, or has. */
    template <int dim>
    bool
    is_loaded(const Scene<dim> &scene)
    {
      const InitialState<dim> &state = scene.initial_state;
      return has_gravity(scene) || has_water_levels(scene) ||
             has_water_pressures(scene) || !state.stress.empty() ||
             !state.measured_points.empty() || state.has_depth_stress() ||
             state.surface_stress != 0. || !scene.tractions.empty() ||
             !scene.bolts.empty();
    }

    /** Whether blocks are judged that stand free: by factors, by a study, or by
     * the table of limit equilibrium. */
    template <int dim>
    bool
    judges_blocks(const Scene<dim> &scene)
    {
      return scene.safety.is_wanted() || !scene.study_variables.empty() ||
             (!scene.joints.empty() && !scene.excavations.empty());
    }

    template <int dim>
    bool
    is_to_rest(const Scene<dim> &scene)
    {
      return std::any_of(scene.stages.begin(),
                         scene.stages.end(),
                         [](const auto &stage) {
                           return stage->kind == StageKind::quasi_static;
                         });
    }

    /** Of stages that are to come to rest where dashpots alone hold the model
     * along some axis; empty: there are none. */
    template <int dim>
    std::string
    warning_of_drift(const Scene<dim> &scene)
    {
      if (has_rigid_material(scene))
        return "";
      for (unsigned int i = 0; i < scene.stages.size(); ++i)
        for (unsigned int d = 0; d < dim && !scene.stages[i]->is_dynamic(); ++d)
          {
            const Support<dim> *quiet = nullptr;
            bool is_held              = false;
            for (const auto &support : scene.supports)
              if (support->is_quiet() &&
                  scene.stage_number(support->stage) <= i + 2)
                quiet = support.get();
              else
                is_held = is_held || support->names_axis(d) ||
                          support->directions == SupportDirections::all ||
                          support->directions == SupportDirections::normal;
            if (quiet && !is_held)
              return "The stage '" + scene.stages[i]->name +
                     "' is to come to rest, but dashpots alone hold the model "
                     "along " +
                     "xyz"[d] + " from stage '" + quiet->stage +
                     "' on ('Supports/" + quiet->name +
                     "/Kind'), so that loads which do not balance move it as a "
                     "whole, blocks and rock, and factors are found of that; "
                     "put the stage before the shaking, or hold a side.";
          }
      return "";
    }
  } // namespace



  template <int dim>
  std::vector<std::string>
  warnings_of_missing_entries(const Scene<dim> &scene)
  {
    std::vector<std::string> found;
    const DepthGround<dim> &ground = scene.ground, none;
    if (!ground.is_given() &&
        (ground.k0 != none.k0 || ground.density != none.density ||
         ground.azimuth != none.azimuth))
      found.push_back("The section 'Ground' has entries, but not 'Depth', "
                      "without which they have no effect; give the depth of "
                      "elevation 0 below the surface, which may be 0.");
    const bool is_held = !scene.supports.empty() || has_rigid_material(scene);
    if (!is_loaded(scene) && scene.safety.is_wanted() && is_held)
      found.push_back("Nothing loads the rock, neither gravity nor stress nor "
                      "water nor a traction, so that every block is stable; "
                      "give 'Initial state/Gravity', or 'Ground/Depth'.");
    else if (!has_gravity(scene) && judges_blocks(scene))
      found.push_back(std::string("Blocks have no weight in limit equilibrium, "
                                  "trials and steps, whatever stress the rock "
                                  "is under, so that none falls or slides by "
                                  "itself; give 'Initial state/Gravity', as ") +
                      (dim == 2 ? "'0; -9.81'." : "'0; 0; -9.81'."));
    if (!is_held && has_gravity(scene) && is_to_rest(scene))
      found.push_back("Nothing holds the model, neither a support nor a rigid "
                      "material, so that it falls as a whole and comes to no "
                      "rest; name 'Supports' on its outer sides.");
    if (const std::string drift = warning_of_drift(scene); !drift.empty())
      found.push_back(drift);
    return found;
  }

  template <int dim>
  std::vector<std::string>
  warnings_of_default_rock(const Scene<dim> &scene, const SceneText &text)
  {
    const Material<dim> none;
    if (scene.materials.size() != 1 || text.gives("Materials", "Names"))
      return {};
    const Material<dim> &rock = *scene.materials[0];
    if (rock.young_modulus != none.young_modulus ||
        rock.density != none.density || rock.model != none.model)
      return {};
    return {"Neither the entry 'Materials/Names' nor a subsection of it says "
            "what the rock is: all of it is '" +
            rock.name + "', elastic, with a 'Young modulus' of " +
            text_of(rock.young_modulus / 1e9) + " GPa and a 'Density' of " +
            text_of(rock.density) + " kg/m3."};
  }

  template std::vector<std::string> warnings_of_default_rock(const Scene<2> &,
                                                             const SceneText &);
  template std::vector<std::string> warnings_of_default_rock(const Scene<3> &,
                                                             const SceneText &);
  template std::vector<std::string>
  warnings_of_missing_entries(const Scene<2> &);
  template std::vector<std::string>
  warnings_of_missing_entries(const Scene<3> &);
} // namespace Keyblock
