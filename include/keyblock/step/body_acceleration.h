// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_step_body_acceleration_h
#define keyblock_step_body_acceleration_h

#include <keyblock/blocks/ground.h>
#include <keyblock/scene/gravity.h>

namespace Keyblock
{
  /** What acts on all masses: gravity, and the seismic coefficient of the
   * stage. */
  template <int dim>
  struct BodyAcceleration
  {
    explicit BodyAcceleration(const Scene<dim> &scene)
      : gravity(scene)
    {}

    /** Take the seismic coefficient of the stage of @p ground. */
    void
    take_ground(const Ground<dim> &ground)
    {
      seismic = standard_gravity *
                ground.scene.seismic_coefficient(ground.stage_number);
    }

    /** [m/s2] */
    Tensor<1, dim>
    at(const double time) const
    {
      return seismic + gravity.at(Point<dim>(), time);
    }

    const Gravity<dim> gravity;
    Tensor<1, dim> seismic; ///< of the stage [m/s2]
  };
} // namespace Keyblock

#endif
