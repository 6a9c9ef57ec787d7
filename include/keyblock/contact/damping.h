// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_contact_damping_h
#define keyblock_contact_damping_h

#include <keyblock/base/vector.h>

#include <algorithm>
#include <cmath>

namespace Keyblock
{
  /**
   * Local non-viscous damping of one velocity component: the change of velocity
   * -alpha |total| sign(velocity), where @p total is the change that the total
   * force, contact included, makes in this step, but never more than what stops
   * the component. Without that limit the impulse of an impact, which stands in
   * the total of the step after it, throws the node off again and the scheme
   * gains energy; and a velocity that is only round-off would decide the sign.
   */
  inline double
  local_damping_change(const double velocity,
                       const double total,
                       const double alpha)
  {
    return -std::copysign(std::min(std::abs(velocity), alpha * std::abs(total)),
                          velocity);
  }

  /** Take local non-viscous damping out of a cluster's velocity: component i
   * of its total force loses alpha |F_i| against the old velocity. Returns
   * the change. */
  template <int dim>
  inline Vector<dim>
  damp_cluster(const Vector<dim> &velocity,
               const Vector<dim> &old_velocity,
               const double alpha)
  {
    Vector<dim> change{};
    for (int d = 0; d < dim; ++d)
      change[d] = local_damping_change(old_velocity[d],
                                       velocity[d] - old_velocity[d],
                                       alpha);
    return change;
  }
} // namespace Keyblock

#endif
