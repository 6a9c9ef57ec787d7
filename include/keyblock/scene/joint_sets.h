// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_scene_joint_sets_h
#define keyblock_scene_joint_sets_h

#include <keyblock/scene/scene.h>

namespace Keyblock
{
  /**
   * Make the joints of a set: SET.1, SET.2, ... in the order drawn, without
   * those that lie outside the domain. The same entries give the same joints,
   * to the last bit, on any machine and any number of ranks.
   *
   * Poles scatter about the mean one by Fisher's law, in 2D by von Mises'.
   * Discs: their centres are a Poisson process in the region, of
   * P32 / (pi E[r^2]) a volume, in 2D P21 / (2 E[r]) an area. Planes: a Poisson
   * process as well, uniform in the distance of the plane from the middle of
   * the domain, P32 a metre; or at constant distances. P10 along the mean
   * normal is P32 E|cos(angle to the mean pole)|, and the spacing 1 / P10.
   *
   * Throws InputError with one sentence if entries contradict each other. The
   * domain must have been checked.
   */
  template <int dim>
  std::vector<std::unique_ptr<Joint<dim>>>
  make_joints_of_set(const JointSet<dim> &set, const Domain<dim> &domain);

  /** Sets of finite joints in 3D that fill the domain with very many, as long
   * as the scene's joints are as they were made. */
  template <int dim>
  std::vector<std::string> warnings_of_sets(const Scene<dim> &scene);

  /** E|cos| of the angle between a pole and the mean one, by Fisher's law or,
   * in 2D, von Mises'; negative @p concentration: all are parallel. */
  template <int dim>
  double mean_cosine(const double concentration);

  /** Area per volume [1/m] (length per area in 2D) that the set is to have. */
  template <int dim>
  double intensity_of(const JointSet<dim> &set);
} // namespace Keyblock

#endif
