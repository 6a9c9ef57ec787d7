// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_scene_near_misses_h
#define keyblock_scene_near_misses_h

#include <keyblock/scene/scene.h>

#include <vector>

namespace Keyblock
{
  /** A joint that ends just before another one. */
  struct NearMiss
  {
    unsigned int joint, other; ///< in Scene::joints
    double gap;                ///< in the plane of the joint [m]
  };

  /** Gaps up to so many times `Joints/Bridging` are listed. */
  constexpr double just_beyond = 10.;

  /** Joints whose rim ends before another joint, farther away than @p least and
   * not farther than @p most [m], the smallest gap first. */
  template <int dim>
  std::vector<NearMiss> list_near_misses(const Scene<dim> &scene,
                                         const double least,
                                         const double most);
} // namespace Keyblock

#endif
