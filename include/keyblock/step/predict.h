// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_step_predict_h
#define keyblock_step_predict_h

#include <keyblock/rock/fields.h>
#include <keyblock/scene/scene.h>

namespace Keyblock
{
  /** What one call of predict() does with the nodes. */
  struct NodePass
  {
    double kick;      ///< force times this over mass is the kick [s]
    double dt;        ///< step [s]
    bool moves_inner; ///< move the nodes of inner runs at once
    bool is_large;    ///< cells follow their nodes: positions are kept
    bool has_damping; ///< Fields::damping_force acts
    const std::vector<NodeRun> &runs; ///< nodes to work on
  };

  /** Work of nodal forces in one step, losses positive [J]. */
  struct NodeWork
  {
    double external = 0., stiffness_damping = 0., mass_damping = 0.,
           local_damping = 0.;
  };

  /**
   * Kick the nodes of pass.runs: add to their velocities
   * pass.kick / mass times the forces of cells, loads and damping, after the
   * velocities were copied to fields.old_velocity. The impulse of local damping
   * is left in fields.local_damping, as the cap of a damped cluster needs it.
   *
   * With pass.moves_inner nodes of inner runs are moved at once; their old
   * velocities and impulses are not kept, and the work done on them is
   * returned.
   */
  template <int dim>
  NodeWork
  predict(const Stage &stage, const NodePass &pass, Fields<dim> &fields);
} // namespace Keyblock

#endif
