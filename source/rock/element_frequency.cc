// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/rock/cell_geometry.h>
#include <keyblock/rock/internal_force.h>

#include <algorithm>
#include <cmath>

namespace Keyblock
{
  template <int dim>
  std::array<double, 1 << dim>
  lumped_mass(const std::array<std::array<double, dim>, 1 << dim> &corners,
              const double density)
  {
    std::array<double, 1 << dim> mass{};
    Corners<dim, double> gradient;
    for (int q = 0; q < (1 << dim); ++q)
      {
        const double weight =
          density * Shape<dim>::weight *
          gradients_times_determinant<dim>(q, corners, gradient);
        for (int a = 0; a < (1 << dim); ++a)
          mass[a] += weight * shape<dim>.value[q][a];
      }
    return mass;
  }



  namespace
  {
    /** Stiffness matrix scaled by the roots of the masses on both sides. */
    template <int dim>
    using ScaledStiffness =
      std::array<std::array<double, dim *(1 << dim)>, dim *(1 << dim)>;

    template <int dim>
    ScaledStiffness<dim>
    scaled_stiffness(const Corners<dim, double> &corners,
                     const double lambda,
                     const double mu,
                     const std::array<double, 1 << dim> &mass)
    {
      constexpr int n = 1 << dim;
      ScaledStiffness<dim> k{};
      Corners<dim, double> g;
      for (int q = 0; q < n; ++q)
        {
          const double determinant =
            gradients_times_determinant<dim>(q, corners, g);
          const double weight = Shape<dim>::weight / determinant;
          for (int a = 0; a < n; ++a)
            for (int b = 0; b < n; ++b)
              {
                double dot = 0.;
                for (int d = 0; d < dim; ++d)
                  dot += g[a][d] * g[b][d];
                const double scale = weight / std::sqrt(mass[a] * mass[b]);
                for (int i = 0; i < dim; ++i)
                  {
                    for (int j = 0; j < dim; ++j)
                      k[a * dim + i][b * dim + j] +=
                        scale *
                        (lambda * g[a][i] * g[b][j] + mu * g[a][j] * g[b][i]);
                    k[a * dim + i][b * dim + i] += scale * mu * dot;
                  }
              }
        }
      return k;
    }
  } // namespace



  template <int dim>
  double
  highest_frequency(
    const std::array<std::array<double, dim>, 1 << dim> &corners,
    const double lambda,
    const double mu,
    const double density)
  {
    constexpr int n = dim * (1 << dim);
    const auto mass = lumped_mass<dim>(corners, density);
    const auto k    = scaled_stiffness<dim>(corners, lambda, mu, mass);

    // power iteration; the residual bounds what is still missing
    std::array<double, n> x, y;
    for (int i = 0; i < n; ++i)
      x[i] = std::sin(1. + 2.3 * i);
    double eigenvalue = 0., residual = 0.;
    for (int iteration = 0; iteration < 300; ++iteration)
      {
        double xx = 0., xy = 0., yy = 0.;
        for (int i = 0; i < n; ++i)
          {
            double sum = 0.;
            for (int j = 0; j < n; ++j)
              sum += k[i][j] * x[j];
            y[i] = sum;
            xx += x[i] * x[i];
            xy += x[i] * sum;
            yy += sum * sum;
          }
        eigenvalue = xy / xx;
        residual   = std::sqrt(std::max(0., yy / xx - eigenvalue * eigenvalue));
        const double norm = std::sqrt(yy);
        for (int i = 0; i < n; ++i)
          x[i] = y[i] / norm;
        if (residual < 1e-4 * eigenvalue)
          break;
      }
    // rounded up to nine digits, so that congruent cells give one and the same
    // time step on any number of ranks
    const double frequency = std::sqrt(eigenvalue + residual);
    const double digit = std::pow(10., std::floor(std::log10(frequency)) - 8.);
    return std::ceil(frequency / digit) * digit;
  }

  template std::array<double, 4>
  lumped_mass<2>(const std::array<std::array<double, 2>, 4> &, const double);
  template std::array<double, 8>
  lumped_mass<3>(const std::array<std::array<double, 3>, 8> &, const double);
  template double
  highest_frequency<2>(const std::array<std::array<double, 2>, 4> &,
                       const double,
                       const double,
                       const double);
  template double
  highest_frequency<3>(const std::array<std::array<double, 3>, 8> &,
                       const double,
                       const double,
                       const double);
} // namespace Keyblock
