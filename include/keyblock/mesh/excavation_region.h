// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_mesh_excavation_region_h
#define keyblock_mesh_excavation_region_h

#include <keyblock/scene/scene.h>

namespace Keyblock
{
  /**
   * Distance [m] of @p p from the outline of @p excavation, positive inside,
   * negative outside.
   */
  template <int dim>
  double depth_inside(const Excavation<dim> &excavation, const Point<dim> &p);

  /** Least side [m] of the box around an excavation, or of those around its
   * solids; 1e300 if it has no
   * outline. */
  template <int dim>
  double narrowest_side(const Excavation<dim> &excavation);
} // namespace Keyblock

#endif
