// SPDX-License-Identifier: LGPL-2.1-or-later
// Entries of stages, time stepping and contact: name, default, range, unit and
// meaning.
#include <deal.II/base/parameter_handler.h>

#include <keyblock/scene/choice_patterns.h>
#include <keyblock/scene/entry_patterns.h>
#include <keyblock/scene/stage.h>

namespace dealii::Patterns::Tools
{
  template <>
  struct Convert<Keyblock::ContactMethod>
    : Keyblock::ChoiceConversion<Keyblock::ContactMethod>
  {};
  template <>
  struct Convert<Keyblock::Kinematics>
    : Keyblock::ChoiceConversion<Keyblock::Kinematics>
  {};
  template <>
  struct Convert<Keyblock::StageKind>
    : Keyblock::ChoiceConversion<Keyblock::StageKind>
  {};
  template <>
  struct Convert<Keyblock::RayleighTerms>
    : Keyblock::ChoiceConversion<Keyblock::RayleighTerms>
  {};
} // namespace dealii::Patterns::Tools

namespace Keyblock
{
  using namespace EntryPatterns;

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
    prm.add_parameter("Drained joints",
                      drained_joints,
                      "Joints, or sets of them, without water from this stage "
                      "on, whatever their level or pressure; the change is "
                      "ramped as excavation is.");
    prm.add_parameter(
      "Seismic coefficient",
      seismic_coefficient,
      "Seismic (pseudo-static) acceleration per axis over 9.81 m/s2 from this "
      "stage on [-]: a body force on all rock and shotcrete, in steps, trials "
      "and limit "
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
    prm.add_parameter(
      "Damping ratio",
      damping_ratio,
      "Stiffness-proportional damping: fraction of critical at "
      "each cell's highest frequency [-]; quasi-static stages "
      "beside rigid bodies take 0.02 at least. Without mass and "
      "local damping it damps also the deformation of finite "
      "blocks that slide, critically from 0.3 on.",
      Double(0., 10.));
    prm.add_parameter("Mass damping",
                      mass_damping,
                      "Mass-proportional damping [1/s].",
                      not_negative);
    prm.add_parameter("Rayleigh ratio",
                      rayleigh_ratio,
                      "Rayleigh damping, in dynamic stages besides the others: "
                      "fraction of critical at Rayleigh frequency, the least "
                      "of all frequencies [-].",
                      Double(0., 2.));
    prm.add_parameter("Rayleigh frequency",
                      rayleigh_frequency,
                      "Frequency at which Rayleigh damping is given [Hz].",
                      not_negative);
    prm.add_parameter("Rayleigh terms",
                      rayleigh_terms,
                      "Terms of Rayleigh damping. both: half the ratio comes "
                      "from mass and half from stiffness; mass, stiffness: "
                      "that half alone. The stiffness term shortens the step.");
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
} // namespace Keyblock
