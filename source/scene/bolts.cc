// SPDX-License-Identifier: LGPL-2.1-or-later
// The entries of bolts, and what cannot be meant by them.
#include <keyblock/scene/bolts.h>

#include <deal.II/base/parameter_handler.h>

#include <keyblock/base/expression.h>
#include <keyblock/base/number_text.h>
#include <keyblock/scene/check.h>
#include <keyblock/scene/entry_patterns.h>

#include <algorithm>
#include <sstream>

namespace Keyblock
{
  using namespace EntryPatterns;



  template <int dim>
  void
  BoltSet<dim>::declare(dealii::ParameterHandler &prm)
  {
    prm.add_parameter(
      "Stage",
      stage,
      "Name of the stage at whose beginning they are installed, "
      "together with its excavation; they are free of force "
      "then, but for Pretension.");
    prm.add_parameter("Heads",
                      heads,
                      "Ends at the excavation, `x, y; x, y; ...`, one for each "
                      "single bolt [m].");
    prm.add_parameter("Ends",
                      ends,
                      "Ends within the rock, as many as Heads [m].");
    prm.add_parameter("Excavations",
                      excavations,
                      "Names of excavations on whose faces they stand as a "
                      "pattern, in place of Heads and Ends.");
    prm.add_parameter(
      "Parts",
      parts,
      "Parts of the excavations' faces with a pattern: roof, walls, floor; "
      "faces up to 45 degrees from the horizontal, across gravity, are roof "
      "or floor.",
      dealii::Patterns::List(dealii::Patterns::Selection("roof|walls|floor")));
    prm.add_parameter("Region",
                      region,
                      "Formula in x, y (z), positive where heads of the "
                      "pattern are to be; empty: everywhere.");
    prm.add_parameter("Length",
                      length,
                      "Length of the bolts of a pattern [m].",
                      not_negative);
    prm.add_parameter(
      "Spacing",
      spacing,
      "Distances of the bolts: along the section of the excavation, and along "
      "its axis [m]. Around the whole section bolts are equally far from each "
      "other, no more than this, from the crown on. In 2D the second one is "
      "out "
      "of the plane: it divides all forces, of single bolts, too.");
    prm.add_parameter("Inclination",
                      inclination,
                      "Angle of a pattern's bolts with the normal of the face, "
                      "in 2D counter-clockwise, in 3D towards Axis [deg].",
                      Double(-89., 89.));
    prm.add_parameter("Direction",
                      direction,
                      "Direction of a pattern's bolts, from the head into the "
                      "rock; zero: along the normal of the face.");
    prm.add_parameter("Axis",
                      axis,
                      "3D: direction of the excavations' axis, across which "
                      "the rings of a pattern lie; faces across it, as end "
                      "walls, get no bolts. Zero: the axis of coordinates that "
                      "the fewest of their faces look along.");
    prm.add_parameter("Area", area, "Area of the bar [m2].", not_negative);
    prm.add_parameter("Young modulus",
                      young_modulus,
                      "Young modulus of the bar [Pa].",
                      positive);
    prm.add_parameter("Yield force",
                      yield_force,
                      "Axial force at which the bar yields [N].",
                      not_negative);
    prm.add_parameter("Rupture strain",
                      rupture_strain,
                      "Strain at which the bar breaks: of a segment in grout, "
                      "of the whole length where there is none between, as in "
                      "the free length; 0: it never does [-].",
                      not_negative);
    prm.add_parameter("Pretension",
                      pretension,
                      "Axial force at the head when they are installed [N].",
                      not_negative);
    prm.add_parameter("Plate strength",
                      plate_strength,
                      "Greatest force of the plate at the head; 0: there is no "
                      "plate [N].",
                      not_negative);
    prm.add_parameter("Plate stiffness",
                      plate_stiffness,
                      "Stiffness of the plate; 0: ten times that of the first "
                      "metre of the bar [N/m].",
                      not_negative);
    prm.add_parameter("Free length",
                      free_length,
                      "Length without grout, from the head on [m].",
                      not_negative);
    prm.add_parameter("Bond stiffness",
                      bond_stiffness,
                      "Shear stiffness of the grout per length of the bolt "
                      "[N/m/m].",
                      not_negative);
    prm.add_parameter("Bond strength",
                      bond_strength,
                      "Shear strength of the grout per length of the bolt "
                      "[N/m].",
                      not_negative);
    prm.add_parameter("Dowel stiffness",
                      dowel_stiffness,
                      "Stiffness against shear at a joint that the bolt "
                      "crosses; 0: none [N/m].",
                      not_negative);
    prm.add_parameter("Dowel strength",
                      dowel_strength,
                      "Strength against shear at a joint that the bolt crosses "
                      "[N].",
                      not_negative);
    prm.add_parameter("Segment length",
                      segment_length,
                      "Length of the segments into which a bolt is divided; 0: "
                      "a twentieth of the bolt, and shorter at its head and "
                      "where it crosses joints if its grout is stiff [m].",
                      not_negative);
  }



