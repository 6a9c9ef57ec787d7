// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_predict_h
#define keyblock_predict_h

#include <keyblock/fields.h>
#include <keyblock/scene.h>

namespace Keyblock
{
  /** Work of nodal forces in one step, losses positive [J]. */
  struct NodeWork
  {
    double external = 0., stiffness_damping = 0., mass_damping = 0.,
           local_damping = 0.;
  };

  /**
   * Kick all nodes that may move (Fields::runs): add to their velocities
   * @p kick / mass times the forces of cells, loads and damping, after the
   * velocities were copied to fields.old_velocity. The impulse of local damping
   * is left in fields.local_damping, as the cap of a damped cluster needs it.
   *
   * With @p moves_inner nodes of inner runs are moved over @p dt at once; their
   * old velocities and impulses are not kept, and the work done on them is
   * returned.
   */
  template <int dim>
  NodeWork predict(const Stage &stage,
                   const double kick,
                   const double dt,
                   const bool moves_inner,
                   const bool is_large,
                   Fields<dim> &fields);
} // namespace Keyblock

#endif
