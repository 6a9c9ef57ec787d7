// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_safety_stress_ratio_h
#define keyblock_safety_stress_ratio_h

#include <keyblock/contact/contact.h>
#include <keyblock/safety/block_faces.h>

namespace Keyblock
{
  /**
   * Shear strength over shear force of a block with the forces of now, those
   * that contact has summed over it by joint (@p sums) [-]; 0: none. On the
   * faces that it moves along by @p limit; if it leaves all of them, as one
   * that falls, of each the part along its way; if it cannot move, on all.
   * Friction that depends on pressure is that of the mean one of now, cohesion
   * that of the points that are not open. Strength of faces that are not
   * reduced is taken from the force instead.
   */
  template <int dim>
  double stress_ratio(const std::vector<BlockFace<dim>> &faces,
                      const LimitEquilibrium<dim> &limit,
                      const std::vector<JointSums<dim>> &sums);
} // namespace Keyblock

#endif
