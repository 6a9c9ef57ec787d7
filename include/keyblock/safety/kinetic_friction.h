// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_safety_kinetic_friction_h
#define keyblock_safety_kinetic_friction_h

#include <keyblock/scene/scene.h>

#include <algorithm>

namespace Keyblock
{
  /** Whether friction of a joint falls where it slips. */
  template <int dim>
  bool
  has_kinetic_friction(const Scene<dim> &scene)
  {
    return std::any_of(scene.joints.begin(),
                       scene.joints.end(),
                       [](const auto &joint) {
                         return joint->kinetic_friction_angle >= 0. &&
                                joint->kinetic_friction_angle <
                                  joint->friction_angle;
                       });
  }
} // namespace Keyblock

#endif
