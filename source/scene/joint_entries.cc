// SPDX-License-Identifier: LGPL-2.1-or-later
// Every entry of joints, their table and their sets.
#include <keyblock/scene/choice_patterns.h>
#include <keyblock/scene/entry_patterns.h>
#include <keyblock/scene/scene.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/patterns.h>

#include <limits>

namespace dealii::Patterns::Tools
{
  template <>
  struct Convert<Keyblock::JointForm>
    : Keyblock::ChoiceConversion<Keyblock::JointForm>
  {};
  template <>
  struct Convert<Keyblock::JointShape>
    : Keyblock::ChoiceConversion<Keyblock::JointShape>
  {};
  template <>
  struct Convert<Keyblock::SpacingDistribution>
    : Keyblock::ChoiceConversion<Keyblock::SpacingDistribution>
  {};
  template <>
  struct Convert<Keyblock::RadiusDistribution>
    : Keyblock::ChoiceConversion<Keyblock::RadiusDistribution>
  {};
} // namespace dealii::Patterns::Tools

namespace Keyblock
{
  using namespace EntryPatterns;



  void
  JointNetwork::declare(ParameterHandler &prm)
  {
    prm.add_parameter(
      "File",
      file,
      "Table of more joints, relative to the scene file: CSV with a header "
      "and one joint a row. Columns: name, set; dip and dip direction, or "
      "strike and dip (dip direction = strike + 90), or trend and plunge of "
      "the pole, or normal x, y, z; x, y, z (elevation is z, in 2D y); radius "
      "(half length) or "
      "diameter (trace length), or extent, or "
      "vertices (`\"x, y, z; ...\"`), in 2D x1, y1, x2, y2; friction angle, "
      "kinetic friction angle, cohesion, tensile strength, residual cohesion, "
      "water pressure; law and its entries; comment. Units m, deg and Pa, or "
      "as the header says, "
      "`cohesion (kPa)`. Separated by `,`, `;` or tabs; with the latter two "
      "decimal commas are understood. Rows without a name are J1, J2, ... by "
      "their number, with a name that is a set's, too, or stands twice, "
      "SET.NAME; a subsection of that name overrides the row. Other columns "
      "are left out with a warning.");
    prm.add_parameter(
      "Bridging",
      bridging,
      "Joints that end within this distance before another joint or a free "
      "face close against it [m]; all others leave the rock joined. -1: 1e-5 "
      "of the longest side of the domain, which closes what rounding leaves "
      "open.");
    prm.add_parameter(
      "Resolved",
      is_resolved,
      "Whether Names already lists all joints, those of File and of the sets "
      "included, so that neither is used again; true in used.prm.");
  }

  template <int dim>
  void
  Joint<dim>::declare(ParameterHandler &prm)
  {
    prm.add_parameter(
      "Shape",
      form,
      "Form of the joint: plane, by the entries below; or bent or kinked, one "
      "joint of several plane parts called NAME_1, NAME_2, ...: polyline (2D) "
      "through Vertices; file, the triangles, faces or lines of File; physical "
      "group "
      "of the mesh file (.msh), whose element faces are the joint.");
    prm.add_parameter(
      "File",
      file,
      "File of the surface, relative to the scene file: in 3D triangles, .stl "
      "or .dxf (3DFACE), or the faces of a STEP or BREP file (.step, .stp, "
      ".brep), in 2D lines, .dxf (polylines, lines, arcs); Domain/Origin is "
      "subtracted. Pieces that do not hang together, as mapped traces, may "
      "cross each other.");
    prm.add_parameter("Scale",
                      scale,
                      "Length of the unit of File [m]; STEP files name theirs.",
                      Double(std::numeric_limits<double>::min()));
    prm.add_parameter(
      "Segments",
      segments,
      "Number of chords in half a circle of a .dxf, STEP or BREP file.",
      dealii::Patterns::Integer(1, 1000));
    prm.add_parameter("Group",
                      group,
                      "Name or number of the physical group; empty: the name "
                      "of the joint.");
    prm.add_parameter("Point", point, "A point on the joint [m].");
    prm.add_parameter("Normal",
                      normal_entry,
                      "Normal vector; empty: from Dip and Dip direction.");
    prm.add_parameter("Dip",
                      dip,
                      "Angle below the horizontal [deg].",
                      Double(0., 90.));
    prm.add_parameter("Dip direction",
                      dip_direction,
                      "Azimuth towards which the joint descends, clockwise "
                      "from north (+y) [deg]; in 2D 90 (+x) or 270 (-x).",
                      Double(0., 360.));
    prm.add_parameter("Extent",
                      extent,
                      "infinite; disc: Radius about Point (in 2D a segment of "
                      "that half length); polygon: Vertices (in 2D the two "
                      "ends). If it is not given, it follows from Vertices or "
                      "Radius.");
    prm.add_parameter("Radius",
                      radius,
                      "Radius of the disc [m].",
                      not_negative);
    prm.add_parameter("Vertices",
                      vertices,
                      "Corners of the polygon on the plane, in order, or "
                      "points of the polyline [m]; with them Point and Normal "
                      "may be left out.");
    declare_strength(prm);
    prm.add_parameter("Set",
                      set,
                      "Name of the set it belongs to, whose strength it has "
                      "where it gives none of its own; empty: none.");
    prm.add_parameter("Surface",
                      surface,
                      "Name of the bent joint that it is a plane part of, and "
                      "by which it may be called; empty: none. Written in "
                      "used.prm.");
    prm.add_parameter("Piece",
                      piece,
                      "Number, from 0, of the piece of that joint; pieces do "
                      "not hang together and are cut as joints of their own. "
                      "Written in used.prm.");
  }

