// SPDX-License-Identifier: LGPL-2.1-or-later
// Entries of supports and tractions: name, default, range, unit and meaning.
#include <deal.II/base/parameter_handler.h>

#include <keyblock/scene/boundary.h>
#include <keyblock/scene/choice_patterns.h>
#include <keyblock/scene/entry_patterns.h>

namespace dealii::Patterns::Tools
{
  template <>
  struct Convert<Keyblock::SupportKind>
    : Keyblock::ChoiceConversion<Keyblock::SupportKind>
  {};
  template <>
  struct Convert<Keyblock::HistoryQuantity>
    : Keyblock::ChoiceConversion<Keyblock::HistoryQuantity>
  {};
  template <>
  struct Convert<Keyblock::SupportDirections>
    : Keyblock::ChoiceConversion<Keyblock::SupportDirections>
  {};
} // namespace dealii::Patterns::Tools

namespace Keyblock
{
  using namespace EntryPatterns;

  template <int dim>
  void
  Support<dim>::declare(ParameterHandler &prm)
  {
    prm.add_parameter(
      "Boundaries",
      boundaries,
      "Outer boundaries: left, right, bottom, top, front, back, "
      "all, or `id N` (N: number or name in the mesh file).");
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
                      "Stage on; held before; free field: the same for plumb "
                      "side boundaries, beside ground without excavations in "
                      "which the wave of the support at the bottom rises.");
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
      "rows, zero before the first and after the last. Times are counted from "
      "the beginning of History stage. The velocity with which an acceleration "
      "ends stays to the end of the dynamic stages, but for those after the "
      "first that have an Unbalanced ratio.");
    prm.add_parameter("History stage",
                      history_stage,
                      "Name of the stage from whose beginning the times of "
                      "History file are counted; before it nothing moves. "
                      "Empty: the first dynamic stage, of a quiet support the "
                      "first one from Stage on.");
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
      "first quasi-static or static stage, and keeps, a formula in x, y (z) "
      "per "
      "axis [m]; it may stand instead of Velocity.");
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
                      "top, front, back, all, or `id N` (N: number or name "
                      "in the mesh file).");
    prm.add_parameter(
      "Region",
      region,
      "Formula in x, y (z), positive on the parts of free faces to be loaded, "
      "which may cut faces; it may stand instead of Boundaries.");
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

  template struct Support<2>;
  template struct Support<3>;
  template struct Traction<2>;
  template struct Traction<3>;
} // namespace Keyblock
