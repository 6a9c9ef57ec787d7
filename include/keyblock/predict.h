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
   * Kick the owned nodes of @p ranges (first, one past the last): add to their
   * velocities @p kick / mass times the forces of cells, loads and damping. The
   * impulse of local damping is left in fields.local_damping, as the cap of a
   * damped cluster needs it.
   */
  template <int dim>
  void predict(const Stage &stage,
               const double kick,
               const NodeRanges &ranges,
               Fields<dim> &fields);

  /**
   * Kick and move the inner nodes (Fields::inner_nodes) in one pass: nothing
   * but cells, loads and damping acts on them. Returns the work done.
   */
  template <int dim>
  NodeWork advance_inner_nodes(const Stage &stage,
                               const double kick,
                               const double dt,
                               const bool is_large,
                               Fields<dim> &fields);
} // namespace Keyblock

#endif
