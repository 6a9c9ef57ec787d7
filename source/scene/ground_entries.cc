// SPDX-License-Identifier: LGPL-2.1-or-later
// Entries of ground, materials, initial state and water: name, default, range,
// unit and meaning.
#include <deal.II/base/parameter_handler.h>

#include <keyblock/scene/choice_patterns.h>
#include <keyblock/scene/entry_patterns.h>
#include <keyblock/scene/ground.h>

namespace dealii::Patterns::Tools
{
  template <>
  struct Convert<Keyblock::MaterialModel>
    : Keyblock::ChoiceConversion<Keyblock::MaterialModel>
  {};
  template <>
  struct Convert<Keyblock::CellIntegration>
    : Keyblock::ChoiceConversion<Keyblock::CellIntegration>
  {};
  template <>
  struct Convert<Keyblock::InitialEquilibrium>
    : Keyblock::ChoiceConversion<Keyblock::InitialEquilibrium>
  {};
} // namespace dealii::Patterns::Tools

namespace Keyblock
{
  using namespace EntryPatterns;

  template <int dim>
  void
  DepthGround<dim>::declare(ParameterHandler &prm)
  {
    prm.add_parameter(
      "Depth",
      depth,
      "Depth of elevation 0 below the surface of the ground [m]. What the "
      "scene leaves open then follows: gravity, the entries of the initial "
      "stress that are not given, rollers on the sides and the bottom of the "
      "domain where there is no support (which hold both horizontal directions "
      "where the stress has shear along the sides), and the overburden on its "
      "top unless a traction is on it from the start; where the surface is the "
      "top of the domain, blocks there are not infinite by it. 0: the surface "
      "is at "
      "elevation 0. -1: nothing follows.",
      dealii::Patterns::Double(-1.));
    prm.add_parameter(
      "Density",
      density,
      "Density of the ground between the domain and the surface [kg/m3]; in "
      "the "
      "domain that of the rock counts; 0: the same as most of that.",
      not_negative);
    prm.add_parameter("K0",
                      k0,
                      "Horizontal over vertical stress [-], as Initial "
                      "state/Lateral ratios.");
    prm.add_parameter("Azimuth",
                      azimuth,
                      "Azimuth of the first horizontal stress in 3D, clockwise "
                      "from north (+y) [deg].");
  }


  template <int dim>
  void
  Material<dim>::declare(ParameterHandler &prm)
  {
    prm.add_parameter(
      "Region",
      region,
      "Region that the material fills: all; `id N` for cells of a mesh file "
      "(N: number, or name of the physical group); a "
      "formula in x, y (z), positive at the centres of its cells; or `band A "
      "B` for the rock between the joints A and B. Later materials overwrite "
      "earlier ones.");
    prm.add_parameter("Stage",
                      stage,
                      "Name of the stage from which on the material takes the "
                      "place of the former one in its region; stresses stay as "
                      "they are. Empty: from the start.");
    prm.add_parameter(
      "Model",
      model,
      "elastic; mohr_coulomb: elastic until it yields; rigid: a "
      "fixed (or moved) body without strain, whose cells cost "
      "nothing.");
    prm.add_parameter("Young modulus",
                      young_modulus,
                      "Young's modulus E [Pa].",
                      positive);
    prm.add_parameter("Poisson ratio",
                      poisson_ratio,
                      "Poisson's ratio nu, below 0.5 [-].",
                      Double(-0.999, 0.4999));
    prm.add_parameter("Density", density, "Density rho [kg/m3].", positive);
    prm.add_parameter("Cohesion",
                      cohesion,
                      "mohr_coulomb: c [Pa].",
                      not_negative);
    prm.add_parameter("Friction angle",
                      friction_angle,
                      "mohr_coulomb: phi [deg].",
                      friction_range);
    prm.add_parameter("Dilation angle",
                      dilation_angle,
                      "mohr_coulomb: psi, at most phi [deg]; -1: associated, "
                      "psi = phi.",
                      Double(-1., 89.));
    prm.add_parameter("Tensile strength",
                      tensile_strength,
                      "mohr_coulomb: cut-off of the tensile stress [Pa]; -1: "
                      "none besides c / tan(phi).",
                      Double(-1.));
    prm.add_parameter("Residual cohesion",
                      residual_cohesion,
                      "mohr_coulomb: c after failure [Pa]; -1: unchanged.",
                      Double(-1.));
    prm.add_parameter("Residual friction angle",
                      residual_friction_angle,
                      "mohr_coulomb: phi after failure [deg]; -1: unchanged.",
                      Double(-1., 89.));
    prm.add_parameter(
      "Residual tensile strength",
      residual_tensile_strength,
      "mohr_coulomb: cut-off after failure [Pa]; -1: unchanged.",
      Double(-1.));
    prm.add_parameter("Softening strain",
                      softening_strain,
                      "mohr_coulomb: plastic strain over which strengths fall "
                      "to the residual ones [-]; 0: at once.",
                      not_negative);
    prm.add_parameter(
      "Integration",
      integration,
      "Integration of elastic cells. full: each Gauss point has its own volume "
      "change; mean dilatation: the volume change is averaged over each cell, "
      "which prevents locking; automatic: mean dilatation for Poisson ratios "
      "above 0.4. mohr_coulomb cells always have mean dilatation.");
    prm.add_parameter("Rigid velocity",
                      rigid_velocity,
                      "Velocity of a rigid body, a formula in t, one component "
                      "per axis separated by ';' [m/s]; empty: at rest.");
  }


