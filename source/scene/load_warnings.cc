// SPDX-License-Identifier: LGPL-2.1-or-later
// Loads and strengths that look as if they were in another unit, or upside
// down.
#include <keyblock/base/history_columns.h>
#include <keyblock/base/number_text.h>
#include <keyblock/scene/domain_outline.h>
#include <keyblock/scene/doubts.h>
#include <keyblock/scene/gravity.h>
#include <keyblock/scene/unit_warnings.h>

#include <boost/algorithm/string.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace Keyblock
{
  namespace
  {
    constexpr const char *small_units = "MPa or kPa"; // of stresses

    /** Stress below which nothing matters beside the weight of the rock [Pa]: a
     * thousandth of it, but no more than some kN/m2 in other units are. */
    template <int dim>
    double
    least_stress(const Scene<dim> &scene)
    {
      constexpr double weight = 27e3, share = 1e-3, largest = 100.;
      const double side = std::pow(std::abs(volume_of(scene.domain)), 1. / dim);
      return std::min(share * weight * side, largest);
    }

    /** The largest magnitude among components; 0 if one is no number. */
    double
    largest_component(const std::string &formula)
    {
      std::vector<std::string> components;
      boost::split(components, formula, boost::is_any_of(";"));
      double largest = 0.;
      for (const std::string &component : components)
        {
          double number = 0.;
          if (!read_number(boost::trim_copy(component), false, number))
            return 0.;
          largest = std::max(largest, std::abs(number));
        }
      return largest;
    }

    template <int dim>
    void
    doubt_initial_state(Doubts &doubts,
                        const Scene<dim> &scene,
                        const double least)
    {
      constexpr double least_gradient = 1e3; // [Pa/m]
      const auto &state               = scene.initial_state;
      const std::string owner         = "Initial state";
      doubts.look_at_stress(
        largest_component(state.stress), owner, "Stress", least, small_units);
      doubts.look_at_stress(
        state.surface_stress, owner, "Surface stress", least, small_units);
      doubts.look_at(state.vertical_stress_gradient,
                     owner,
                     "Vertical stress gradient",
                     0.,
                     least_gradient,
                     "Pa/m",
                     "is it in MPa/m or kPa/m? Rock weighs about 27000 N/m3.");
      if (scene.ground.is_given())
        return;
      const Tensor<1, dim> gravity = Gravity<dim>(scene).at(Point<dim>(), 0.);
      doubts.look_at(gravity[dim - 1],
                     owner,
                     "Gravity",
                     0.5 * gravity.norm(),
                     Doubts::endless,
                     "m/s2 along " + std::string(1, "xyz"[dim - 1]),
                     "that is upwards, and elevations, water and sides called "
                     "top are not turned with it; is " +
                       text_of(-gravity[dim - 1]) + " meant?");
    }

    /** A sentence on each history of accelerations without a unit that may be
     * in g. */
    template <int dim>
    std::vector<std::string>
    warnings_of_accelerations(const Scene<dim> &scene)
    {
      constexpr double largest_in_g = 1.5, standard = 9.80665;
      std::vector<std::string> found;
      for (const auto &support : scene.supports)
        if (support->history &&
            support->history_quantity == HistoryQuantity::acceleration)
          {
            const std::string path =
              (std::filesystem::path(scene.file).parent_path() /
               support->history_file)
                .string();
            const std::string entry =
              "Supports/" + support->name + "/History file";
            const auto titles = read_delimited_text(path, entry).header.fields;
            const bool has_unit =
              std::any_of(titles.begin() + 1, titles.end(), [](const auto &t) {
                return t.find_first_of("([") != std::string::npos;
              });
            const double peak =
              read_history(path, entry, dim, "m/s2").largest_magnitude();
            if (!has_unit && peak > 0. && peak < largest_in_g)
              found.push_back(
                "The history '" + support->history_file +
                "' names no unit and is taken as in m/s2, with at most " +
                text_of(peak, 3) + " m/s2, which is " +
                text_of(peak / standard, 2) +
                " g; name the unit in its header, as 'ax (m/s2)' or 'ax (g)'.");
          }
      return found;
    }
  } // namespace



  template <int dim>
  std::vector<std::string>
  warnings_of_loads(const Scene<dim> &scene)
  {
    constexpr double largest_pressure = 1e8; // of water 10 km deep [Pa]
    Doubts doubts;
    const double least         = least_stress(scene);
    const auto doubt_strengths = [&](const auto &one,
                                     const std::string &owner) {
      doubts.look_at_stress(
        one.cohesion, owner, "Cohesion", least, small_units);
      doubts.look_at_stress(
        one.tensile_strength, owner, "Tensile strength", least, small_units);
    };
    for (const auto &joint : scene.joints)
      {
        const std::string owner = "Joints/" + joint->name;
        doubt_strengths(*joint, owner);
        doubts.look_at(largest_component(joint->water_pressure),
                       owner,
                       "Water pressure",
                       largest_pressure,
                       Doubts::endless,
                       "Pa",
                       "no water is as deep; pressures are in pascals, 1 MPa "
                       "is 1e6.");
      }
    for (const auto &material : scene.materials)
      if (material->is_plastic())
        doubt_strengths(*material, "Materials/" + material->name);
    for (const auto &traction : scene.tractions)
      doubts.look_at_stress(largest_component(traction->expression),
                            "Tractions/" + traction->name,
                            "Traction",
                            least,
                            small_units);
    doubt_initial_state(doubts, scene, least);
    std::vector<std::string> found = doubts.sentences();
    for (const std::string &warning : warnings_of_accelerations(scene))
      found.push_back(warning);
    return found;
  }

  template std::vector<std::string> warnings_of_loads(const Scene<2> &);
  template std::vector<std::string> warnings_of_loads(const Scene<3> &);
} // namespace Keyblock
