// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/cell_geometry.h>
#include <keyblock/internal_force.h>

namespace Keyblock
{
  namespace
  {
    template <int dim>
    inline Corners<dim, double>
    gather(const std::array<unsigned int, 1 << dim> &nodes, const double *field)
    {
      Corners<dim, double> values;
      for (int a = 0; a < (1 << dim); ++a)
        for (int d = 0; d < dim; ++d)
          values[a][d] = field[dim * nodes[a] + d];
      return values;
    }

    template <int dim>
    inline void
    scatter(const std::array<unsigned int, 1 << dim> &nodes,
            const Corners<dim, double> &values,
            double *field)
    {
      for (int a = 0; a < (1 << dim); ++a)
        for (int d = 0; d < dim; ++d)
          field[dim * nodes[a] + d] += values[a][d];
    }

    /** sum of rate times gradient, over the vertices, times @p factor */
    template <int dim>
    inline Gradient<dim, double>
    rate_gradient(const Corners<dim, double> &rate,
                  const Corners<dim, double> &gradient,
                  const double factor)
    {
      Gradient<dim, double> result;
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j)
          {
            double sum = 0.;
            for (int a = 0; a < (1 << dim); ++a)
              sum += rate[a][i] * gradient[a][j];
            result[i][j] = sum * factor;
          }
      return result;
    }

    template <int dim>
    inline void
    add_force(const double *stress,
              const Corners<dim, double> &gradient,
              Corners<dim, double> &force)
    {
      for (int a = 0; a < (1 << dim); ++a)
        {
          const auto f = apply_stress<dim, double>(stress, gradient[a]);
          for (int d = 0; d < dim; ++d)
            force[a][d] += f[d] * Shape<dim>::weight;
        }
    }

    template <int dim, bool is_large, bool has_damping>
    void
    pass_over_cells(const double step,
                    CellArrays<dim> &cells,
                    const double *position,
                    const double *rate,
                    double *internal,
                    double *damping)
    {
      constexpr int n            = 1 << dim;
      const unsigned int n_cells = cells.nodes.size();
      for (unsigned int c = 0; c < n_cells; ++c)
        {
          const Corners<dim, double> x = gather<dim>(cells.nodes[c], position);
          const Corners<dim, double> v = gather<dim>(cells.nodes[c], rate);
          Corners<dim, double> middle  = x;
          if constexpr (is_large)
            for (int a = 0; a < n; ++a)
              for (int d = 0; d < dim; ++d)
                middle[a][d] -= 0.5 * step * v[a][d];

          Corners<dim, double> force{}, damping_force{}, gradient;
          const double lambda = cells.lambda[c], mu = cells.mu[c];
          for (int q = 0; q < n; ++q)
            {
              double *stress = cells.stress_of(c) + q * n_stress<dim>;
              const double determinant =
                gradients_times_determinant<dim>(q, middle, gradient);
              Gradient<dim, double> g =
                rate_gradient<dim>(v, gradient, 1. / determinant);
              std::array<double, n_stress<dim>> viscous{};
              if constexpr (has_damping)
                add_elastic_stress<dim>(g,
                                        lambda * cells.beta[c],
                                        mu * cells.beta[c],
                                        viscous.data());
              for (auto &row : g)
                for (double &entry : row)
                  entry *= step;
              if constexpr (is_large)
                {
                  rotate_stress<dim>(g, stress);
                  gradients_times_determinant<dim>(q, x, gradient);
                }
              add_elastic_stress<dim>(g, lambda, mu, stress);
              add_force<dim>(stress, gradient, force);
              if constexpr (has_damping)
                add_force<dim>(viscous.data(), gradient, damping_force);
            }
          scatter<dim>(cells.nodes[c], force, internal);
          if constexpr (has_damping)
            scatter<dim>(cells.nodes[c], damping_force, damping);
        }
    }
  } // namespace



  template <int dim>
  void
  add_internal_force(const ForcePass &pass,
                     CellArrays<dim> &cells,
                     const double *position,
                     const double *rate,
                     double *internal,
                     double *damping)
  {
    const auto run =
      pass.is_large ? (pass.has_damping ? pass_over_cells<dim, true, true>
                                        : pass_over_cells<dim, true, false>)
                    : (pass.has_damping ? pass_over_cells<dim, false, true>
                                        : pass_over_cells<dim, false, false>);
    run(pass.step, cells, position, rate, internal, damping);
  }



  template <int dim>
  double
  elastic_energy(const CellArrays<dim> &cells, const double *position)
  {
    double energy = 0.;
    Corners<dim, double> gradient;
    for (unsigned int c = 0; c < cells.nodes.size(); ++c)
      {
        const auto x = gather<dim>(cells.nodes[c], position);
        for (int q = 0; q < (1 << dim); ++q)
          energy +=
            gradients_times_determinant<dim>(q, x, gradient) *
            Shape<dim>::weight *
            elastic_energy_density<dim>(cells.stress_of(c) + q * n_stress<dim>,
                                        cells.lambda[c],
                                        cells.mu[c]);
      }
    return energy;
  }

  template void add_internal_force(const ForcePass &,
                                   CellArrays<2> &,
                                   const double *,
                                   const double *,
                                   double *,
                                   double *);
  template void add_internal_force(const ForcePass &,
                                   CellArrays<3> &,
                                   const double *,
                                   const double *,
                                   double *,
                                   double *);
  template double elastic_energy(const CellArrays<2> &, const double *);
  template double elastic_energy(const CellArrays<3> &, const double *);
} // namespace Keyblock