  template <int dim>
  void
  InitialState<dim>::declare(ParameterHandler &prm)
  {
    prm.add_parameter("Gravity",
                      gravity,
                      "Acceleration, a formula in t per axis separated by ';' "
                      "[m/s2]; empty: none.");
    prm.add_parameter("Stress",
                      stress,
                      "Initial stress, tension positive, formulas in x, y (z) "
                      "[Pa]: 2D xx; yy; zz; xy. 3D xx; yy; zz; yz; xz; xy.");
    prm.add_parameter(
      "Velocity",
      velocity,
      "Initial velocity, a formula in x, y (z) per axis [m/s].");
    prm.add_parameter("Surface elevation",
                      surface_elevation,
                      "Elevation of the ground surface, from which depth is "
                      "counted [m].");
    prm.add_parameter(
      "Vertical stress gradient",
      vertical_stress_gradient,
      "Compression added per metre of depth [Pa/m]; with it, or "
      "with Surface stress, the initial stress grows with "
      "depth.",
      not_negative);
    prm.add_parameter("Surface stress",
                      surface_stress,
                      "Vertical compression at the surface elevation [Pa].");
    prm.add_parameter("Lateral ratios",
                      lateral_ratios,
                      "Horizontal over vertical stress [-]: 2D along x and out "
                      "of the plane, 3D along and across Lateral azimuth; one "
                      "number for both.");
    prm.add_parameter("Lateral azimuth",
                      lateral_azimuth,
                      "3D: azimuth of the first lateral stress, clockwise from "
                      "north (+y) [deg].");
    prm.add_parameter(
      "Measured points",
      measured_points,
      "CSV file of measured stresses, relative to the scene "
      "file, with columns x,y,(z,)component,value,weight and, if its first "
      "line is no data, a header: "
      "components as in Stress, values in Pa, tension positive. "
      "The initial stress is the sum of Stress fields that fits "
      "them best.");
    prm.add_parameter(
      "Stress fields",
      stress_fields,
      "Unit fields of the inversion: gravity; push x (push y) "
      "and graded x (graded y) of 1 Pa and of 1 Pa per metre of "
      "depth below Surface elevation, compression; shear xy "
      "(3D).");
    prm.add_parameter("Equilibrium",
                      equilibrium,
                      "static: one elastic solve with all joints tied brings "
                      "the initial stress into equilibrium with loads and "
                      "supports, and displacements are zeroed; none: the "
                      "stress is taken as it is.");
  }


  void
  WaterSettings::declare(ParameterHandler &prm)
  {
    prm.add_parameter("Level",
                      level,
                      "Elevation of the water table, a formula in x, y (z) and "
                      "t: below it there is pressure in all joints without a "
                      "Water pressure of their own, which pushes both sides "
                      "apart [m]; none or empty: joints are dry.");
    prm.add_parameter("Unit weight",
                      unit_weight,
                      "Unit weight of water [N/m3].",
                      not_negative);
  }

  template struct DepthGround<2>;
  template struct DepthGround<3>;
  template struct Material<2>;
  template struct Material<3>;
  template struct InitialState<2>;
  template struct InitialState<3>;
} // namespace Keyblock
