// SPDX-License-Identifier: LGPL-2.1-or-later
// Every entry of a scene file: its name, default, range, unit and meaning;
// those of joints are in scene/joint_entries.cc.
#include <keyblock/scene/choice_patterns.h>
#include <keyblock/scene/scene.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/patterns.h>

#include <tuple>

namespace Keyblock
{
  namespace
  {
    using dealii::Patterns::Double;
    using dealii::Patterns::Integer;

    const Double any_number;
    const Double not_negative(0.);
    const Double positive(1e-300);
    const Double fraction(0., 1.);
    const Double friction_range(0., 89.9);
  } // namespace

  template <int dim>
  void
  Domain<dim>::declare(ParameterHandler &prm)
  {
    prm.add_parameter("Shape",
                      shape,
                      "box: axis-parallel, by Corner and Size; parallelepiped: "
                      "by Corner and Edges; polygon (2D): by Polygon; file: "
                      "whatever the mesh in File covers.");
    prm.add_parameter("Corner", corner, "The corner with least x, y (z) [m].");
    prm.add_parameter("Size", size, "Lengths along x, y (z) of a box [m].");
    prm.add_parameter("Edges",
                      edges,
                      "Edge vectors of a parallelepiped from Corner [m], for "
                      "example `1, 0; 0, 2`; they must be right-handed.");
    prm.add_parameter(
      "Polygon",
      polygon,
      "Corners of a 2D domain in order [m], `x, y; x, y; ...`.");
    prm.add_parameter("File",
                      file,
                      "Mesh file: Gmsh .msh, Abaqus .inp, VTK .vtk, UCD .ucd, "
                      "relative to the scene file. Triangles, tetrahedra and "
                      "wedges are cut into quadrilaterals and hexahedra.");
    prm.add_parameter(
      "Truncated boundaries",
      truncated_boundaries,
      "Outer boundaries beyond which the rock goes on: a block "
      "that touches one is infinite. Names left, right, bottom, "
      "top, front, back, all, none, or `id N` for a "
      "boundary of a mesh file.");
    prm.add_parameter("Origin",
                      origin,
                      "Coordinates of the model's origin in the grid of the "
                      "table Joints/File: they are subtracted from the table's "
                      "coordinates, so that the model has small numbers [m].");
  }

  template <int dim>
  void
  Meshing<dim>::declare(ParameterHandler &prm)
  {
    prm.add_parameter("Generator",
                      generator,
                      "structured: equal cells in a box or parallelepiped "
                      "(joints and excavations must follow cell faces); gmsh: "
                      "a mesh that follows joints and excavations; file: "
                      "Domain/File.");
    prm.add_parameter("Cells",
                      cells,
                      "Structured: number of cells along each edge.");
    prm.add_parameter("Gradings",
                      gradings,
                      "Structured: for each edge, either `uniform` or a ratio "
                      "of the last cell's length to the first's.");
    prm.add_parameter("Size",
                      size,
                      "Gmsh: cell size far away [m]; 0 means a twentieth (2D) "
                      "or a twelfth (3D) of the domain's longest side.",
                      not_negative);
    prm.add_parameter(
      "Size at excavation",
      size_at_excavation,
      "Gmsh: cell size on the excavation [m]; 0 means Size, or, "
      "if Cells across blocks or no Size is given, at most a "
      "tenth of the narrowest excavation.",
      not_negative);
    prm.add_parameter("Size at joints",
                      size_at_joints,
                      "Gmsh: cell size on joints [m]; 0 means no request.",
                      not_negative);
    prm.add_parameter("Grading distance",
                      grading_distance,
                      "Gmsh: distance over which the size grows to Size [m]; 0 "
                      "means a quarter of the domain.",
                      not_negative);
    prm.add_parameter(
      "Cells across blocks",
      cells_across,
      "Number of cells that finite blocks near excavations (all finite blocks, "
      "if nothing is excavated) are to have across their least width, in gmsh "
      "meshes: the scene is meshed again with smaller cells where blocks have "
      "fewer, at most three times. 0: sizes do not depend on blocks.",
      Double(0., 50.));
    prm.add_parameter("Least size",
                      least_size,
                      "Gmsh: the smallest cell size that Cells across blocks "
                      "may ask for [m]; 0 means a quarter of Size at "
                      "excavation.",
                      not_negative);
    prm.add_parameter(
      "Joint tolerance",
      joint_tolerance,
      "Distance of a cell face's vertices from a joint, as a fraction of the "
      "face's size, within which the face lies on the joint [-].",
      Double(0., 0.1));
    prm.add_parameter(
      "Snap",
      snap,
      "Distance, as a fraction of the edge length wanted there (2.6 cell sizes "
      "in 2D, 3 in 3D), within which vertices are moved onto a joint that is "
      "cut into a gmsh mesh, where joints cannot be followed exactly with "
      "cells of a good shape [-]. Larger: larger time steps; smaller: joints "
      "and thin blocks more exact. 0: joints are always followed exactly, or "
      "the scene is refused.",
      Double(0., 0.45));
    prm.add_parameter("Refine at excavations",
                      refine_at_excavations,
                      "Distances from outlines of excavations [m], decreasing: "
                      "cells nearer than the first are halved once, nearer "
                      "than the second twice, and so on.");
    prm.add_parameter(
      "Refine at joints",
      refine_at_joints,
      "Distances from joints [m], decreasing: cells nearer than the first are "
      "halved once, nearer than the second twice, and so on.");
    prm.add_parameter(
      "Refinement levels",
      refinement_levels,
      "A formula in x, y (z): how often cells are halved whose centre is "
      "there. A box: `2 * (abs(x) < 5) * (abs(y) < 8)`.");
  }

