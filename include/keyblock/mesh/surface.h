// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_mesh_surface_h
#define keyblock_mesh_surface_h

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

namespace Keyblock
{
  using dealii::Point;
  using dealii::Tensor;

  constexpr unsigned int no_index = static_cast<unsigned int>(-1);

  /** What vertices of a simplex mesh may be bound to: the plane of a joint, or
   * a plane (2D: line or circle) of the model's outline or of an excavation, or
   * that of a triangle on a curved one. */
  template <int dim>
  struct Surface
  {
    Point<dim> point;              ///< on the plane; centre of the circle [m]
    Tensor<1, dim> normal;         ///< unit; not used for a circle
    double radius      = 0.;       ///< of the circle; 0: a plane [m]
    unsigned int joint = no_index; ///< index into Scene::joints, or no_index
    bool is_curved     = false;    ///< the plane of a chord of it

    /** Sine between planes up to which a vertex on both may slide on one: on a
     * curved surface it leaves the other by less than the chords do. */
    double
    least_sine() const
    {
      return is_curved ? 0.5 : 1e-6;
    }

    bool
    is_joint() const
    {
      return joint != no_index;
    }

    /** Signed distance [m] of @p p, positive where the normal points to
     * (outside the circle). */
    double
    distance(const Point<dim> &p) const
    {
      return radius > 0. ? p.distance(point) - radius : normal * (p - point);
    }

    /** Unit normal at the point of the surface nearest to @p p. */
    Tensor<1, dim>
    normal_at(const Point<dim> &p) const
    {
      return radius > 0. ? (p - point) / p.distance(point) : normal;
    }
  };
} // namespace Keyblock

#endif
