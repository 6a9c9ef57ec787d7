// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/scene/given.h>
#include <keyblock/scene/stage_defaults.h>

#include <algorithm>

namespace Keyblock
{
  namespace
  {
    /** Least damping ratio beside rigid bodies [-]. */
    constexpr double least_ratio = 0.02;
  } // namespace



  template <int dim>
  void
  damp_beside_rigid_bodies(Scene<dim> &scene)
  {
    if (!has_rigid_material(scene))
      return;
    for (const auto &stage : scene.stages)
      if (stage->is_quasi_static() && stage->local_damping > 0.)
        stage->damping_ratio = std::max(stage->damping_ratio, least_ratio);
  }



  template <int dim>
  void
  leave_steps_out(Scene<dim> &scene)
  {
    if (scene.safety.is_by_statics())
      for (const auto &stage : scene.stages)
        stage->kind = StageKind::static_solve;
  }



  template void leave_steps_out<2>(Scene<2> &);
  template void leave_steps_out<3>(Scene<3> &);
  template void damp_beside_rigid_bodies<2>(Scene<2> &);
  template void damp_beside_rigid_bodies<3>(Scene<3> &);
} // namespace Keyblock
