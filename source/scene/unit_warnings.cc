// SPDX-License-Identifier: LGPL-2.1-or-later
// Values that look as if they were in another unit.
#include <keyblock/base/number_text.h>
#include <keyblock/law/joint_stiffness.h>
#include <keyblock/scene/unit_warnings.h>

#include <boost/algorithm/string.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace Keyblock
{
  namespace
  {
    /** Values of entries that are allowed and hardly ever meant. */
    class Doubts
    {
    public:
      /** Doubt the value of an entry between two bounds, both exclusive. */
      void
      look_at(const double value,
              const std::string &owner,
              const std::string &name,
              const double above,
              const double below,
              const std::string &unit,
              const std::string &question)
      {
        if (!(value > above && value < below))
          return;
        const std::string key = name + unit + text_of(value);
        Doubt &doubt          = doubts[key];
        if (doubt.n++ == 0)
          {
            order.push_back(key);
            doubt.sentence = "The entry '" + owner + "/" + name + "' is " +
                             text_of(value) + " " + unit;
            doubt.question = question;
          }
      }

      std::vector<std::string>
      sentences() const
      {
        std::vector<std::string> all;
        for (const std::string &key : order)
          {
            const Doubt &doubt = doubts.at(key);
            all.push_back(doubt.sentence +
                          (doubt.n > 1
                             ? ", as " + std::to_string(doubt.n - 1) +
                                 (doubt.n > 2 ? " more are" : " more is")
                             : "") +
                          ": " + doubt.question);
          }
        return all;
      }

    private:
      struct Doubt
      {
        std::string sentence, question;
        unsigned int n = 0;
      };
      std::map<std::string, Doubt> doubts; ///< by entry, unit and value
      std::vector<std::string> order;
    };

    void
    doubt_angle(Doubts &doubts,
                const double value,
                const std::string &owner,
                const std::string &name)
    {
      constexpr double least = 1.5; // [deg], nearly a right angle in radians
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
      doubts.look_at(value,
                     owner,
                     name,
                     0.,
                     least,
                     "Pa",
                     "is it in " +
                       std::string(least > 1. ? "GPa or MPa" : "MPa") +
                       "? Stresses are in pascals, 1 MPa is 1e6.");
    }

    constexpr double endless = std::numeric_limits<double>::infinity();

    constexpr double least_modulus     = 1e5;  // [Pa]
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
      constexpr double least = 50.; // [kg/m3]
      doubts.look_at(value,
                     owner,
                     "Density",
                     0.,
                     least,
                     "kg/m3",
                     "is it in t/m3 or kN/m3? " + what + " has about " +
                       std::to_string(usual) + " kg/m3.");
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
                     endless,
                     "degrees",
                     "residual angles of rock are about 20 to 40 degrees.");
      doubts.look_at(strength.value_of("JRC"),
                     owner,
                     "JRC",
                     largest_roughness,
                     endless,
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
                     endless,
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
      constexpr double largest_thickness    = 3.;  // [m]
      constexpr double least_liner_strength = 1e3; // [Pa]
      const std::string owner               = "Shotcrete/" + liner.name;
      doubt_stress(
        doubts, liner.young_modulus, owner, "Young modulus", least_modulus);
      for (const auto &[strength, name] :
           {std::make_pair(liner.shear_strength, "Shear strength"),
            std::make_pair(liner.compressive_strength, "Compressive strength"),
            std::make_pair(liner.tensile_strength, "Tensile strength")})
        doubt_stress(doubts, strength, owner, name, least_liner_strength);
      doubts.look_at(liner.thickness,
                     owner,
                     "Thickness",
                     largest_thickness,
                     endless,
                     "m",
                     "is it in mm or cm?");
      doubt_density(doubts, liner.density, owner, "Shotcrete", 2400);
    }
  } // namespace



  template <int dim>
  std::vector<std::string>
  warnings_of_units(const Scene<dim> &scene)
  {
    constexpr double least_cohesion = 1.; // [Pa]
    Doubts doubts;
    for (const auto &joint : scene.joints)
      {
        const std::string owner = "Joints/" + joint->name;
        doubt_angle(doubts, joint->friction_angle, owner, "Friction angle");
        doubt_stress(
          doubts, joint->cohesion, owner, "Cohesion", least_cohesion);
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
              doubt_stress(
                doubts, material->cohesion, owner, "Cohesion", least_cohesion);
            }
          doubt_stress(doubts,
                       material->young_modulus,
                       owner,
                       "Young modulus",
                       least_modulus);
          doubt_density(doubts, material->density, owner, "Rock", 2700);
        }
    for (const auto &bolts : scene.bolts)
      doubt_bolts(doubts, *bolts);
    for (const auto &liner : scene.liners)
      doubt_liner(doubts, *liner);
    doubt_density(doubts, scene.ground.density, "Ground", "Rock", 2700);
    doubts.look_at(scene.ground.depth,
                   "Ground",
                   "Depth",
                   largest_depth,
                   endless,
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