  template <int dim>
  void
  JointSet<dim>::declare(ParameterHandler &prm)
  {
    prm.add_parameter(
      "Dip",
      dip,
      "Dip of the mean plane of the set, below the horizontal [deg].",
      Double(0., 90.));
    prm.add_parameter("Dip direction",
                      dip_direction,
                      "Dip direction of the mean plane of the set, clockwise "
                      "from north (+y) [deg]; in 2D 90 (+x) or 270 (-x).",
                      Double(0., 360.));
    prm.add_parameter("Concentration",
                      concentration,
                      "Kappa of Fisher's law of the poles, in 2D of von Mises' "
                      "law [-]; 0: any direction; -1: all parallel.",
                      Double(-1.));
    prm.add_parameter(
      "Spacing",
      spacing,
      "Mean distance of the joints along the mean normal [m]; 0: by P32 or "
      "P10. With none of the three no joints are made, and the strength "
      "below is that of joints of other sources that name this set.",
      not_negative);
    prm.add_parameter("Spacing law",
                      spacing_law,
                      "exponential: a Poisson process; constant (infinite "
                      "joints only).");
    prm.add_parameter("Jitter",
                      jitter,
                      "Largest random shift of a joint of constant spacing to "
                      "either side, over half the spacing [-].",
                      fraction);
    prm.add_parameter(
      "Persistence",
      persistence,
      "Jointed fraction of the area of planes at the given Spacing, for finite "
      "joints [-]; P32 (P21) is then Persistence over Spacing.",
      Double(1e-6, 1.));
    prm.add_parameter(
      dim == 2 ? "P21" : "P32",
      intensity,
      "Mean area of joints per volume, P32 [m2/m3], in 2D length per area, P21 "
      "[m/m2], which may be called P32 there, too; it may stand instead of "
      "Spacing.",
      not_negative);
    if (dim == 2)
      prm.declare_alias("P21", "P32");
    prm.add_parameter("P10",
                      frequency,
                      "Mean number of joints per length along the mean normal "
                      "[1/m]; it may stand instead of Spacing.",
                      not_negative);
    prm.add_parameter(
      "Radius law",
      radius_law,
      "Law of the radii of discs (in 2D of half lengths). constant: Radius "
      "mean; uniform: from Radius minimum to Radius maximum; exponential, "
      "lognormal: of Radius mean (and Radius deviation) before the cut at "
      "minimum and maximum; power law: density r^-exponent; infinite: planes "
      "without a rim.");
    prm.add_parameter("Radius mean",
                      radius_mean,
                      "Mean radius [m].",
                      not_negative);
    prm.add_parameter("Radius deviation",
                      radius_deviation,
                      "Lognormal: standard deviation [m].",
                      not_negative);
    prm.add_parameter("Radius minimum",
                      radius_minimum,
                      "Least radius [m].",
                      not_negative);
    prm.add_parameter("Radius maximum",
                      radius_maximum,
                      "Greatest radius [m]; 0: exponential and lognormal ten "
                      "times the mean.",
                      not_negative);
    prm.add_parameter("Radius exponent",
                      radius_exponent,
                      "Power law: exponent of the density [-].",
                      Double(0., 10.));
    prm.add_parameter("Region corner",
                      region_corner,
                      "Corner with least coordinates of the box in which "
                      "centres of discs lie [m]; empty: the domain and a "
                      "margin of the greatest radius, so that the density is "
                      "the same up to its edge.");
    prm.add_parameter(
      "Region size",
      region_size,
      "Lengths, along the axes, of the box in which centres of discs lie [m].");
    prm.add_parameter("Seed",
                      seed,
                      "Seed of the random numbers, which also depend on the "
                      "name of the set; the same seed gives the same joints on "
                      "any machine and any number of ranks.");
    strength.declare_strength(prm);
  }

  template void Joint<2>::declare(ParameterHandler &);
  template void Joint<3>::declare(ParameterHandler &);
  template void JointSet<2>::declare(ParameterHandler &);
  template void JointSet<3>::declare(ParameterHandler &);
} // namespace Keyblock
