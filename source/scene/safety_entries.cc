// SPDX-License-Identifier: LGPL-2.1-or-later
// Entries of safety factors and block theory: name, default, range, unit and
// meaning.
#include <deal.II/base/parameter_handler.h>

#include <keyblock/scene/choice_patterns.h>
#include <keyblock/scene/entry_patterns.h>
#include <keyblock/scene/safety.h>

namespace dealii::Patterns::Tools
{
  template <>
  struct Convert<Keyblock::ReducedJoints>
    : Keyblock::ChoiceConversion<Keyblock::ReducedJoints>
  {};
  template <>
  struct Convert<Keyblock::FactorSearch>
    : Keyblock::ChoiceConversion<Keyblock::FactorSearch>
  {};
  template <>
  struct Convert<Keyblock::DemandSearch>
    : Keyblock::ChoiceConversion<Keyblock::DemandSearch>
  {};
  template <>
  struct Convert<Keyblock::BoltConvention>
    : Keyblock::ChoiceConversion<Keyblock::BoltConvention>
  {};
} // namespace dealii::Patterns::Tools

namespace Keyblock
{
  using namespace EntryPatterns;

  void
  SafetySettings::declare(ParameterHandler &prm)
  {
    prm.add_parameter(
      "Blocks",
      blocks,
      "Blocks whose safety factor is looked for at the end of "
      "stages: none; all (finite ones that are not attached); "
      "exposed (those with a free face, also because others "
      "failed and were taken away); critical (those of "
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
      "Names of the joints, or sets of joints, whose strength alone a factor "
      "divides, by trials and by limit equilibrium; empty: no restriction.");
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
                      "for besides the support it has; the search for a factor "
                      "ends where a block holds at it; 0: none [-].",
                      not_negative);
    prm.add_parameter(
      "Wanted by",
      wanted_by,
      "What tells the support that a wanted factor asks for. limit "
      "equilibrium: that alone; strength reduction: besides, for each block "
      "that does not hold at Wanted, the least pressure on its free faces "
      "with which it does, by trials with strength divided by Wanted.");
    prm.add_parameter(
      "Bolt convention",
      bolt_convention,
      "How the forces of bolts enter a block's factor. active: they are "
      "undivided, and taken from what drives the block; passive: what they "
      "do against the way that the block would take without them is divided by "
      "the factor like the joints' strength, as a part of what resists.");
    prm.add_parameter("Method",
                      method,
                      "Search for the factor. bisection: halving of a bracket; "
                      "sweep: from Lowest upwards by Sweep step until the "
                      "block fails (the published method); limit equilibrium: "
                      "none, and no step: stages only excavate and support, "
                      "and blocks with a free face are judged as rigid ones, "
                      "all of them if Blocks is none.");
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
      "the block; rock farther away is held [-], but for finite blocks that "
      "lean on it, on those, and so on. 0: all rock moves. Without effect "
      "where "
      "all joints or the rock are reduced.",
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
      "Way of a block, as a fraction of its size, at which a quasi-static "
      "stage takes the block away as failed [-]: the root mean square of its "
      "displacement against the rock around it, sliding, falling or rotating. "
      "A block that moves on steadily is taken away earlier. 0: no block is "
      "taken away.",
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
} // namespace Keyblock
