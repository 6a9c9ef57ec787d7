// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_scene_gravity_h
#define keyblock_scene_gravity_h

#include <keyblock/base/expression.h>
#include <keyblock/scene/scene.h>

#include <memory>

namespace Keyblock
{
  /** Gravity by 'Initial state/Gravity' of a scene. */
  template <int dim>
  class Gravity
  {
  public:
    explicit Gravity(const Scene<dim> &scene)
      : is_varying(depends_on_time(scene.initial_state.gravity))
    {
      const std::string &text = scene.initial_state.gravity;
      if (!text.empty())
        formula =
          std::make_unique<Expression<dim>>(text, dim, "Initial state/Gravity");
    }

    bool
    is_given() const
    {
      return formula != nullptr;
    }

    /** Zero if none is given [m/s2]. */
    Tensor<1, dim>
    at(const Point<dim> &place, const double time) const
    {
      return formula ? formula->vector(place, time) : Tensor<1, dim>();
    }

    const bool is_varying; ///< depends on time

  private:
    std::unique_ptr<Expression<dim>> formula;
  };

  /** Unit vector against gravity at the origin and time zero; along the last
   * axis if there is none. */
  template <int dim>
  Tensor<1, dim>
  upward(const Scene<dim> &scene)
  {
    const Tensor<1, dim> gravity = Gravity<dim>(scene).at(Point<dim>(), 0.);
    if (gravity.norm() > 0.)
      return -gravity / gravity.norm();
    Tensor<1, dim> up;
    up[dim - 1] = 1.;
    return up;
  }
} // namespace Keyblock

#endif
