// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/excavation_region.h>
#include <keyblock/mesh_size.h>

#include <algorithm>
#include <cmath>

namespace Keyblock
{
  namespace
  {
    /** Cells from the middle of a joint to its rim: about one simplex. */
    constexpr double cells_in_half_width = 2.5;
  } // namespace



  template <int dim>
  MeshSize<dim>::MeshSize(const Scene<dim> &scene, const double longest_side)
    : scene(scene)
    , distance(scene.meshing.grading_distance > 0.
                 ? scene.meshing.grading_distance
                 : longest_side / 4.)
  {
    const Meshing<dim> &meshing = scene.meshing;
    const double least          = meshing.size_at_excavation > 0.
                                    ? std::min(meshing.size, meshing.size_at_excavation)
                                    : meshing.size;
    for (const auto &joint : scene.joints)
      {
        const JointExtent<dim> extent(*joint);
        const double size =
          meshing.size_at_joints > 0.
            ? meshing.size_at_joints
            : std::max(least, extent.half_width() / cells_in_half_width);
        if (size < meshing.size)
          joints.push_back({extent, size});
      }
  }



  template <int dim>
  double
  MeshSize<dim>::operator()(const Point<dim> &p) const
  {
    const Meshing<dim> &meshing = scene.meshing;
    double size                 = meshing.size;
    const auto restrict_to      = [&](const double least, const double away) {
      const double part = std::min(1., away / distance);
      size              = std::min(size, least + part * (meshing.size - least));
    };
    if (meshing.size_at_excavation > 0.)
      for (const auto &excavation : scene.excavations)
        restrict_to(meshing.size_at_excavation,
                    std::abs(depth_inside(*excavation, p)));
    for (const SizeAtJoint &joint : joints)
      if (joint.size < size)
        restrict_to(joint.size, joint.extent.distance_to_joint(p));
    return size;
  }

  template class MeshSize<2>;
  template class MeshSize<3>;
} // namespace Keyblock
