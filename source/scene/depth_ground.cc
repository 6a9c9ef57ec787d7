// SPDX-License-Identifier: LGPL-2.1-or-later
// What follows from the depth below the surface, where a scene leaves it open:
// gravity, initial stress, rollers and overburden.
#include <deal.II/base/numbers.h>
#include <deal.II/base/parameter_handler.h>

#include <keyblock/base/expression.h>
#include <keyblock/base/number_text.h>
#include <keyblock/scene/box_sides.h>
#include <keyblock/scene/check.h>
#include <keyblock/scene/entries.h>
#include <keyblock/scene/gravity.h>
#include <keyblock/scene/scene.h>
#include <keyblock/scene/text.h>
#include <keyblock/scene/unit_warnings.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace Keyblock
{
  namespace
  {
    using Entries = std::vector<std::pair<std::string, std::string>>;

    /** The top of the domain is the surface if it is so near to it, for the
     * round-off of decimals that are added [longest side of the domain]. */
    constexpr double surface_tolerance = 1e-9;

    /** Add a named thing to the others of its section, under a name that none
     * of them has, and to the entries. */
    template <typename Item>
    void
    add_item(ParameterHandler &prm,
             const std::string &section,
             std::unique_ptr<Item> item,
             std::vector<std::unique_ptr<Item>> &items)
    {
      const std::string wanted = item->name;
      for (unsigned int n = 2;
           std::any_of(items.begin(),
                       items.end(),
                       [&](const auto &i) { return i->name == item->name; });
           ++n)
        item->name = wanted + " " + std::to_string(n);
      items.push_back(std::move(item));
      std::string names;
      for (const auto &i : items)
        names += (names.empty() ? "" : ", ") + i->name;
      set_entries(prm, section, {{"Names", names}});
      prm.enter_subsection(section);
      prm.enter_subsection(items.back()->name);
      items.back()->declare(prm);
      prm.leave_subsection();
      prm.leave_subsection();
    }

    /** Whether the initial stress has horizontal shear on the sides of a box,
     * which only a hold along them bears. */
    template <int dim>
    bool
    has_shear_beside(const Scene<dim> &scene)
    {
      constexpr double round_off = 1e-9;
      if (dim == 2)
        return false;
      const InitialState<dim> &state = scene.initial_state;
      if (!state.measured_points.empty())
        return std::find(state.stress_fields.begin(),
                         state.stress_fields.end(),
                         "shear xy") != state.stress_fields.end();
      if (state.stress.empty())
        {
          const double turn =
            2. * state.lateral_azimuth * dealii::numbers::PI / 180.;
          const double along  = state.lateral_ratios.front();
          const double across = state.lateral_ratios.back();
          return std::abs((along - across) * std::sin(turn)) >
                 round_off * std::max(std::abs(along), std::abs(across));
        }
      const Expression<dim> stress(state.stress, 6, "Initial state/Stress");
      for (const char *side : {"left", "right", "front", "back"})
        for (const Point<dim> &place : places_on(scene.domain, side))
          if (std::abs(stress.value(place, 0., 5)) >
              round_off * std::max(std::abs(stress.value(place, 0., 0)),
                                   std::abs(stress.value(place, 0., 1))))
            return true;
      return false;
    }

    /** The rock in a box at the start. */
    struct RockInBox
    {
      double density  = 0.;   ///< of most of it [kg/m3]
      bool is_uniform = true; ///< whether all of it has that
    };

    /** Places in a box, none of them on its sides. */
    template <int dim>
    std::vector<Point<dim>>
    places_in(const Domain<dim> &box)
    {
      constexpr unsigned int n_along = dim == 2 ? 64 : 24;
      std::vector<Point<dim>> places(1);
      for (unsigned int d = 0; d < dim; ++d)
        {
          std::vector<Point<dim>> next;
          for (Point<dim> place : places)
            for (unsigned int i = 0; i < n_along; ++i)
              {
                place[d] = box.corner[d] + (i + 0.5) / n_along * box.size[d];
                next.push_back(place);
              }
          places = next;
        }
      return places;
    }

    /** What fills the box by the regions of materials, of which the last one
     * that has a place counts there; bands between joints are taken for thin.
     */
    template <int dim>
    RockInBox
    find_rock(const Scene<dim> &scene)
    {
      const std::vector<Point<dim>> places = places_in(scene.domain);
      std::vector<const Material<dim> *> material_at(places.size(), nullptr);
      std::map<double, unsigned int> n_places;
      for (const auto &material : scene.materials)
        {
          const std::string &region = material->region;
          if (!material->stage.empty())
            continue;
          if (region.rfind("band ", 0) == 0 || region.rfind("id ", 0) == 0)
            {
              if (!material->is_rigid())
                n_places[material->density] += 0;
              continue;
            }
          const Expression<dim> inside(region == "all" ? "1" : region,
                                       1,
                                       "Materials/" + material->name +
                                         "/Region");
          for (unsigned int i = 0; i < places.size(); ++i)
            if (inside.value(places[i], 0., 0) > 0.)
              material_at[i] = material.get();
        }
      for (const Material<dim> *material : material_at)
        if (material && !material->is_rigid())
          ++n_places[material->density];
      RockInBox rock;
      rock.is_uniform   = n_places.size() < 2;
      unsigned int most = 0;
      for (const auto &[density, n] : n_places)
        if (n > most)
          {
            most         = n;
            rock.density = density;
          }
      return rock;
    }

    /** Put in the entries of the initial stress that @p text does not give.
     * Above the box the ground weighs @p unit_weight, in it the rock
     * @p of_rock [N/m3]. */
    template <int dim>
    void
    complete_stress(ParameterHandler &prm,
                    const SceneText &text,
                    const DepthGround<dim> &ground,
                    const double top,
                    const double unit_weight,
                    const double of_rock)
    {
      const std::string section = "Initial state";
      Entries derived = {{"Surface elevation", exact_text(ground.depth)},
                         {"Vertical stress gradient", exact_text(unit_weight)},
                         {"Lateral ratios",
                          exact_list(ground.k0, ground.k0.size())},
                         {"Lateral azimuth", exact_text(ground.azimuth)}};
      if (unit_weight != of_rock && !text.gives(section, "Surface elevation") &&
          !text.gives(section, "Vertical stress gradient") &&
          !text.gives(section, "Surface stress"))
        {
          derived[0].second = exact_text(top);
          derived[1].second = exact_text(of_rock);
          derived.emplace_back("Surface stress",
                               exact_text(unit_weight * (ground.depth - top)));
        }
      for (const auto &entry : derived)
        if (!text.gives(section, entry.first))
          set_entries(prm, section, {entry});
    }

    /** Size of gravity, which must be down the last axis, as the depth is
     * [m/s2]. */
    template <int dim>
    double
    downward_gravity(const Scene<dim> &scene)
    {
      const Tensor<1, dim> gravity = Gravity<dim>(scene).at(Point<dim>(), 0.);
      const double down            = -gravity[dim - 1];
      require(down > 0. && gravity.norm() - down <= 1e-9 * down,
              "The entry 'Initial state/Gravity' is '" +
                scene.initial_state.gravity + "', not down the axis " +
                std::string(1, "xyz"[dim - 1]) +
                ", along which 'Ground/Depth' makes stress and overburden; "
                "leave one of them out: without 'Ground', give the stress and "
                "the loads of the scene by 'Initial state' and 'Tractions'.");
      return down;
    }

    /** Count all sides of the box but its top as rock that goes on, where the
     * scene names none by itself. */
    template <int dim>
    void
    free_surface(ParameterHandler &prm, const Domain<dim> &box)
    {
      if (box.truncated_boundaries != Domain<dim>().truncated_boundaries)
        return;
      std::string below;
      for (const std::string &side : boundary_names<dim>())
        if (side != "top")
          below += (below.empty() ? "" : ", ") + side;
      set_entries(prm, "Domain", {{"Truncated boundaries", below}});
    }

    /** Put rollers on the sides and the bottom where nothing else holds. */
    template <int dim>
    void
    complete_supports(ParameterHandler &prm, Scene<dim> &scene)
    {
      std::vector<std::string> free;
      for (const std::string &side : boundary_names<dim>())
        if (side != "top" && std::none_of(scene.supports.begin(),
                                          scene.supports.end(),
                                          [&](const auto &support) {
                                            return is_on_side(*support,
                                                              "Supports",
                                                              scene.domain,
                                                              side);
                                          }))
          free.push_back(side);
      for (const bool is_bottom : {true, false})
        {
          auto support        = std::make_unique<Support<dim>>();
          support->name       = is_bottom ? "ground below" : "ground beside";
          support->directions = !is_bottom && has_shear_beside(scene)
                                  ? SupportDirections::xy
                                  : SupportDirections::normal;
          for (const std::string &side : free)
            if ((side == "bottom") == is_bottom)
              support->boundaries.push_back(side);
          if (!support->boundaries.empty())
            add_item(prm, "Supports", std::move(support), scene.supports);
        }
    }
  } // namespace



  template <int dim>
  void
  Scene<dim>::complete_ground(const SceneText &text)
  {
    if (!ground.is_given())
      return;
    require(domain.shape != DomainShape::box || !domain.size.empty(),
            "The entry 'Domain/Size' is missing: 'Ground/Depth' puts rollers "
            "and overburden on the sides of the box; give its lengths along "
            "the axes (without them only a rectangle, horseshoe or cavern in "
            "'Excavations' says how large the domain is).");
    require(domain.shape == DomainShape::box && domain.size.size() == dim,
            "The entry 'Ground/Depth' needs a domain that is a box, on which "
            "rollers and overburden stand; set 'Domain/Shape' to box, or leave "
            "'Ground' out.");
    double top = domain.corner[dim - 1] + domain.size[dim - 1];
    const bool is_at_surface =
      std::abs(top - ground.depth) <=
      surface_tolerance *
        *std::max_element(domain.size.begin(), domain.size.end());
    if (is_at_surface)
      {
        top = ground.depth;
        free_surface(*prm, domain);
      }
    require(top <= ground.depth,
            "The domain reaches up to " + text_of(top) +
              " m, above the surface, which the entry 'Ground/Depth' puts at " +
              text_of(ground.depth) +
              " m above elevation 0; lower the domain, or raise the depth.");
    const std::string none_across = dim == 2 ? "0; " : "0; 0; ";
    if (initial_state.gravity.empty())
      set_entries(*prm,
                  "Initial state",
                  {{"Gravity",
                    none_across + "-" + exact_text(standard_gravity)}});
    const RockInBox rock = find_rock(*this);
    const double density = ground.density > 0. ? ground.density : rock.density;
    const double gravity = downward_gravity(*this);
    const double unit_weight = density * gravity;
    double pressure          = unit_weight * (ground.depth - top);
    if (initial_state.stress.empty() && initial_state.measured_points.empty())
      {
        complete_stress(
          *prm, text, ground, top, unit_weight, rock.density * gravity);
        pressure = vertical_stress_at(initial_state, top);
      }
    complete_supports(*prm, *this);
    const bool is_loaded =
      std::any_of(tractions.begin(), tractions.end(), [&](const auto &load) {
        return load->stage == "start" &&
               is_on_side(*load, "Tractions", domain, "top");
      });
    if (!is_loaded && pressure > 0.)
      {
        auto overburden        = std::make_unique<Traction<dim>>();
        overburden->name       = "overburden";
        overburden->boundaries = {"top"};
        overburden->expression = none_across + exact_text(-pressure);
        add_item(*prm, "Tractions", std::move(overburden), tractions);
      }
  }

  template <int dim>
  std::vector<std::string>
  warnings_of_ground(const Scene<dim> &scene)
  {
    const InitialState<dim> &state = scene.initial_state;
    if (!scene.ground.is_given() || state.vertical_stress_gradient <= 0. ||
        !state.stress.empty() || !state.measured_points.empty() ||
        state.equilibrium != InitialEquilibrium::none ||
        find_rock(scene).is_uniform)
      return {};
    const double gravity = downward_gravity(scene);
    return {
      "The initial stress of 'Ground/Depth' grows with depth as of rock "
      "of " +
      text_of(state.vertical_stress_gradient / gravity) +
      " kg/m3, and 'Materials' has rock of another density, which moves "
      "before anything is dug; set 'Initial state/Equilibrium' to static, "
      "which brings stress and weight into balance."};
  }

  template std::vector<std::string> warnings_of_ground(const Scene<2> &);
  template std::vector<std::string> warnings_of_ground(const Scene<3> &);
  template void Scene<2>::complete_ground(const SceneText &);
  template void Scene<3>::complete_ground(const SceneText &);
} // namespace Keyblock
