// SPDX-License-Identifier: LGPL-2.1-or-later
// The loops over cells. This text is compiled once per instruction set, with
// KEYBLOCK_KERNELS its name and KEYBLOCK_LANES the cells that a register holds
// (see CMakeLists.txt). The integration is explained in theory.md, section 5:
// gradients are taken along the edges of the cell, interpolated to the Gauss
// points, and forces go the same way back.
#include <keyblock/rock/cell_stress.h>

#define KEYBLOCK_JOIN_(a, b) a##b
#define KEYBLOCK_JOIN(a, b) KEYBLOCK_JOIN_(a, b)
#define KEYBLOCK_LANES_TYPE KEYBLOCK_JOIN(Lanes, KEYBLOCK_LANES)

namespace Keyblock
{
  namespace KEYBLOCK_KERNELS
  {
    namespace
    {
      /** Fluxes of stress and of viscous stress. */
      template <int dim, typename Number>
      struct Fluxes
      {
        AlongEdges<dim, Number> internal, damping;
      };

      /** Gauss points each for themselves. */
      template <int dim, bool is_large, bool has_damping, typename Number>
      KEYBLOCK_ALWAYS_INLINE void
      integrate_points(const Batch<dim, Number> &batch,
                       const AlongEdges<dim, Number> &middle,
                       const AlongEdges<dim, Number> &end,
                       const AlongEdges<dim, Number> &rate,
                       Fluxes<dim, Number> &flux)
      {
        for (int q = 0; q < (1 << dim); ++q)
          {
            Jacobian<dim, Number> jacobian = jacobian_at<dim>(q, middle);
            Number stress[n_stress<dim>], viscous[n_stress<dim>];
            advance_stress<dim, is_large, Kind::elastic, Number>(
              batch,
              Bounds<Number>(),
              q,
              gradient_at<dim>(q, rate, jacobian),
              Number(),
              Number(),
              stress,
              viscous);
            if constexpr (is_large)
              jacobian = jacobian_at<dim>(q, end);
            add_flux<dim>(q, stress, jacobian, flux.internal);
            if constexpr (has_damping)
              add_flux<dim>(q, viscous, jacobian, flux.damping);
          }
      }

      /** Fluxes of the stresses of all points with the mean pressure of the
       * cell: the transpose of the averaged dilatation. */
      template <int dim, typename Number>
      KEYBLOCK_ALWAYS_INLINE void
      add_averaged_flux(Number (&stress)[1 << dim][n_stress<dim>],
                        const Jacobian<dim, Number> (&jacobian)[1 << dim],
                        AlongEdges<dim, Number> &flux)
      {
        Number volume = Number(), mean = Number();
        for (int q = 0; q < (1 << dim); ++q)
          {
            volume += jacobian[q].determinant;
            mean += jacobian[q].determinant *
                    (stress[q][0] + stress[q][1] + stress[q][2]);
          }
        mean /= volume;
        for (int q = 0; q < (1 << dim); ++q)
          {
            const Number shift =
              (mean - (stress[q][0] + stress[q][1] + stress[q][2])) * (1. / 3.);
            for (int k = 0; k < 3; ++k)
              stress[q][k] += shift;
            add_flux<dim>(q, stress[q], jacobian[q], flux);
          }
      }

      /** Give all points of the cells that yield, the bits of @p yielding, the
       * mean pressure of their cell, and book the elastic energy that this
       * costs as plastic work. The volume change is the same at all points, the
       * plastic one is not: what differs would grow for ever. */
      template <int dim, typename Number>
      KEYBLOCK_ALWAYS_INLINE void
      level_pressure(const Batch<dim, Number> &batch,
                     const unsigned int yielding,
                     const Jacobian<dim, Number> (&jacobian)[1 << dim],
                     Number (&stress)[1 << dim][n_stress<dim>])
      {
        constexpr int n     = 1 << dim;
        constexpr int width = n_lanes<Number>;
        Number trace[n], volume = Number(), mean = Number();
        for (int q = 0; q < n; ++q)
          {
            trace[q] = stress[q][0] + stress[q][1] + stress[q][2];
            volume += jacobian[q].determinant;
            mean += jacobian[q].determinant * trace[q];
          }
        mean /= volume;
        double chosen[width];
        for (int l = 0; l < width; ++l)
          chosen[l] = (yielding >> l) & 1;
        const Number third = load<Number>(chosen) * (1. / 3.);
        Number work        = Number();
        for (int q = 0; q < n; ++q)
          {
            const Number shift = third * (mean - trace[q]);
            for (int k = 0; k < 3; ++k)
              {
                stress[q][k] += shift;
                store(stress[q][k], batch.stress_at(q, k));
              }
            const Number after = stress[q][0] + stress[q][1] + stress[q][2];
            work += Shape<dim>::weight * jacobian[q].determinant *
                    (trace[q] - after) * (trace[q] + after);
          }
        double lost[width];
        store(work / (6. * (3. * batch.lambda + 2. * batch.mu)), lost);
        for (const double loss : lost)
          *batch.pass.plastic_work += loss;
      }

