// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_rock_initial_stress_h
#define keyblock_rock_initial_stress_h

#include <keyblock/base/expression.h>
#include <keyblock/rock/material.h>
#include <keyblock/scene/scene.h>

#include <memory>

namespace Keyblock
{
  /**
   * The stress before anything is excavated, tension positive: by formulas, or
   * growing with depth below a ground surface, with lateral stresses in ratio
   * to the vertical one and, in 3D, turned to an azimuth.
   */
  template <int dim>
  class InitialStress
  {
  public:
    explicit InitialStress(const InitialState<dim> &state);

    /** Write n_stress<dim> components at @p place to @p stress [Pa]. */
    void evaluate(const Point<dim> &place, double *stress) const;

  private:
    const InitialState<dim> &state;
    std::unique_ptr<Expression<dim>> formula;
  };
} // namespace Keyblock

#endif
