// SPDX-License-Identifier: LGPL-2.1-or-later
// Values that look as if they were in another unit.
#include <keyblock/base/number_text.h>
#include <keyblock/law/joint_stiffness.h>
#include <keyblock/scene/doubts.h>
#include <keyblock/scene/unit_warnings.h>

#include <boost/algorithm/string.hpp>

#include <algorithm>
#include <cmath>

namespace Keyblock
{
  namespace
  {
    void
    doubt_angle(Doubts &doubts,
                const double value,
                const std::string &owner,
                const std::string &name)
    {
      constexpr double least = 1.6; // [deg], a right angle in radians
      doubts.look_at(value,
                     owner,
                     name,
                     0.,
                     least,
                     "degrees",
                     "is it in radians? That would be " +
                       text_of(value * 180. / std::acos(-1.), 4) + " degrees.");
    }

    void
    doubt_stress(Doubts &doubts,
                 const double value,
                 const std::string &owner,
                 const std::string &name,
                 const double least)
    {
      doubts.look_at_stress(
        value, owner, name, least, least > 1. ? "GPa or MPa" : "MPa");
    }

    constexpr double least_modulus     = 1e5;  // [Pa]
    constexpr double largest_modulus   = 1e13; // [Pa]
    constexpr double least_stiffness   = 1e5;  // [Pa/m]
    constexpr double largest_depth     = 20e3; // [m]
    constexpr double least_unit_weight = 5e3;  // [N/m3]

    void
    doubt_density(Doubts &doubts,
                  const double value,
                  const std::string &owner,
                  const std::string &what,
                  const unsigned int usual)
    {
      constexpr double least = 100., largest = 1e4; // [kg/m3]
      doubts.look_at(value,
                     owner,
                     "Density",
                     0.,
                     least,
                     "kg/m3",
                     "is it in t/m3 or kN/m3? " + what + " has about " +
                       std::to_string(usual) + " kg/m3.");
      doubts.look_at(value,
                     owner,
                     "Density",
                     largest,
                     Doubts::endless,
                     "kg/m3",
                     "is it a unit weight in N/m3? " + what + " has about " +
                       std::to_string(usual) + " kg/m3.");
    }

    /** Cohesion, of which @p what has none above @p largest [Pa]. */
    void
    doubt_cohesion(Doubts &doubts,
                   const double value,
                   const std::string &owner,
                   const double largest,
                   const std::string &what)
    {
      doubts.look_at(value,
                     owner,
                     "Cohesion",
                     largest,
                     Doubts::endless,
                     "Pa",
                     "no " + what +
                       " has as much; stresses are in pascals, 1 MPa is "
                       "1e6.");
    }

    /** Horizontal over vertical stress. */
    void
    doubt_ratios(Doubts &doubts,
                 const std::vector<double> &ratios,
                 const std::string &owner,
                 const std::string &name)
    {
      constexpr double largest = 10.; // [-]
      for (const double ratio : ratios)
        doubts.look_at(ratio,
                       owner,
                       name,
                       largest,
                       Doubts::endless,
                       "[-]",
                       "no ground has so much more horizontal than vertical "
                       "stress; is " +
                         text_of(0.01 * ratio, 3) + " meant?");
    }

    void
    doubt_coefficient(Doubts &doubts,
                      const std::vector<double> &coefficient,
                      const std::string &owner)
    {
      constexpr double largest = 1.; // [-]
      double square            = 0.;
      for (const double c : coefficient)
        square += c * c;
      doubts.look_at(
        std::sqrt(square),
        owner,
        "Seismic coefficient",
        largest,
        Doubts::endless,
        "[-]",
        "as a vector; is it in m/s2? It is acceleration over 9.81 m/s2: that "
        "would be " +
          text_of(std::sqrt(square) / 9.81, 3) + ".");
    }

