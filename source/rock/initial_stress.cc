// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/rock/initial_stress.h>

#include <cmath>

namespace Keyblock
{
  template <int dim>
  InitialStress<dim>::InitialStress(const InitialState<dim> &state)
    : state(state)
  {
    if (!state.stress.empty())
      formula = std::make_unique<Expression<dim>>(state.stress,
                                                  n_stress<dim>,
                                                  "Initial state/Stress");
  }



  template <int dim>
  void
  InitialStress<dim>::evaluate(const Point<dim> &place, double *stress) const
  {
    if (formula)
      {
        for (int k = 0; k < n_stress<dim>; ++k)
          stress[k] = formula->value(place, 0., k);
        return;
      }
    const double depth = state.surface_elevation - place[dim - 1];
    const double vertical =
      -(state.surface_stress + state.vertical_stress_gradient * depth);
    const double along  = vertical * state.lateral_ratios.front();
    const double across = vertical * state.lateral_ratios.back();
    std::fill(stress, stress + n_stress<dim>, 0.);
    if constexpr (dim == 2)
      {
        stress[0] = along;
        stress[1] = vertical;
        stress[2] = across;
      }
    else
      {
        // x = east, y = north; the azimuth is clockwise from north
        const double azimuth =
          state.lateral_azimuth * dealii::numbers::PI / 180.;
        const double e = std::sin(azimuth), n = std::cos(azimuth);
        stress[0] = along * e * e + across * n * n;
        stress[1] = along * n * n + across * e * e;
        stress[2] = vertical;
        stress[5] = (along - across) * e * n;
      }
  }

  template class InitialStress<2>;
  template class InitialStress<3>;
} // namespace Keyblock
