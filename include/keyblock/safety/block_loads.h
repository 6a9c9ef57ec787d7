// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_safety_block_loads_h
#define keyblock_safety_block_loads_h

#include <keyblock/base/expression.h>
#include <keyblock/blocks/face_quadrature.h>
#include <keyblock/blocks/free_faces.h>

namespace Keyblock
{
  /** A force and the point it acts at. */
  template <int dim>
  struct PointForce
  {
    Point<dim> place;     ///< [m]
    Tensor<1, dim> force; ///< [N], per metre in 2D
  };

  template <int dim>
  Tensor<1, dim> sum_of(const std::vector<PointForce<dim>> &forces);

  /** What acts on a block, but for what other blocks do. */
  template <int dim>
  struct BlockLoads
  {
    Point<dim> centroid;
    Tensor<1, dim> weight;                  ///< mass times gravity [N]
    Tensor<1, dim> seismic;                 ///< Seismic coefficient [N]
    std::vector<PointForce<dim>> tractions; ///< on free faces
    std::vector<PointForce<dim>> water;     ///< in joints
    Tensor<1, dim> water_along;             ///< its part along bent faces [N]

    /** All of it, water within the planes of joints excluded [N]. */
    Tensor<1, dim>
    without_water() const
    {
      return weight + seismic + sum_of(tractions) + water_along;
    }

    /** All of it, each where it acts. */
    std::vector<PointForce<dim>> all() const;
  };

  /** That of the stage of @p ground and, for limit equilibrium alone, of
   * 'Safety factor/Seismic coefficient' [m/s2]. */
  template <int dim>
  Tensor<1, dim>
  seismic_acceleration_with_safety(const Ground<dim> &ground)
  {
    Tensor<1, dim> coefficient =
      ground.scene.seismic_coefficient(ground.stage_number);
    const auto &more = ground.scene.safety.seismic_coefficient;
    for (unsigned int d = 0; d < more.size(); ++d)
      coefficient[d] += more[d];
    return standard_gravity * coefficient;
  }

  /** Weight and seismic load of a block at @p time, at its centroid. */
  template <int dim>
  BlockLoads<dim> body_forces_on(const Ground<dim> &ground,
                                 const FreeFaces<dim> &free,
                                 const Block<dim> &block,
                                 const double time);

  /** Tractions at @p time on the free faces of a block (by index). */
  template <int dim>
  std::vector<PointForce<dim>> tractions_on(const Ground<dim> &ground,
                                            const FreeFaces<dim> &free,
                                            const unsigned int block,
                                            const double time);

  /** Forces of a pressure over a face: of its area times the unit
   * vector @p inward [N]. */
  template <int dim>
  std::vector<PointForce<dim>> pressure_on(const FaceCorners<dim> &face,
                                           const Expression<dim> &pressure,
                                           const double time,
                                           const Tensor<1, dim> &inward);
} // namespace Keyblock

#endif
