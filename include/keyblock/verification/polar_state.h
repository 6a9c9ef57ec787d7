// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_verification_polar_state_h
#define keyblock_verification_polar_state_h

#include <keyblock/rock/initial_stress.h>
#include <keyblock/verification/tools.h>

#include <array>
#include <cmath>

namespace Keyblock
{
  /** Greatest over least principal stress of cohesionless rock that yields. */
  inline double
  slope_of(const double angle_in_degrees)
  {
    const double sine = std::sin(angle_in_degrees * dealii::numbers::PI / 180.);
    return (1. + sine) / (1. - sine);
  }

  /** Stress (compression positive) and displacement in polar coordinates. */
  struct PolarState
  {
    double radial_stress, hoop_stress, shear_stress; ///< [Pa]
    double radial, tangential;                       ///< displacements [m]
  };

  /** At a place, or in the middle of the model [Pa]. */
  template <int dim>
  std::array<double, n_stress<dim>>
  initial_stress(const CheckInput<dim> &input, const Point<dim> &place)
  {
    std::array<double, n_stress<dim>> stress;
    InitialStress<dim>(input.scene.initial_state)
      .evaluate(place, stress.data());
    return stress;
  }
} // namespace Keyblock

#endif
