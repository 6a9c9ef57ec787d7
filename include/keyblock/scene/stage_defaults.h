// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_scene_stage_defaults_h
#define keyblock_scene_stage_defaults_h

#include <keyblock/scene/scene.h>

namespace Keyblock
{
  /**
   * Give quasi-static stages with local damping a little stiffness-proportional
   * damping where there are rigid bodies. A block that slides on one flutters,
   * and local damping, fed by that, takes all of the drive: the block creeps
   * for good (doc/theory.md, section 3).
   */
  template <int dim>
  void damp_beside_rigid_bodies(Scene<dim> &scene);

  /** Make stages static where limit equilibrium is all that is asked for; they
   * are not solved then, and need no kind. */
  template <int dim>
  void leave_steps_out(Scene<dim> &scene);
} // namespace Keyblock

#endif