    void
    doubt_stiffness(Doubts &doubts,
                    const JointStiffness &stiffness,
                    const std::string &owner)
    {
      const std::string question =
        "is it in GPa/m or MPa/m? Stiffnesses are in Pa/m, 1 GPa/m is 1e9.";
      doubts.look_at(stiffness.normal,
                     owner,
                     "Normal stiffness",
                     0.,
                     least_stiffness,
                     "Pa/m",
                     question);
      doubts.look_at(stiffness.shear,
                     owner,
                     "Shear stiffness",
                     0.,
                     least_stiffness,
                     "Pa/m",
                     question);
    }

    /** What the law of a joint names, and the pressure of its water. */
    template <int dim>
    void
    doubt_strength(Doubts &doubts,
                   const Joint<dim> &joint,
                   const std::string &owner)
    {
      constexpr double largest_roughness = 20., largest_residual = 60.; // [deg]
      constexpr double least_pressure = 100.;                           // [Pa]
      const JointStrength &strength   = joint;
      const double residual = strength.value_of("Residual friction angle");
      doubt_angle(doubts, residual, owner, "Residual friction angle");
      doubts.look_at(residual,
                     owner,
                     "Residual friction angle",
                     largest_residual,
                     Doubts::endless,
                     "degrees",
                     "residual angles of rock are about 20 to 40 degrees.");
      doubts.look_at(strength.value_of("JRC"),
                     owner,
                     "JRC",
                     largest_roughness,
                     Doubts::endless,
                     "[-]",
                     "the roughest joints have 20.");
      double pressure = 0.;
      if (read_number(boost::trim_copy(joint.water_pressure), false, pressure))
        doubt_stress(doubts, pressure, owner, "Water pressure", least_pressure);
    }

    template <int dim>
    void
    doubt_bolts(Doubts &doubts, const BoltSet<dim> &bolts)
    {
      constexpr double largest_area   = 0.05; // [m2]
      constexpr double least_strength = 10e6; // of their section [Pa]
      constexpr double least_bond     = 1e3;  // [N/m]; of plates [N]
      const std::string owner         = "Bolts/" + bolts.name;
      const auto doubt_force          = [&](const double value,
                                   const std::string &name,
                                   const double least,
                                   const std::string &unit) {
        doubts.look_at(value,
                       owner,
                       name,
                       0.,
                       least,
                       unit,
                       "is it in k" + unit + "? 1 k" + unit + " is 1000.");
      };
      doubts.look_at(bolts.area,
                     owner,
                     "Area",
                     largest_area,
                     Doubts::endless,
                     "m2",
                     "is it in mm2? That would be " +
                       text_of(1e-6 * bolts.area) + " m2.");
      doubt_force(bolts.yield_force,
                  "Yield force",
                  least_strength * std::min(bolts.area, 1e-4),
                  "N");
      doubt_force(bolts.bond_strength, "Bond strength", least_bond, "N/m");
      doubt_force(bolts.plate_strength, "Plate strength", least_bond, "N");
      doubts.look_at(bolts.bond_stiffness,
                     owner,
                     "Bond stiffness",
                     0.,
                     least_stiffness,
                     "N/m/m",
                     "is it in GN/m/m or MN/m/m? 1 MN/m/m is 1e6.");
      doubt_stress(
        doubts, bolts.young_modulus, owner, "Young modulus", least_modulus);
    }

    void
    doubt_liner(Doubts &doubts, const Liner &liner)
    {
      constexpr double largest_thickness      = 3.;   // [m]
      constexpr double least_liner_strength   = 1e3;  // [Pa]
      constexpr double largest_shear_strength = 20e6; // [Pa]
      const std::string owner                 = "Shotcrete/" + liner.name;
      doubt_stress(
        doubts, liner.young_modulus, owner, "Young modulus", least_modulus);
      for (const auto &[strength, name] :
           {std::make_pair(liner.shear_strength, "Shear strength"),
            std::make_pair(liner.compressive_strength, "Compressive strength"),
            std::make_pair(liner.tensile_strength, "Tensile strength")})
        doubt_stress(doubts, strength, owner, name, least_liner_strength);
      doubts.look_at(liner.shear_strength,
                     owner,
                     "Shear strength",
                     largest_shear_strength,
                     Doubts::endless,
                     "Pa",
                     "no shotcrete has as much; stresses are in pascals, 1 MPa "
                     "is 1e6.");
      doubts.look_at(liner.thickness,
                     owner,
                     "Thickness",
                     largest_thickness,
                     Doubts::endless,
                     "m",
                     "is it in mm or cm?");
      doubt_density(doubts, liner.density, owner, "Shotcrete", 2400);
    }
  } // namespace



