// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/numerics/rtree.h>

#include <keyblock/mesh/excavation_region.h>
#include <keyblock/mesh/size.h>

#include <algorithm>
#include <cmath>

namespace Keyblock
{
  namespace
  {
    /** Cells from the middle of a joint to its rim: about one simplex. */
    constexpr double cells_in_half_width = 2.5;

    /** Parts of the domain and of the narrowest excavation that stand for sizes
     * that are not given. */
    template <int dim>
    constexpr double cells_along_domain      = (dim == 2) ? 20. : 12.;
    constexpr double cells_across_excavation = 10.;

    /** How fast sizes grow at most with the distance from places of demands
     * [-]: Gmsh does not see steeper islands of small cells. */
    constexpr double steepest = 0.2;
  } // namespace



  /** Places of one demand. */
  template <int dim>
  struct MeshSize<dim>::SizeAtPlaces
  {
    double size;
    dealii::RTree<Point<dim>> tree;
  };



  template <int dim>
  MeshSize<dim>::MeshSize(const Scene<dim> &scene,
                          const double longest_side,
                          const std::vector<SizeDemand<dim>> &demands)
    : scene(scene)
    , distance(scene.meshing.grading_distance > 0.
                 ? scene.meshing.grading_distance
                 : longest_side / 4.)
    , far(scene.meshing.size > 0. ? scene.meshing.size
                                  : longest_side / cells_along_domain<dim>)
    , at_excavation(far)
  {
    const Meshing<dim> &meshing = scene.meshing;
    if (meshing.size_at_excavation > 0.)
      at_excavation = meshing.size_at_excavation;
    else if (meshing.cells_across > 0. || meshing.size == 0.)
      for (const auto &excavation : scene.excavations)
        at_excavation =
          std::min(at_excavation,
                   narrowest_side(*excavation) / cells_across_excavation);
    const double least = std::min(far, at_excavation);
    for (const auto &joint : scene.joints)
      {
        const JointExtent<dim> extent(*joint);
        // (a facet need not have cells of its own: its neighbours go on)
        const double size =
          meshing.size_at_joints > 0. ? meshing.size_at_joints
          : joint->surface.empty()
            ? std::max(least, extent.half_width() / cells_in_half_width)
            : far;
        if (size < far)
          joints.push_back({extent, size});
      }
    for (const SizeDemand<dim> &demand : demands)
      if (demand.size < far && !demand.places.empty())
        places.push_back(std::make_unique<SizeAtPlaces>(
          SizeAtPlaces{demand.size, dealii::pack_rtree(demand.places)}));
  }

  template <int dim>
  MeshSize<dim>::~MeshSize() = default;



  template <int dim>
  double
  MeshSize<dim>::least() const
  {
    return scene.meshing.least_size > 0. ? scene.meshing.least_size
                                         : std::min(far, at_excavation) / 4.;
  }



  template <int dim>
  double
  MeshSize<dim>::smallest() const
  {
    double size = std::min(far, at_excavation);
    for (const SizeAtJoint &joint : joints)
      size = std::min(size, joint.size);
    for (const auto &demand : places)
      size = std::min(size, demand->size);
    return size;
  }



  template <int dim>
  double
  MeshSize<dim>::steepness() const
  {
    return (far - smallest()) / distance;
  }



  template <int dim>
  double
  MeshSize<dim>::operator()(const Point<dim> &p) const
  {
    namespace bgi        = boost::geometry::index;
    double size          = far;
    const auto size_over = [&](const double least, const double away) {
      return least + std::min(1., away / distance) * (far - least);
    };
    const auto restrict_to = [&](const double least, const double away) {
      size = std::min(size, size_over(least, away));
    };
    const auto size_near = [&](const double least, const double away) {
      const double slope = std::min(steepest, (far - least) / distance);
      return least + slope * away;
    };
    if (at_excavation != far)
      for (const auto &excavation : scene.excavations)
        restrict_to(at_excavation, std::abs(depth_inside(*excavation, p)));
    for (const SizeAtJoint &joint : joints)
      if (size_over(joint.size, std::abs(joint.extent.distance(p))) < size)
        restrict_to(joint.size, joint.extent.distance_to_joint(p));
    for (const auto &demand : places)
      if (demand->size < size)
        {
          const double from_box =
            boost::geometry::distance(p, demand->tree.bounds());
          if (size_near(demand->size, from_box) < size)
            for (auto nearest = demand->tree.qbegin(bgi::nearest(p, 1));
                 nearest != demand->tree.qend();
                 ++nearest)
              size =
                std::min(size, size_near(demand->size, p.distance(*nearest)));
        }
    return size;
  }

  template class MeshSize<2>;
  template class MeshSize<3>;
} // namespace Keyblock
