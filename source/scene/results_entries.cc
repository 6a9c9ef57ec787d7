// SPDX-License-Identifier: LGPL-2.1-or-later
// Entries of monitors, checks and output: name, default, range, unit and
// meaning.
#include <deal.II/base/parameter_handler.h>

#include <keyblock/scene/choice_patterns.h>
#include <keyblock/scene/entry_patterns.h>
#include <keyblock/scene/results.h>

namespace dealii::Patterns::Tools
{
  template <>
  struct Convert<Keyblock::MonitorKind>
    : Keyblock::ChoiceConversion<Keyblock::MonitorKind>
  {};
  template <>
  struct Convert<Keyblock::ClosedForm>
    : Keyblock::ChoiceConversion<Keyblock::ClosedForm>
  {};
} // namespace dealii::Patterns::Tools

namespace Keyblock
{
  using namespace EntryPatterns;

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
    prm.add_parameter("Block",
                      block,
                      "Number of the monitored block in the block table; 0: "
                      "the block at Location.",
                      Integer(0));
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
    prm.add_parameter("Keep stages",
                      keeps_stages,
                      "Whether the state at the end of each stage is kept as "
                      "stage_N.h5 (N from 1), from which --factors finds other "
                      "safety factors without a step of the stages.");
  }

  template struct Monitor<2>;
  template struct Monitor<3>;
} // namespace Keyblock
