// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/python/bindings.h>

namespace Keyblock::Python
{
  namespace
  {
    py::dict
    joint_points(const RunPointer &run)
    {
      const JointPointTable table =
        computed(false, [&]() { return run->joint_points(); });
      const py::object as_array = py::module_::import("numpy").attr("array");
      const py::object text     = py::module_::import("builtins").attr("str");
      py::dict points;
      points["joint"]    = as_array(table.joint, text);
      points["state"]    = as_array(table.state, text);
      points["blocks"]   = as_numpy(table.blocks);
      points["place"]    = as_numpy(table.place);
      points["normal"]   = as_numpy(table.normal);
      points["area"]     = as_numpy(table.area);
      points["gap"]      = as_numpy(table.gap);
      points["slip"]     = as_numpy(table.slip);
      points["pressure"] = as_numpy(table.pressure);
      points["shear"]    = as_numpy(table.shear);
      return points;
    }
  } // namespace



  void
  bind_joint_points(RunClass &run)
  {
    run.def_property_readonly(
      "joint_points",
      &joint_points,
      "Contact points of joints, of which both sides are there: dict of arrays "
      "with a row for each. `joint`: its name; `state`: bonded, sticking, "
      "sliding, open or welded (by rock that is excavated later); `blocks`: "
      "ids on its minus and its plus side, 0 is no block; `place` at the start "
      "(m); `normal` from minus to plus; `area` (m2; 2D: m); `gap`, positive "
      "where it is open, and `slip` of the plus side against the minus side, a "
      "vector (m); `pressure`, compression positive, and `shear` on the plus "
      "side, a vector (Pa).");
  }
} // namespace Keyblock::Python