  namespace
  {
    template <int dim>
    void
    check_place(const BoltSet<dim> &set,
                const Scene<dim> &scene,
                const std::string &section)
    {
      require(set.is_pattern() || !set.heads.empty(),
              "The section '" + section +
                "' has neither 'Heads' nor 'Excavations'; give the ends of "
                "single bolts, or the excavations that have a pattern.");
      require(!set.is_pattern() || (set.heads.empty() && set.ends.empty()),
              "The section '" + section +
                "' has both 'Heads' or 'Ends' and 'Excavations'; give either "
                "single bolts or a pattern.");
      require(set.heads.size() == set.ends.size(),
              "The entry '" + section + "/Heads' has " +
                std::to_string(set.heads.size()) + " points and '" + section +
                "/Ends' has " + std::to_string(set.ends.size()) +
                "; give as many ends as heads.");
      for (unsigned int i = 0; i < set.heads.size(); ++i)
        require(set.heads[i].distance(set.ends[i]) > 0.,
                "The entries '" + section + "/Heads' and '" + section +
                  "/Ends' name the same point for bolt " +
                  std::to_string(i + 1) + "; a bolt needs a length.");
      for (const std::string &name : set.excavations)
        require(std::any_of(scene.excavations.begin(),
                            scene.excavations.end(),
                            [&](const auto &e) { return e->name == name; }),
                "The entry '" + section + "/Excavations' names '" + name +
                  "', which is not in 'Excavations/Names'; correct the name.");
      require(!set.is_pattern() || set.length > 0.,
              "The entry '" + section + "/Length' is " + text_of(set.length) +
                "; a pattern needs the length of its bolts.");
      require(set.spacing.size() == 2 && set.spacing[0] > 0. &&
                set.spacing[1] > 0.,
              "The entry '" + section +
                "/Spacing' must be two positive numbers: along the section and "
                "along the axis.");
      if (!set.region.empty())
        Expression<dim>(set.region, 1, section + "/Region");
    }

    template <int dim>
    void
    check_strength(const BoltSet<dim> &set, const std::string &section)
    {
      require(set.area > 0.,
              "The entry '" + section +
                "/Area' is 0; give the area of the bar in m2.");
      require(set.yield_force > 0.,
              "The entry '" + section +
                "/Yield force' is 0; give the axial force at which the bar "
                "yields in N.");
      require(set.bond_strength == 0. || set.bond_stiffness > 0.,
              "The entry '" + section +
                "/Bond stiffness' is 0, but there is a bond strength; give the "
                "grout's stiffness in N/m/m.");
      require(set.bond_strength > 0. && set.bond_stiffness > 0.,
              "The section '" + section +
                "' has no 'Bond strength' with 'Bond stiffness', so that "
                "nothing holds its bolts in the rock; give both.");
      require(set.pretension <= set.plate_strength,
              "The entry '" + section + "/Pretension' is " +
                text_of(set.pretension) + " N, more than the plate bears ('" +
                section + "/Plate strength' is " + text_of(set.plate_strength) +
                " N); give a stronger plate.");
      require(set.pretension <= set.yield_force,
              "The entry '" + section + "/Pretension' is " +
                text_of(set.pretension) +
                " N, more than the bar bears ('Yield force' is " +
                text_of(set.yield_force) + " N); lower it.");
      const double rupture_force =
        set.young_modulus * set.area * set.rupture_strain;
      require(set.rupture_strain == 0. || set.pretension <= rupture_force,
              "The entry '" + section + "/Pretension' is " +
                text_of(set.pretension) +
                " N, at which the bar breaks ('Rupture strain' is reached at " +
                text_of(rupture_force) + " N); lower it.");
      require(set.dowel_strength == 0. || set.dowel_stiffness > 0.,
              "The entry '" + section +
                "/Dowel stiffness' is 0, but there is a dowel strength; give "
                "the stiffness against shear in N/m.");
    }
  } // namespace



  template <int dim>
  void
  check_bolts(const Scene<dim> &scene)
  {
    for (const auto &set : scene.bolts)
      {
        const std::string section = "Bolts/" + set->name;
        require(std::any_of(scene.stages.begin(),
                            scene.stages.end(),
                            [&](const auto &s) {
                              return s->name == set->stage;
                            }),
                "The entry '" + section + "/Stage' is '" + set->stage +
                  "', which is not in 'Stages/Names'; name the stage at whose "
                  "beginning the bolts are installed.");
        check_place(*set, scene, section);
        check_strength(*set, section);
      }
  }

  template struct BoltSet<2>;
  template struct BoltSet<3>;
  template void check_bolts(const Scene<2> &);
  template void check_bolts(const Scene<3> &);
} // namespace Keyblock