  template <int dim>
  void
  Excavation<dim>::declare(ParameterHandler &prm)
  {
    prm.add_parameter(
      "Shape",
      shape,
      "polygon (2D): Vertices; circle (2D): Center and Radius, "
      "arcs kept; box: Corner and Size; extruded polygon "
      "(3D): Vertices in the x-z plane, From and To along y; "
      "rectangle, horseshoe (half a circle on walls), cavern "
      "(an arch of Rise on walls): Center, Width and Height, in "
      "3D along y as an extruded polygon; "
      "formula (structured and file meshes): Formula.");
    prm.add_parameter(
      "Formula",
      formula,
      "A formula in x, y (z) that is positive at the centres of "
      "the cells excavated out.");
    prm.add_parameter("Vertices", vertices, "Corners in order [m].");
    prm.add_parameter("Corner",
                      corner,
                      "The corner with least coordinates [m].");
    prm.add_parameter("Size", size, "Lengths along the axes [m].");
    prm.add_parameter("Center",
                      center,
                      "Centre of the circle; middle of the floor of a "
                      "rectangle, horseshoe or cavern, in 3D its x and z [m].");
    prm.add_parameter("Width",
                      width,
                      "Width of a rectangle, horseshoe or cavern [m].",
                      not_negative);
    prm.add_parameter("Height",
                      height,
                      "Height of it, from the floor to the crown [m].",
                      not_negative);
    prm.add_parameter("Rise",
                      rise,
                      "Rise of a cavern's arch above its springs [m].",
                      not_negative);
    prm.add_parameter("Segments",
                      segments,
                      "Number of chords of the crown.",
                      Integer(2, 1000));
    prm.add_parameter("Bench levels",
                      bench_levels,
                      "Elevations at which it is parted into benches, from the "
                      "top down [m]. What is above the first is excavated in "
                      "Stage.");
    prm.add_parameter("Bench stages",
                      bench_stages,
                      "Name of the stage that excavates what is below each of "
                      "Bench levels. The parts are called NAME bench 1, NAME "
                      "bench 2, ...");
    prm.add_parameter("Radius",
                      radius,
                      "Radius of the circle [m].",
                      not_negative);
    prm.add_parameter("From", from, "Extrusion: least y [m].");
    prm.add_parameter("To", to, "Extrusion: greatest y [m].");
    prm.add_parameter("Stage",
                      stage,
                      "Name of the stage that excavates the region; start: the "
                      "region is empty from the beginning.");
    prm.add_parameter("Backfill stage",
                      backfill_stage,
                      "Name of a later stage that fills it, unstressed; empty: "
                      "none.");
    prm.add_parameter("Backfill material",
                      backfill_material,
                      "Name of the material it is filled with.");
  }

