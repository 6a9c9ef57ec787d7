// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_safety_reduced_joints_h
#define keyblock_safety_reduced_joints_h

#include <keyblock/mesh/mesh.h>
#include <keyblock/scene/scene.h>

#include <vector>

namespace Keyblock
{
  /** Which joints' strength factors divide ('Safety factor/Joints'), by index;
   * empty: all of them. */
  template <int dim>
  std::vector<bool>
  list_reduced_joints(const Scene<dim> &scene)
  {
    std::vector<bool> is_reduced;
    if (!scene.safety.joints.empty())
      is_reduced.assign(scene.joints.size(), false);
    for (const std::string &name : scene.safety.joints)
      for (const unsigned int joint : scene.joints_called(name))
        is_reduced[joint] = true;
    return is_reduced;
  }

  /** Whether a list of list_reduced_joints() has a @p joint (`none`: what is no
   * joint, which only the empty one has). */
  inline bool
  has_reduced(const std::vector<bool> &list, const unsigned int joint)
  {
    return list.empty() || (joint != none && list[joint]);
  }
} // namespace Keyblock

#endif