      /** Volume change and pressure averaged over the cell. */
      template <int dim,
                bool is_large,
                bool has_damping,
                Kind kind,
                typename Number>
      KEYBLOCK_ALWAYS_INLINE void
      integrate_averaged_points(const Batch<dim, Number> &batch,
                                const AlongEdges<dim, Number> &middle,
                                const AlongEdges<dim, Number> &end,
                                const AlongEdges<dim, Number> &rate,
                                Fluxes<dim, Number> &flux)
      {
        constexpr int n = 1 << dim;
        Jacobian<dim, Number> jacobian[n];
        Number change = Number(), volume = Number();
        for (int q = 0; q < n; ++q)
          {
            jacobian[q] = jacobian_at<dim>(q, middle);
            volume += jacobian[q].determinant;
            change += dilatation_at<dim>(q, rate, jacobian[q]);
          }
        const Number mean = change / volume;
        Bounds<Number> bounds{};
        if constexpr (kind == Kind::plastic)
          bounds = bounds_of<dim, Number>(batch);
        Number stress[n][n_stress<dim>], viscous[n][n_stress<dim>];
        unsigned int yielding = 0;
        for (int q = 0; q < n; ++q)
          {
            const auto g = gradient_at<dim>(q, rate, jacobian[q]);
            yielding |= advance_stress<dim, is_large, kind, Number>(
              batch,
              bounds,
              q,
              g,
              (mean - trace<dim>(g)) * (1. / 3.),
              Shape<dim>::weight * jacobian[q].determinant,
              stress[q],
              viscous[q]);
          }
        if (kind == Kind::plastic && yielding != 0)
          level_pressure<dim, Number>(batch, yielding, jacobian, stress);
        if constexpr (is_large)
          for (int q = 0; q < n; ++q)
            jacobian[q] = jacobian_at<dim>(q, end);
        add_averaged_flux<dim>(stress, jacobian, flux.internal);
        if constexpr (has_damping)
          add_averaged_flux<dim>(viscous, jacobian, flux.damping);
      }

      template <int dim,
                bool is_large,
                bool has_damping,
                Kind kind,
                typename Number>
      KEYBLOCK_ALWAYS_INLINE void
      integrate(const Batch<dim, Number> &batch,
                const AlongEdges<dim, Number> &middle,
                const AlongEdges<dim, Number> &end,
                const AlongEdges<dim, Number> &rate,
                Fluxes<dim, Number> &flux)
      {
        if constexpr (kind == Kind::elastic)
          integrate_points<dim, is_large, has_damping>(
            batch, middle, end, rate, flux);
        else
          integrate_averaged_points<dim, is_large, has_damping, kind>(
            batch, middle, end, rate, flux);
      }

      template <int dim,
                bool is_large,
                bool has_damping,
                Kind kind,
                typename Number>
      KEYBLOCK_ALWAYS_INLINE void
      work_on(const CellPass<dim> &pass, const unsigned int first)
      {
        const Batch<dim, Number> batch(pass, first);
        const Nodes<dim> *nodes = pass.nodes + first;
        AtVertices<dim, Number> v, x;
        gather<dim>(nodes, pass.rate, v);
        gather<dim>(nodes, pass.position, x);
        AlongEdges<dim, Number> rate, end;
        differentiate<dim>(v, rate);
        differentiate<dim>(x, end);
        Fluxes<dim, Number> flux;
        if constexpr (is_large)
          {
            for (int a = 0; a < (1 << dim); ++a)
              for (int d = 0; d < dim; ++d)
                x.value[a][d] -= 0.5 * pass.step * v.value[a][d];
            AlongEdges<dim, Number> middle;
            differentiate<dim>(x, middle);
            integrate<dim, is_large, has_damping, kind>(
              batch, middle, end, rate, flux);
          }
        else
          integrate<dim, is_large, has_damping, kind>(
            batch, end, end, rate, flux);
        scatter_flux<dim>(nodes, flux.internal, pass.internal);
        if constexpr (has_damping)
          scatter_flux<dim>(nodes, flux.damping, pass.damping);
      }