  template <int dim>
  void
  DepthGround<dim>::declare(ParameterHandler &prm)
  {
    prm.add_parameter(
      "Depth",
      depth,
      "Depth of elevation 0 below the surface of the ground [m]. What the "
      "scene leaves open then follows: gravity, initial stress, rollers on the "
      "sides and the bottom of the domain, and the overburden on its top. 0: "
      "nothing does.",
      not_negative);
    prm.add_parameter(
      "Density",
      density,
      "Density of the ground up to the surface [kg/m3]; 0: that "
      "of the first material that deforms.",
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
      "Region that the material fills: all; `id N` for cells of a mesh file; a "
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
  Support<dim>::declare(ParameterHandler &prm)
  {
    prm.add_parameter(
      "Boundaries",
      boundaries,
      "Outer boundaries: left, right, bottom, top, front, back, "
      "all, or `id N`.");
    prm.add_parameter("Region",
                      region,
                      "Formula in x, y (z), positive at the nodes to be held; "
                      "it may stand instead of Boundaries.");
    prm.add_parameter(
      "Directions",
      directions,
      "Directions that are held. all: all axes; normal: the normal of each "
      "named boundary, as a roller; or axes, for example x or xz.");
    prm.add_parameter("Kind",
                      kind,
                      "Kind of the support. held: fixed or moved by Velocity; "
                      "far field: the stiffness of infinite rock around the "
                      "model, exact for double forces at Center if the far "
                      "field encloses it (Boundaries only), after the initial "
                      "state; quiet: dashpots that let waves out, and in what "
                      "Velocity or History file give (Boundaries only), from "
                      "Stage on; held before.");
    prm.add_parameter("Stage",
                      stage,
                      "Name of the stage from which on a quiet support is "
                      "quiet; what it carried then stays as a dead load. "
                      "start: after the initial state.");
    prm.add_parameter(
      "History file",
      history_file,
      "CSV file of a motion, in place of Velocity, found from the folder of "
      "the "
      "scene: a header, then rows of the "
      "time [s], at even intervals, and one value per axis. Linear between "
      "rows, zero before the first and after the last.");
    prm.add_parameter(
      "History quantity",
      history_quantity,
      "Quantity in History file. velocity [m/s]; acceleration [m/s2], which is "
      "integrated; stress: traction of the incoming wave on the model [Pa], of "
      "quiet supports only.");
    prm.add_parameter(
      "Displacement",
      displacement,
      "Displacement that the support has reached at the end of the ramp of the "
      "first quasi-static or static stage, a formula in x, y (z) per axis [m]; "
      "it may stand instead of Velocity.");
    prm.add_parameter("Center",
                      center,
                      "Centre of the excavation, from which a far field "
                      "measures the distance to the boundary [m].");
    prm.add_parameter("Velocity",
                      velocity,
                      "Prescribed velocity, a formula in x, y (z), t per axis "
                      "separated by ';' [m/s]; of a quiet support the particle "
                      "velocity of the wave that it lets in. Empty: held, or "
                      "no wave.");
  }

  template <int dim>
  void
  Traction<dim>::declare(ParameterHandler &prm)
  {
    prm.add_parameter("Boundaries",
                      boundaries,
                      "Outer boundaries that are loaded: left, right, bottom, "
                      "top, front, back, all, or `id N`.");
    prm.add_parameter(
      "Region",
      region,
      "Formula in x, y (z), positive at the centres of the free faces to be "
      "loaded; it may stand instead of Boundaries.");
    prm.add_parameter("Traction",
                      expression,
                      "Force per area, a formula in x, y (z), t per axis "
                      "separated by ';' [N/m2].");
    prm.add_parameter("Stage",
                      stage,
                      "Name of the stage with which it begins, as a ramp if "
                      "that is quasi-static; start: it belongs to the initial "
                      "state.");
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
      "file, with the header x,y,(z,)component,value,weight: "
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



  void
  ContactSettings::declare(ParameterHandler &prm)
  {
    prm.add_parameter("Method",
                      method,
                      "Solution of contact. exact: coupled points, iterated to "
                      "Tolerance; published: one pass without coupling, "
                      "for comparison; none: joints are ignored.");
    prm.add_parameter(
      "Default friction angle",
      default_friction_angle,
      "Friction angle of contact between faces that lie on no joint [deg].",
      friction_range);
    prm.add_parameter(
      "Tolerance",
      tolerance,
      "Largest change of a node's momentum per iteration at which the contact "
      "solution ends, as a fraction of the largest impulse of its group [-].",
      Double(1e-15, 1e-2));
    prm.add_parameter("Maximum iterations",
                      maximum_iterations,
                      "Largest number of iterations for each group of contact "
                      "points in each step [-].",
                      Integer(1));
    prm.add_parameter("Slip tolerance",
                      slip_tolerance,
                      "Slip, as a fraction of the face size, from which on the "
                      "two nodes of a pair are searched against faces [-].",
                      Double(0., 1.));
    prm.add_parameter(
      "Weld infinite blocks",
      weld_infinite_blocks,
      "Whether joints between two infinite blocks stay welded.");
    prm.add_parameter("Tie all joints",
                      tie_all,
                      "Whether all joints have infinite strength.");
  }

  void
  TimeStepping::declare(ParameterHandler &prm)
  {
    prm.add_parameter(
      "Kinematics",
      kinematics,
      "Geometry of the strains. small: the reference geometry, for small "
      "deformations and slip along planes; large: the current geometry with an "
      "objective stress rate, for blocks that turn.");
    prm.add_parameter("Safety",
                      safety,
                      "Fraction of the stable time step used [-].",
                      Double(1e-6, 2.));
    prm.add_parameter("Maximum step",
                      maximum_step,
                      "Upper limit of the time step [s]; 0: none.",
                      not_negative);
    prm.add_parameter(
      "Least step",
      least_step,
      "Stable time step of dynamic stages, without damping and Safety, that "
      "mass scaling aims at [s]; 0: no mass scaling. Cells with a smaller step "
      "get inertia, but no weight, from the other cells of their block.",
      not_negative);
    prm.add_parameter(
      "Largest added mass",
      largest_added_mass,
      "Largest mass that the cells with a time step below Least step get, as a "
      "fraction of the block's mass, and the largest that any other cell "
      "gives, as a fraction of its own [-].",
      Double(0., 0.5));
    prm.add_parameter(
      "Energy ledger",
      ledger,
      "Whether the work of all forces is summed in each step; without it the "
      "energy terms and their residual are not known.");
    prm.add_parameter("Skip cells at rest",
                      skips_resting,
                      "Whether cells that are far from all that moves are left "
                      "out of the steps.");
    prm.add_parameter("Rest speed",
                      rest_speed,
                      "Highest speed of nodes that count as at rest, as a "
                      "fraction of the speed of the fastest node [-].",
                      Double(0., 1.));
  }

  void
  Stage::declare(ParameterHandler &prm)
  {
    prm.add_parameter("Water level",
                      water_level,
                      "Elevation of the water table from this stage on, as "
                      "Water/Level; none: joints are dry; empty: as before. "
                      "The change of pressure is ramped as excavation is.");
    prm.add_parameter(
      "Seismic coefficient",
      seismic_coefficient,
      "Seismic (pseudo-static) acceleration per axis over 9.81 m/s2 from this "
      "stage on [-]: a body force on all rock, in steps, trials and limit "
      "equilibrium, ramped as excavation is. Empty: as before; zeros end it.");
    prm.add_parameter(
      "Kind",
      kind,
      "Kind of the stage. dynamic: true motion over Duration; quasi-static: "
      "damped steps with scaled density until forces balance; static: one "
      "elastic solve with all joints tied.");
    prm.add_parameter("Duration",
                      duration,
                      "Simulated time of the stage [s].",
                      not_negative);
    prm.add_parameter("Maximum steps",
                      maximum_steps,
                      "Number of steps after which the stage ends; 0: no "
                      "limit, in quasi-static stages 200,000.",
                      Integer(0));
    prm.add_parameter(
      "Unbalanced ratio",
      unbalanced_ratio,
      "Ratio of the unbalanced force to the driving force below which the "
      "stage ends [-]; 0: it does not end by it, in quasi-static stages 1e-5.",
      not_negative);
    prm.add_parameter("Damping ratio",
                      damping_ratio,
                      "Stiffness-proportional damping: fraction of critical at "
                      "each cell's highest frequency [-]. Without mass and "
                      "local damping it damps also the deformation of finite "
                      "blocks that slide, critically from 0.3 on.",
                      Double(0., 10.));
    prm.add_parameter("Mass damping",
                      mass_damping,
                      "Mass-proportional damping [1/s].",
                      not_negative);
    prm.add_parameter("Local damping",
                      local_damping,
                      "Local non-viscous damping [-]; 0: none, in quasi-static "
                      "stages 0.8.",
                      fraction);
    prm.add_parameter("Damp contact force",
                      damps_contact_force,
                      "Whether local damping counts contact forces; without "
                      "them sliding jams (for comparison only).");
    prm.add_parameter(
      "Density scaling",
      scales_density,
      "Whether a quasi-static stage scales masses so that all cells take the "
      "same time step; gravity keeps the true ones.");
    prm.add_parameter(
      "Ramp duration",
      ramp_duration,
      "Time over which the out-of-balance force of excavation, fill and new "
      "loads is taken away [s]; 0: four periods of the lowest mode in "
      "quasi-static stages, at once in dynamic ones.",
      not_negative);
    prm.add_parameter("Ramp unbalance",
                      ramp_unbalance,
                      "Unbalanced ratio above which the ramp slows down [-].",
                      positive);
    prm.add_parameter("Friction angle override",
                      friction_angle_override,
                      "Friction angle of all joints in this stage, in place of "
                      "their own [deg]; -1: their own.",
                      Double(-1., 89.9));
    prm.add_parameter("Reset motion",
                      reset_motion,
                      "Whether the stage starts with zero velocities and "
                      "counts displacements from its start.");
  }

  template <int dim>
  void
  Monitor<dim>::declare(ParameterHandler &prm)
  {
    prm.add_parameter(
      "Kind",
      kind,
      "point: nearest node; block: the block at Location; region: mean over "
      "the nodes where Region is positive, by mass; joint: sums over a joint; "
      "support: reaction of a support.");
    prm.add_parameter(
      "Location",
      location,
      "Place of the monitored point, or a point in the monitored block [m].");
    prm.add_parameter("Region",
                      region,
                      "Region: formula of the reference position, positive "
                      "inside [-].");
    prm.add_parameter("Joint",
                      joint,
                      "Name of a joint or of a set of joints, or all for "
                      "every contact point.");
    prm.add_parameter("Support", support, "Name of the support.");
  }

  void
  SafetySettings::declare(ParameterHandler &prm)
  {
    prm.add_parameter(
      "Blocks",
      blocks,
      "Blocks whose safety factor is looked for at the end of "
      "stages: none; all (finite ones that are not attached); "
      "exposed (those with a free face); critical (those of "
      "them whose factor by limit equilibrium is below Critical "
      "factor); or their numbers in the block table.");
    prm.add_parameter("Critical factor",
                      critical_factor,
                      "Factor by limit equilibrium below which a block is "
                      "critical [-].",
                      positive);
    prm.add_parameter("Stages",
                      stages,
                      "Names of the stages at whose end safety factors are "
                      "computed; empty: all stages.");
    prm.add_parameter("Reduced joints",
                      reduced_joints,
                      "Joints whose strength a trial divides by the factor. of "
                      "the block: those of the tried block, where it touches "
                      "others; all: those of the whole model.");
    prm.add_parameter(
      "Joints",
      joints,
      "Names of the joints, or sets of joints, to which the reduction of "
      "strength is restricted; empty: no restriction.");
    prm.add_parameter("Reduce rock",
                      reduces_rock,
                      "Whether trials divide the strength of mohr_coulomb rock "
                      "by the factor as well.");
    prm.add_parameter(
      "Rank groups",
      rank_groups,
      "Number of rank groups that look for the safety factors of different "
      "blocks at the same time; all ranks compute the stages together. It has "
      "to divide the number of ranks. Unless a signal stops the run, "
      "checkpoints wait until all factors of a stage are found.",
      Integer(1));
    prm.add_parameter("Wanted",
                      wanted,
                      "Factor for which limit equilibrium gives the pressure, "
                      "and the number of bolts of each set, that a block asks "
                      "for besides the support it has; 0: none [-].",
                      not_negative);
    prm.add_parameter(
      "Bolt convention",
      bolt_convention,
      "How the forces of bolts enter a block's factor. active: they are "
      "undivided, and taken from what drives the block; passive: their part "
      "along the plane of sliding is divided by the factor like the joints' "
      "strength, as a part of what resists.");
    prm.add_parameter("Method",
                      method,
                      "Search for the factor. bisection: halving of a bracket; "
                      "sweep: from Lowest upwards by Sweep step until the "
                      "block fails (the published method).");
    prm.add_parameter(
      "Sweep step",
      sweep_step,
      "Increment of the factor from trial to trial of a sweep [-].",
      positive);
    prm.add_parameter("Bracket",
                      bracket,
                      "Width of the final bracket over its upper end [-].",
                      Double(1e-6, 1.));
    prm.add_parameter(
      "Lowest",
      lowest,
      "Lowest factor tried: a block that fails at it falls freely [-].",
      positive);
    prm.add_parameter(
      "Highest",
      highest,
      "Highest factor tried: a block that holds at it is immovable, or held by "
      "clamping if limit equilibrium can move it [-].",
      positive);
    prm.add_parameter("Mass damping",
                      mass_damping,
                      "Mass-proportional damping in the first phase of a "
                      "trial, which looks for an equilibrium, as a fraction of "
                      "the critical damping of the block's lowest mode [-].",
                      Double(0., 10.));
    prm.add_parameter("Adaptive damping",
                      adaptive_damping,
                      "Whether blocks that creep to rest by one slow mode are "
                      "damped by the frequency of that mode.");
    prm.add_parameter(
      "Local damping",
      local_damping,
      "Local damping of the first phase of a trial, in addition to Mass "
      "damping and Damping ratio [-]; 0: none.",
      Double(0., 1.));
    prm.add_parameter(
      "Damping ratio",
      damping_ratio,
      "Damping ratio of the highest mode of each cell by "
      "stiffness-proportional damping, in both phases of a trial [-].",
      Double(0., 2.));
    prm.add_parameter(
      "Window",
      window,
      "Check interval of a trial, in periods of the block's lowest mode [-].",
      Double(0.1, 100.));
    prm.add_parameter(
      "Maximum periods",
      maximum_periods,
      "Length of the first phase of a trial, at most, in periods of the "
      "block's lowest mode [-]. The second phase ends after 20 such periods, "
      "each later round after 20 more, or after this length if that is less.",
      positive);
    prm.add_parameter(
      "Trial steps",
      trial_steps,
      "Number of steps that each trial computes at least, even if it is "
      "decided before (5000 in the published method); 0: none.");
    prm.add_parameter(
      "Warm start",
      warm_start,
      "Whether a trial starts from the highest factor at which the block came "
      "to rest; else it starts from the end of the stage.");
    prm.add_parameter(
      "Reach",
      reach,
      "Distance from the block up to which rock moves in trials, in sizes of "
      "the block; rock farther away is held [-]. 0: all rock moves. Without "
      "effect where all joints or the rock are reduced.",
      not_negative);
    prm.add_parameter("True masses",
                      true_masses,
                      "Whether the second phase of a trial uses the true "
                      "masses; else it keeps the scaled ones of the first "
                      "phase, which give all cells the same time step.");
    prm.add_parameter(
      "Seismic coefficient",
      seismic_coefficient,
      "Seismic acceleration per axis over 9.81 m/s2 [-]. Limit equilibrium "
      "alone adds it to gravity; steps and trials do so with "
      "Stages/*/Seismic coefficient. Empty: none.");
    prm.add_parameter(
      "Removal slip",
      removal_slip,
      "Slip of a block, as a fraction of its size, at which a quasi-static "
      "stage takes the block away as failed [-]. A block that slides steadily "
      "is taken away earlier. 0: no block is taken away.",
      not_negative);
  }



  void
  BlockTheorySettings::declare(ParameterHandler &prm)
  {
    prm.add_parameter("Report",
                      report,
                      "Whether to print and store which joint pyramids of the "
                      "infinite joints are removable.");
    prm.add_parameter("Walls",
                      walls,
                      "Azimuths that walls face, seen from the rock [deg]; in "
                      "2D 90 and 270 only.");
    prm.add_parameter(
      "Roof span",
      roof_span,
      "Width of a flat roof for the largest wedges [m] (3D); 0: "
      "none.",
      not_negative);
    prm.add_parameter("Roof axis",
                      roof_axis,
                      "Azimuth of the axis of the opening; Roof span is "
                      "measured across it [deg].");
  }



  void
  CheckSettings::declare(ParameterHandler &prm)
  {
    prm.add_parameter("Closed form",
                      closed_form,
                      "Closed form, or other reference, with which the results "
                      "of the last stage are compared; none: no comparison.");
    prm.add_parameter(
      "Joint",
      joint,
      "Name of the joint on which the checked quantities are measured.");
    prm.add_parameter("Quantity",
                      quantity,
                      "Column of history.csv, without its unit, whose last "
                      "value is compared, for the closed form value.");
    prm.add_parameter("Reference",
                      reference,
                      "Reference value with which Quantity is compared, for "
                      "the closed form value.");
    prm.add_parameter("Reference time",
                      reference_time,
                      "Time since the start of the last stage at which "
                      "displacements are compared [s]; 0: its end.",
                      not_negative);
    prm.add_parameter("Window start",
                      window_start,
                      "Start of the time window over which means and fits are "
                      "taken, as a fraction of the last stage [-].",
                      fraction);
    prm.add_parameter(
      "Length",
      length,
      "Length that the closed form needs [m]. bar_impact, bond_break: length "
      "of the bar; footing: loaded width, to half a cell past the last held "
      "node; spherical_cavity: radius of the cavity about the origin.",
      not_negative);
  }

  void
  OutputSettings::declare(ParameterHandler &prm)
  {
    prm.add_parameter("Folder",
                      folder,
                      "Output folder; empty: output-NAME beside the working "
                      "directory, NAME being that of the scene.");
    prm.add_parameter("History interval",
                      history_interval,
                      "Steps between lines of history.csv.",
                      Integer(1));
    prm.add_parameter("VTU count",
                      vtu_count,
                      "Number of VTU outputs per stage, besides the first: at "
                      "even times, or in quasi-static stages at even shares "
                      "of the ramp and at the end.",
                      Integer(0));
    prm.add_parameter("Write VTU", write_vtu, "Whether to write VTU at all.");
    prm.add_parameter("Checkpoint interval",
                      checkpoint_interval,
                      "Wall time between checkpoints, from which --restart "
                      "continues [s]; 0: only when a signal stops the run.",
                      Double(0.));
  }

  template struct Domain<2>;
  template struct Domain<3>;
  template struct Meshing<2>;
  template struct Meshing<3>;
  template struct Excavation<2>;
  template struct Excavation<3>;
  template struct DepthGround<2>;
  template struct DepthGround<3>;
  template struct Material<2>;
  template struct Material<3>;
  template struct Support<2>;
  template struct Support<3>;
  template struct Traction<2>;
  template struct Traction<3>;
  template struct InitialState<2>;
  template struct InitialState<3>;
  template struct Monitor<2>;
  template struct Monitor<3>;
} // namespace Keyblock
