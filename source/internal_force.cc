// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/cell_geometry.h>
#include <keyblock/internal_force.h>

#include <algorithm>
#include <cmath>

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

    /** The Gauss points of one cell: gradients of the shape functions times
     * the determinant, and displacement gradients. */
    template <int dim>
    struct CellPoints
    {
      std::array<Corners<dim, double>, 1 << dim> gradient;
      std::array<double, 1 << dim> determinant;
      std::array<Gradient<dim, double>, 1 << dim> rate;
    };

    template <int dim>
    inline double
    trace(const Gradient<dim, double> &g)
    {
      double sum = 0.;
      for (int d = 0; d < dim; ++d)
        sum += g[d][d];
      return sum;
    }

    /** Third of what the mean dilatation of the cell adds to that of each
     * point. */
    template <int dim>
    inline std::array<double, 1 << dim>
    dilatation_corrections(const CellPoints<dim> &points)
    {
      double volume = 0., change = 0.;
      for (int q = 0; q < (1 << dim); ++q)
        {
          volume += points.determinant[q];
          change += points.determinant[q] * trace<dim>(points.rate[q]);
        }
      std::array<double, 1 << dim> third;
      for (int q = 0; q < (1 << dim); ++q)
        third[q] = (change / volume - trace<dim>(points.rate[q])) / 3.;
      return third;
    }

    /** Strain g + third * 1 in all three directions: adds the elastic stress of
     * both. */
    template <int dim>
    inline void
    add_corrected_stress(const Gradient<dim, double> &g,
                         const double third,
                         const double lambda,
                         const double mu,
                         double *stress)
    {
      add_elastic_stress<dim>(g, lambda, mu, stress);
      for (int k = 0; k < 3; ++k)
        stress[k] += (3. * lambda + 2. * mu) * third;
    }

    /** Forces of the stresses of all points with the mean pressure of the cell:
     * the transpose of the averaged dilatation. */
    template <int dim>
    inline void
    add_averaged_force(const double *stress,
                       const CellPoints<dim> &points,
                       Corners<dim, double> &force)
    {
      double volume = 0., mean = 0.;
      std::array<double, 1 << dim> pressure;
      for (int q = 0; q < (1 << dim); ++q)
        {
          const double *s = stress + q * n_stress<dim>;
          pressure[q]     = (s[0] + s[1] + s[2]) / 3.;
          volume += points.determinant[q];
          mean += points.determinant[q] * pressure[q];
        }
      mean /= volume;
      std::array<double, n_stress<dim>> s;
      for (int q = 0; q < (1 << dim); ++q)
        {
          for (int k = 0; k < n_stress<dim>; ++k)
            s[k] = stress[q * n_stress<dim> + k];
          for (int k = 0; k < 3; ++k)
            s[k] += mean - pressure[q];
          add_force<dim>(s.data(), points.gradient[q], force);
        }
    }

    /** Mean of two stresses times the plastic strain that leads from @p trial
     * to @p stress [J/m3], and the size of that strain. */
    template <int dim>
    inline double
    plastic_work_density(const double *before,
                         const double *trial,
                         const double *stress,
                         const double lambda,
                         const double mu,
                         double &size)
    {
      const double volume =
        (trial[0] + trial[1] + trial[2] - stress[0] - stress[1] - stress[2]) *
        lambda / (3. * lambda + 2. * mu);
      double work = 0., square = 0.;
      for (int k = 0; k < n_stress<dim>; ++k)
        {
          const double strain =
            (trial[k] - stress[k] - (k < 3 ? volume : 0.)) / (2. * mu);
          const double weight = k < 3 ? 1. : 2.;
          work += weight * 0.5 * (before[k] + stress[k]) * strain;
          square += weight * strain * strain;
        }
      size = std::sqrt(2. / 3. * square);
      return work;
    }

    /** Advance the stress of a Gauss point that may yield; returns the plastic
     * work [J/m3]. */
    template <int dim>
    inline double
    advance_plastic_point(const Gradient<dim, double> &g,
                          const double third,
                          const double lambda,
                          const double mu,
                          const MohrCoulomb &strength,
                          double *stress,
                          double &plastic_strain,
                          unsigned int &n_yielding)
    {
      std::array<double, n_stress<dim>> before, trial;
      std::copy(stress, stress + n_stress<dim>, before.begin());
      add_corrected_stress<dim>(g, third, lambda, mu, stress);
      std::copy(stress, stress + n_stress<dim>, trial.begin());
      if (!apply_mohr_coulomb<dim>(
            strength.at(plastic_strain), lambda, mu, stress))
        return 0.;
      ++n_yielding;
      double size       = 0.;
      const double work = plastic_work_density<dim>(
        before.data(), trial.data(), stress, lambda, mu, size);
      plastic_strain += size;
      return work;
    }

    /** Displacement gradients of a cell's points over the step, taken at its
     * middle, and shape gradients at its end. */
    template <int dim, bool is_large>
    inline void
    evaluate_points(const Corners<dim, double> &x,
                    const Corners<dim, double> &v,
                    const double step,
                    CellPoints<dim> &points)
    {
      Corners<dim, double> middle = x;
      if constexpr (is_large)
        for (int a = 0; a < (1 << dim); ++a)
          for (int d = 0; d < dim; ++d)
            middle[a][d] -= 0.5 * step * v[a][d];
      for (int q = 0; q < (1 << dim); ++q)
        {
          points.determinant[q] =
            gradients_times_determinant<dim>(q, middle, points.gradient[q]);
          points.rate[q] = rate_gradient<dim>(v,
                                              points.gradient[q],
                                              1. / points.determinant[q]);
        }
    }

    /** Put the shape gradients of the step's end in place of those of its
     * middle. */
    template <int dim>
    inline void
    move_points_to_end(const Corners<dim, double> &x, CellPoints<dim> &points)
    {
      for (int q = 0; q < (1 << dim); ++q)
        points.determinant[q] =
          gradients_times_determinant<dim>(q, x, points.gradient[q]);
    }

    template <int dim>
    inline Gradient<dim, double>
    times(Gradient<dim, double> g, const double factor)
    {
      for (auto &row : g)
        for (double &entry : row)
          entry *= factor;
      return g;
    }

    /** Cells whose Gauss points are each for themselves. */
    template <int dim, bool is_large, bool has_damping>
    void
    pass_over_full_cells(const double step,
                         CellArrays<dim> &cells,
                         const double *position,
                         const double *rate,
                         double *internal,
                         double *damping)
    {
      constexpr int n        = 1 << dim;
      const unsigned int end = cells.kind_begin[1];
      for (unsigned int c = cells.kind_begin[0]; c < end; ++c)
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

    /** Cells whose volume change is averaged, elastic or plastic. */
    template <int dim, bool is_large, bool has_damping, bool is_plastic>
    void
    pass_over_averaged_cells(const double step,
                             CellArrays<dim> &cells,
                             const double *position,
                             const double *rate,
                             double *internal,
                             double *damping)
    {
      constexpr int n = 1 << dim;
      const auto kind =
        unsigned(is_plastic ? CellKind::plastic : CellKind::mean_dilatation);
      CellPoints<dim> points;
      std::array<double, n * n_stress<dim>> viscous;
      for (unsigned int c = cells.kind_begin[kind];
           c < cells.kind_begin[kind + 1];
           ++c)
        {
          const Corners<dim, double> x = gather<dim>(cells.nodes[c], position);
          const Corners<dim, double> v = gather<dim>(cells.nodes[c], rate);
          evaluate_points<dim, is_large>(x, v, step, points);
          const auto third    = dilatation_corrections<dim>(points);
          const double lambda = cells.lambda[c], mu = cells.mu[c];
          viscous.fill(0.);
          for (int q = 0; q < n; ++q)
            {
              double *stress = cells.stress_of(c) + q * n_stress<dim>;
              if constexpr (has_damping)
                add_corrected_stress<dim>(points.rate[q],
                                          third[q],
                                          lambda * cells.beta[c],
                                          mu * cells.beta[c],
                                          viscous.data() + q * n_stress<dim>);
              const Gradient<dim, double> g = times<dim>(points.rate[q], step);
              if constexpr (is_large)
                rotate_stress<dim>(g, stress);
              if constexpr (is_plastic)
                {
                  const unsigned int p = c - cells.first_plastic();
                  cells.plastic_work += Shape<dim>::weight *
                                        points.determinant[q] *
                                        advance_plastic_point<dim>(
                                          g,
                                          step * third[q],
                                          lambda,
                                          mu,
                                          cells.strengths[cells.strength[p]],
                                          stress,
                                          cells.plastic_strain[n * p + q],
                                          cells.n_yielding);
                }
              else
                add_corrected_stress<dim>(
                  g, step * third[q], lambda, mu, stress);
            }
          if constexpr (is_large)
            move_points_to_end<dim>(x, points);
          Corners<dim, double> force{}, damping_force{};
          add_averaged_force<dim>(cells.stress_of(c), points, force);
          scatter<dim>(cells.nodes[c], force, internal);
          if constexpr (has_damping)
            {
              add_averaged_force<dim>(viscous.data(), points, damping_force);
              scatter<dim>(cells.nodes[c], damping_force, damping);
            }
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
      pass_over_full_cells<dim, is_large, has_damping>(
        step, cells, position, rate, internal, damping);
      pass_over_averaged_cells<dim, is_large, has_damping, false>(
        step, cells, position, rate, internal, damping);
      cells.n_yielding = 0;
      pass_over_averaged_cells<dim, is_large, has_damping, true>(
        step, cells, position, rate, internal, damping);
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
  std::array<double, dim *(1 << dim) * dim *(1 << dim)>
  cell_stiffness(const std::array<std::array<double, dim>, 1 << dim> &corners,
                 const bool is_averaged,
                 const double lambda,
                 const double mu)
  {
    constexpr int n = dim * (1 << dim);
    std::array<double, n * n> stiffness;
    CellPoints<dim> points;
    for (int j = 0; j < n; ++j)
      {
        Corners<dim, double> unit{}, force{};
        unit[j / dim][j % dim] = 1.;
        evaluate_points<dim, false>(corners, unit, 1., points);
        std::array<double, 1 << dim> third{};
        if (is_averaged)
          third = dilatation_corrections<dim>(points);
        std::array<double, (1 << dim) * n_stress<dim>> stress{};
        for (int q = 0; q < (1 << dim); ++q)
          {
            double *s = stress.data() + q * n_stress<dim>;
            add_corrected_stress<dim>(points.rate[q], third[q], lambda, mu, s);
            if (!is_averaged)
              add_force<dim>(s, points.gradient[q], force);
          }
        if (is_averaged)
          add_averaged_force<dim>(stress.data(), points, force);
        for (int i = 0; i < n; ++i)
          stiffness[i * n + j] = force[i / dim][i % dim];
      }
    return stiffness;
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
  template std::array<double, 64>
  cell_stiffness<2>(const std::array<std::array<double, 2>, 4> &,
                    const bool,
                    const double,
                    const double);
  template std::array<double, 576>
  cell_stiffness<3>(const std::array<std::array<double, 3>, 8> &,
                    const bool,
                    const double,
                    const double);
  template double elastic_energy(const CellArrays<2> &, const double *);
  template double elastic_energy(const CellArrays<3> &, const double *);
} // namespace Keyblock