      /** Call action(number, first cell) for whole batches; cells before and
       * behind them one by one. The number tells the type to compute with. */
      template <int dim, typename Action>
      KEYBLOCK_ALWAYS_INLINE void
      for_each_batch(const CellPass<dim> &pass, const Action &action)
      {
        using Number               = KEYBLOCK_LANES_TYPE;
        constexpr unsigned width   = n_lanes<Number>;
        const unsigned first_batch = (pass.begin + width - 1) / width * width;
        unsigned int c             = pass.begin;
        for (; c < pass.end && c < first_batch; ++c)
          action(double(), c);
        for (; c + width <= pass.end; c += width)
          action(Number(), c);
        for (; c < pass.end; ++c)
          action(double(), c);
      }

      template <int dim, bool is_large, bool has_damping, Kind kind>
      void
      loop(const CellPass<dim> &pass)
      {
        for_each_batch(
          pass,
          [&](auto number,
              const unsigned int first) __attribute__((always_inline)) {
            work_on<dim, is_large, has_damping, kind, decltype(number)>(pass,
                                                                        first);
          });
      }

      template <int dim, Kind kind>
      void
      run(const CellPass<dim> &pass)
      {
        if (pass.is_large)
          pass.beta ? loop<dim, true, true, kind>(pass)
                    : loop<dim, true, false, kind>(pass);
        else
          pass.beta ? loop<dim, false, true, kind>(pass)
                    : loop<dim, false, false, kind>(pass);
      }

      /** Elastic energy of a batch of cells [J]. */
      template <int dim, Kind kind, typename Number>
      KEYBLOCK_ALWAYS_INLINE double
      energy_of_batch(const CellPass<dim> &pass, const unsigned int first)
      {
        const Batch<dim, Number> batch(pass, first);
        AtVertices<dim, Number> x;
        gather<dim>(pass.nodes + first, pass.position, x);
        AlongEdges<dim, Number> edges;
        differentiate<dim>(x, edges);
        const Number poisson_ratio =
          0.5 * batch.lambda / (batch.lambda + batch.mu);
        Number energy = Number();
        for (int q = 0; q < (1 << dim); ++q)
          {
            Number stress[n_stress<dim>];
            for (int k = 0; k < n_stress<dim>; ++k)
              stress[k] = load<Number>(batch.stress_at(q, k));
            if constexpr (is_kept<dim, kind>(2))
              stress[2] += poisson_ratio * (stress[0] + stress[1]);
            energy += Shape<dim>::weight *
                      jacobian_at<dim>(q, edges).determinant *
                      elastic_energy_density<dim, Number>(stress,
                                                          batch.lambda,
                                                          batch.mu);
          }
        double lane[n_lanes<Number>], sum = 0.;
        store(energy, lane);
        for (const double value : lane)
          sum += value;
        return sum;
      }

      template <int dim, Kind kind>
      double
      energy(const CellPass<dim> &pass)
      {
        double sum = 0.;
        for_each_batch(
          pass,
          [&](auto number, const unsigned int first)
            __attribute__((always_inline)) {
              sum += energy_of_batch<dim, kind, decltype(number)>(pass, first);
            });
        return sum;
      }
    } // namespace

    void
    register_kernels(CellKernels &kernels)
    {
      kernels.elastic_2d  = run<2, Kind::elastic>;
      kernels.elastic_3d  = run<3, Kind::elastic>;
      kernels.averaged_2d = run<2, Kind::averaged>;
      kernels.averaged_3d = run<3, Kind::averaged>;
      kernels.plastic_2d  = run<2, Kind::plastic>;
      kernels.plastic_3d  = run<3, Kind::plastic>;
      kernels.energy_2d = {energy<2, Kind::elastic>, energy<2, Kind::averaged>};
      kernels.energy_3d = {energy<3, Kind::elastic>, energy<3, Kind::averaged>};
    }
  } // namespace KEYBLOCK_KERNELS
} // namespace Keyblock
