// SPDX-License-Identifier: LGPL-2.1-or-later
// Loads on the top of a domain by 'Ground/Depth' that do not meet its stress.
#include <keyblock/base/number_text.h>
#include <keyblock/scene/box_sides.h>
#include <keyblock/scene/unit_warnings.h>

namespace Keyblock
{
  namespace
  {
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
      const InitialState<dim> &state       = scene.initial_state;
      const std::vector<Point<dim>> places = places_on(scene.domain, "top");
      TopOfGround top;
      const double share = 1. / places.size();
      for (const auto &traction : scene.tractions)
        {
          if (traction->stage != "start" ||
              !is_on_side(*traction, "Tractions", scene.domain, "top"))
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
        top.stress = vertical_stress_at(state, places[0][dim - 1]);
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
  } // namespace



  template <int dim>
  std::vector<std::string>
  warnings_of_ground_top(const Scene<dim> &scene)
  {
    constexpr double tolerance = 0.05;
    if (!scene.ground.is_given() ||
        !scene.initial_state.measured_points.empty() ||
        scene.domain.shape != DomainShape::box ||
        scene.domain.size.size() != dim)
      return {};
    const TopOfGround top = look_at_top(scene);
    const bool is_less    = top.load < (1. - tolerance) * top.stress;
    // a load on the surface may be more than the stress that follows
    const bool is_more = !scene.initial_state.stress.empty() &&
                         top.load > (1. + tolerance) * top.stress;
    if (!(top.stress > 0.) || (!is_less && !is_more))
      return {};
    return {"The initial stress at the top of the domain is " +
            text_of(1e-6 * top.stress, 4) +
            " MPa along the vertical, and what loads the top from the start" +
            (top.names.empty() ? "" : " (" + top.names + ")") + " is " +
            text_of(1e-6 * top.load, 4) +
            " MPa, so that the ground moves before anything is dug; a "
            "traction there stands in place of the overburden of "
            "'Ground/Depth': give it that, too, or a later 'Stage', with "
            "which it is added to the overburden, and 'Initial state/Stress', "
            "if it is given, the stress that the load makes."};
  }

  template std::vector<std::string> warnings_of_ground_top(const Scene<2> &);
  template std::vector<std::string> warnings_of_ground_top(const Scene<3> &);
} // namespace Keyblock
