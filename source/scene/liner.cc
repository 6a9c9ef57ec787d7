// SPDX-License-Identifier: LGPL-2.1-or-later
// The entries of shotcrete, and what cannot be meant by them.
#include <keyblock/scene/liner.h>

#include <deal.II/base/parameter_handler.h>

#include <keyblock/base/expression.h>
#include <keyblock/base/number_text.h>
#include <keyblock/scene/check.h>
#include <keyblock/scene/entry_patterns.h>

#include <algorithm>

namespace Keyblock
{
  using namespace EntryPatterns;

  void
  Liner::declare(dealii::ParameterHandler &prm)
  {
    prm.add_parameter(
      "Stage",
      stage,
      "Name of the stage at whose beginning it is sprayed, "
      "together with its excavation; it is free of force then.");
    prm.add_parameter("Excavations",
                      excavations,
                      "Names of excavations on whose faces it is.");
    prm.add_parameter(
      "Parts",
      parts,
      "Parts of the excavations' faces that have it: roof, walls, floor; "
      "faces up to 45 degrees from the horizontal, across gravity, are roof "
      "or floor.",
      dealii::Patterns::List(dealii::Patterns::Selection("roof|walls|floor")));
    prm.add_parameter("Region",
                      region,
                      "Formula in x, y (z), positive where it is; empty: "
                      "everywhere on Parts.");
    prm.add_parameter("Thickness", thickness, "Thickness [m].", not_negative);
    prm.add_parameter("Shear strength",
                      shear_strength,
                      "Strength of the section that a block shears as it "
                      "leaves: along the traces of joints on the face it "
                      "bears as much times Thickness per length [Pa].",
                      not_negative);
    prm.add_parameter("Shear modulus",
                      shear_modulus,
                      "Shear modulus; it says how far a block moves before the "
                      "section bears its strength [Pa].",
                      positive);
    prm.add_parameter("Density",
                      density,
                      "Density; its weight is added to the rock's [kg/m3].",
                      not_negative);
    prm.add_parameter("Young modulus",
                      young_modulus,
                      "Young modulus of a structural liner, which carries "
                      "thrust and bends, bonded to the rock; 0: shear along "
                      "traces of joints alone [Pa].",
                      not_negative);
    prm.add_parameter("Poisson ratio",
                      poisson_ratio,
                      "Poisson ratio of a structural liner [-].",
                      dealii::Patterns::Double(0., 0.499));
    prm.add_parameter("Compressive strength",
                      compressive_strength,
                      "Uniaxial compressive strength of a structural liner; "
                      "thrust and moment are compared with it. 0: not compared "
                      "[Pa].",
                      not_negative);
    prm.add_parameter("Tensile strength",
                      tensile_strength,
                      "Tensile strength of a structural liner; thrust and "
                      "moment are compared with it. 0: not compared [Pa].",
                      not_negative);
  }



  template <int dim>
  void
  check_liners(const Scene<dim> &scene)
  {
    const auto has_name = [](const auto &list, const std::string &name) {
      return std::any_of(list.begin(), list.end(), [&](const auto &item) {
        return item->name == name;
      });
    };
    for (const auto &liner : scene.liners)
      {
        const std::string section = "Shotcrete/" + liner->name;
        require(has_name(scene.stages, liner->stage),
                "The entry '" + section + "/Stage' is '" + liner->stage +
                  "', which is not in 'Stages/Names'; name the stage at whose "
                  "beginning it is sprayed.");
        require(!liner->excavations.empty(),
                "The entry '" + section +
                  "/Excavations' is empty; name the excavations on whose faces "
                  "it is.");
        for (const std::string &name : liner->excavations)
          require(
            has_name(scene.excavations, name),
            "The entry '" + section + "/Excavations' names '" + name +
              "', which is not in 'Excavations/Names'; correct the name.");
        require(
          liner->thickness > 0.,
          "The entry '" + section +
            "/Thickness' is 0; give the thickness of the shotcrete in m.");
        require(liner->shear_strength > 0. || liner->is_structural(),
                "The entry '" + section +
                  "/Shear strength' is 0; give the strength of the section in "
                  "Pa (2e6 for 200 t/m2), or a 'Young modulus' if it is a "
                  "structural liner.");
        require(liner->is_structural() || (liner->compressive_strength == 0. &&
                                           liner->tensile_strength == 0.),
                "The entry '" + section +
                  "/Young modulus' is 0, but a compressive or tensile strength "
                  "is given; thrust and moment, which they are compared with, "
                  "need a Young modulus in Pa.");
        require(!liner->is_structural() || !scene.time_stepping.is_large(),
                "The entry '" + section + "/Young modulus' is " +
                  text_of(liner->young_modulus) +
                  ", and a structural liner needs 'Time stepping/Kinematics' = "
                  "small; change that, or set the modulus to 0 for shear along "
                  "traces of joints alone.");
        if (!liner->region.empty())
          Expression<dim>(liner->region, 1, section + "/Region");
      }
  }

  template void check_liners(const Scene<2> &);
  template void check_liners(const Scene<3> &);
} // namespace Keyblock
