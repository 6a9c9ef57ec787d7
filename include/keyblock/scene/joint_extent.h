// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_scene_joint_extent_h
#define keyblock_scene_joint_extent_h

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <keyblock/scene/scene.h>

#include <vector>

namespace Keyblock
{
  /** Plane and rim of a joint, for many questions: what Joint derives from its
   * entries at each call is kept here. */
  template <int dim>
  class JointExtent
  {
  public:
    explicit JointExtent(const Joint<dim> &joint);

    const Tensor<1, dim> normal;
    const Point<dim> origin; ///< a point on the plane

    /** Signed distance [m] of @p p from the plane. */
    double
    distance(const Point<dim> &p) const
    {
      return normal * (p - origin);
    }

    /** Distance [m] within the plane from the foot of @p p to the rim,
     * positive inside the joint; 1e300 for an infinite one. */
    double depth_inside(const Point<dim> &p) const;

    /** Distance [m] of @p p from the nearest point of the joint. */
    double distance_to_joint(const Point<dim> &p) const;

    /** Radius of a disc, half the length of a trace, twice the area over the
     * perimeter of a polygon; 1e300 for an infinite joint [m]. */
    double half_width() const;

    /** Length (2D) or area (3D) of a finite joint [m^(dim-1)]. */
    double area() const;

    /** Points of a finite joint that reach farthest [m]. */
    std::vector<Point<dim>> outermost_points() const;

    bool
    is_infinite() const
    {
      return shape == JointShape::infinite;
    }

  private:
    JointShape shape;
    Point<dim> center;
    double radius;
    std::vector<Point<dim>> corners; ///< on the plane
    unsigned int axes[2];            ///< in 3D those to project along
  };
} // namespace Keyblock

#endif