  template <int dim>
  std::vector<std::string>
  warnings_of_units(const Scene<dim> &scene)
  {
    constexpr double largest_unbalanced = 0.1; // [-]
    Doubts doubts;
    for (const auto &joint : scene.joints)
      {
        const std::string owner = "Joints/" + joint->name;
        doubt_angle(doubts, joint->friction_angle, owner, "Friction angle");
        doubt_cohesion(doubts, joint->cohesion, owner, 5e6, "joint");
        doubt_stiffness(doubts, JointStiffness(*joint), owner);
        doubt_strength(doubts, *joint, owner);
      }
    doubt_angle(doubts,
                scene.contact.default_friction_angle,
                "Contact",
                "Default friction angle");
    for (const auto &material : scene.materials)
      if (!material->is_rigid())
        {
          const std::string owner = "Materials/" + material->name;
          if (material->is_plastic())
            {
              doubt_angle(doubts,
                          material->friction_angle,
                          owner,
                          "Friction angle");
              doubt_cohesion(doubts, material->cohesion, owner, 1e9, "rock");
            }
          doubt_stress(doubts,
                       material->young_modulus,
                       owner,
                       "Young modulus",
                       least_modulus);
          doubts.look_at(material->young_modulus,
                         owner,
                         "Young modulus",
                         largest_modulus,
                         Doubts::endless,
                         "Pa",
                         "no rock is so stiff, and time steps are short by it; "
                         "1 GPa is 1e9.");
          doubt_density(doubts, material->density, owner, "Rock", 2700);
        }
    for (const auto &bolts : scene.bolts)
      doubt_bolts(doubts, *bolts);
    for (const auto &liner : scene.liners)
      doubt_liner(doubts, *liner);
    for (const auto &stage : scene.stages)
      {
        const std::string owner = "Stages/" + stage->name;
        doubt_coefficient(doubts, stage->seismic_coefficient, owner);
        if (!stage->is_dynamic())
          doubts.look_at(stage->unbalanced_ratio,
                         owner,
                         "Unbalanced ratio",
                         largest_unbalanced,
                         Doubts::endless,
                         "[-]",
                         "the stage ends before its rock has come to rest; "
                         "1e-3 to 1e-5 are usual.");
      }
    doubt_coefficient(doubts,
                      scene.safety.seismic_coefficient,
                      "Safety factor");
    if (scene.ground.depth > 0.)
      doubt_ratios(doubts, scene.ground.k0, "Ground", "K0");
    else
      doubt_ratios(doubts,
                   scene.initial_state.lateral_ratios,
                   "Initial state",
                   "Lateral ratios");
    doubt_density(doubts, scene.ground.density, "Ground", "Rock", 2700);
    doubts.look_at(scene.ground.depth,
                   "Ground",
                   "Depth",
                   largest_depth,
                   Doubts::endless,
                   "m",
                   "is it in mm or cm?");
    doubts.look_at(scene.water.unit_weight,
                   "Water",
                   "Unit weight",
                   0.,
                   least_unit_weight,
                   "N/m3",
                   "is it in kN/m3 or kg/m3? Water weighs about 9810 N/m3.");
    return doubts.sentences();
  }

  template std::vector<std::string> warnings_of_units(const Scene<2> &);
  template std::vector<std::string> warnings_of_units(const Scene<3> &);
} // namespace Keyblock
