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

    /** What acts on the top of a domain by 'Ground/Depth' at the start, in the
     * mean [Pa]. */
    struct TopOfGround
    {
      double load   = 0.; ///< by tractions, downwards
      double stress = 0.; ///< the vertical one, compression positive
      std::string names;  ///< of the tractions
    };

    template <int dim>
    TopOfGround
    look_at_top(const Scene<dim> &scene)
    {
      constexpr unsigned int n_along = 16;
      const InitialState<dim> &state = scene.initial_state;
      const Domain<dim> &box         = scene.domain;
      std::vector<Point<dim>> places;
      for (unsigned int i = 0; i < (dim == 2 ? n_along : n_along * n_along);
           ++i)
        {
          const unsigned int along[] = {i % n_along, i / n_along};
          Point<dim> place           = box.corner;
          for (unsigned int d = 0; d + 1 < dim; ++d)
            place[d] += (along[d] + 0.5) / n_along * box.size[d];
          place[dim - 1] += box.size[dim - 1];
          places.push_back(place);
        }
      TopOfGround top;
      const double share = 1. / places.size();
      for (const auto &traction : scene.tractions)
        {
          const bool is_all =
            std::any_of(traction->boundaries.begin(),
                        traction->boundaries.end(),
                        [](const std::string &side) {
                          return side == "top" || side == "all";
                        });
          if (traction->stage != "start" ||
              (!is_all && !traction->boundaries.empty()))
            continue;
          const Expression<dim> formula(traction->expression,
                                        dim,
                                        "Tractions/" + traction->name +
                                          "/Traction");
          std::unique_ptr<Expression<dim>> region;
          if (!traction->region.empty())
            region = std::make_unique<Expression<dim>>(
              traction->region, 1, "Tractions/" + traction->name + "/Region");
          const double before = top.load;
          for (const Point<dim> &place : places)
            if (!region || region->value(place, 0., 0) > 0.)
              top.load -= share * formula.value(place, 0., dim - 1);
          if (top.load != before)
            top.names += (top.names.empty() ? "" : ", ") + traction->name;
        }
      if (state.stress.empty())
        top.stress = state.surface_stress +
                     state.vertical_stress_gradient *
                       (state.surface_elevation - places[0][dim - 1]);
      else
        {
          const Expression<dim> stress(state.stress,
                                       dim == 2 ? 4 : 6,
                                       "Initial state/Stress");
          for (const Point<dim> &place : places)
            top.stress -= share * stress.value(place, 0., dim - 1);
        }
      return top;
    }

    /** What is to be said where the initial stress is not that of what loads
     * the top; empty: nothing. */
    template <int dim>
    std::string
    warning_of_top(const Scene<dim> &scene)
    {
      constexpr double tolerance = 0.05;
      if (!scene.ground.is_given() ||
          !scene.initial_state.measured_points.empty() ||
          scene.domain.shape != DomainShape::box ||
          scene.domain.size.size() != dim)
        return "";
      const TopOfGround top = look_at_top(scene);
      const bool is_less    = top.load < (1. - tolerance) * top.stress;
      // a load on the surface may be more than the stress that follows
      const bool is_more = !scene.initial_state.stress.empty() &&
                           top.load > (1. + tolerance) * top.stress;
      if (!(top.stress > 0.) || (!is_less && !is_more))
        return "";
      return "The initial stress at the top of the domain is " +
             text_of(1e-6 * top.stress, 4) +
             " MPa along the vertical, and what loads the top from the start" +
             (top.names.empty() ? "" : " (" + top.names + ")") + " is " +
             text_of(1e-6 * top.load, 4) +
             " MPa, so that the ground moves before anything is dug; a "
             "traction there stands in place of the overburden of "
             "'Ground/Depth': give it that, too, or a later 'Stage', with "
             "which it is added to the overburden, and 'Initial state/Stress', "
             "if it is given, the stress that the load makes.";
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
    const std::string top = warning_of_top(scene);
    if (!top.empty())
      found.push_back(top);
    return found;
  }

  template std::vector<std::string>
  warnings_of_missing_entries(const Scene<2> &);
  template std::vector<std::string>
  warnings_of_missing_entries(const Scene<3> &);
} // namespace Keyblock
