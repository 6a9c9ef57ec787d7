// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_rock_cell_stress_h
#define keyblock_rock_cell_stress_h

#include <keyblock/rock/cell_kernels.h>
#include <keyblock/rock/cell_points.h>

// Stress at the Gauss points; part of rock/cell_kernels.cc, for the instruction
// set KEYBLOCK_KERNELS.
namespace Keyblock
{
  namespace KEYBLOCK_KERNELS
  {
    namespace
    {
      enum class Kind
      {
        elastic,
        averaged,
        plastic
      };

      /** The cells that one call of a kernel works on: n_lanes<Number>. */
      template <int dim, typename Number>
      struct Batch
      {
        const CellPass<dim> &pass;
        const unsigned int first; ///< cell
        const Number lambda, mu, beta;
        double *const stress; ///< of point 0, component 0

        KEYBLOCK_ALWAYS_INLINE
        Batch(const CellPass<dim> &pass, const unsigned int first)
          : pass(pass)
          , first(first)
          , lambda(load<Number>(pass.lambda + pass.moduli_stride * first))
          , mu(load<Number>(pass.mu + pass.moduli_stride * first))
          , beta(pass.beta ? load<Number>(pass.beta + first) : Number())
          , stress(pass.stress +
                   std::size_t(first / batch_size) * batch_size * (1 << dim) *
                     n_stress<dim> +
                   first % batch_size)
        {}

        KEYBLOCK_ALWAYS_INLINE double *
        stress_at(const int q, const int k) const
        {
          return stress + batch_size * (q * n_stress<dim> + k);
        }

        /** Stresses come as a stream; hardware alone fetches it too late. */
        KEYBLOCK_ALWAYS_INLINE void
        prefetch(const int q, const int k) const
        {
          constexpr int n_ahead = 2; // batches
          __builtin_prefetch(stress_at(q, k) + n_ahead * batch_size *
                                                 (1 << dim) * n_stress<dim>,
                             1);
        }
      };

      /** ElasticBound of each cell. */
      template <typename Number>
      struct Bounds
      {
        Number slope, factor, uniaxial, tension;
      };

      template <int dim, typename Number>
      KEYBLOCK_ALWAYS_INLINE Bounds<Number>
      bounds_of(const Batch<dim, Number> &batch)
      {
        const CellPass<dim> &pass = batch.pass;
        const unsigned short *strength =
          pass.strength + (batch.first - pass.first_plastic);
        const auto all = [&](double ElasticBound::*const member)
          __attribute__((always_inline))
        {
          return make_lanes<Number>(
            [&](const std::size_t l) __attribute__((always_inline)) {
              return pass.bounds[strength[l]].*member;
            },
            std::make_index_sequence<n_lanes<Number>>());
        };
        return {all(&ElasticBound::slope),
                all(&ElasticBound::factor),
                all(&ElasticBound::uniaxial),
                all(&ElasticBound::tension)};
      }

      /** Points of the batch that might yield go to the yield surface one by
       * one. Returns the lanes, as bits, of those that did. */
      template <int dim, typename Number>
      KEYBLOCK_ALWAYS_INLINE unsigned int
      yield(const Batch<dim, Number> &batch,
            const Bounds<Number> &bounds,
            const int q,
            const Number volume,
            const Number *before,
            Number *stress)
      {
        constexpr int width = n_lanes<Number>;
        const Number p      = (stress[0] + stress[1] + stress[2]) * (1. / 3.);
        Number j2           = Number();
        for (int k = 0; k < 3; ++k)
          j2 += 0.5 * (stress[k] - p) * (stress[k] - p);
        for (int k = 3; k < n_stress<dim>; ++k)
          j2 += stress[k] * stress[k];
        const Number shear = bounds.uniaxial - bounds.slope * p;
        const Number pull  = bounds.tension - p;
        const auto is_elastic =
          is_positive(shear) & is_positive(pull) &
          is_positive(shear * shear - bounds.factor * j2) &
          is_positive(pull * pull - (4. / 3.) * j2);
        if (is_true<width>(is_elastic))
          return 0;
        unsigned int yielding = 0;
        for (int l = 0; l < width; ++l)
          if (!is_true<width>(is_elastic, l))
            {
              double values[3][n_stress<dim>][width], old[n_stress<dim>],
                trial[n_stress<dim>], volumes[width];
              store(volume, volumes);
              for (int k = 0; k < n_stress<dim>; ++k)
                {
                  store(before[k], values[0][k]);
                  store(stress[k], values[1][k]);
                  old[k]   = values[0][k][l];
                  trial[k] = values[1][k][l];
                }
              if (batch.pass.yield(batch.pass.owner,
                                   batch.first + l,
                                   q,
                                   volumes[l],
                                   old,
                                   trial))
                yielding |= 1u << l;
              for (int k = 0; k < n_stress<dim>; ++k)
                {
                  values[1][k][l] = trial[k];
                  stress[k]       = load<Number>(values[1][k]);
                }
            }
        return yielding;
      }

      /** Whether a component of the stress is kept in a form that elastic
       * strain does not change (CellArrays::stress). */
      template <int dim, Kind kind>
      constexpr bool
      is_kept(const int component)
      {
        return dim == 2 && kind == Kind::elastic && component == 2;
      }

      /** Advance the stress at a point by the strain rate @p g, to whose
       * normal components @p third is added; @p viscous is set. Returns the
       * lanes that yield, as bits. */
      template <int dim, bool is_large, Kind kind, typename Number>
      KEYBLOCK_ALWAYS_INLINE unsigned int
      advance_stress(const Batch<dim, Number> &batch,
                     const Bounds<Number> &bounds,
                     const int q,
                     Gradient<dim, Number> g,
                     const Number third,
                     const Number volume,
                     Number *stress,
                     Number *viscous)
      {
        Number rate[n_stress<dim>], before[n_stress<dim>];
        for (int k = 0; k < n_stress<dim>; ++k)
          {
            rate[k]   = Number();
            stress[k] = Number();
            if (is_kept<dim, kind>(k))
              continue;
            stress[k] = load<Number>(batch.stress_at(q, k));
            if (n_lanes < Number >> 1)
              batch.prefetch(q, k);
          }
        add_elastic_stress<dim, Number>(g, batch.lambda, batch.mu, rate);
        if constexpr (kind != Kind::elastic)
          for (int k = 0; k < 3; ++k)
            rate[k] += (3. * batch.lambda + 2. * batch.mu) * third;
        if constexpr (is_large)
          {
            for (auto &row : g)
              for (Number &entry : row)
                entry *= batch.pass.step;
            rotate_stress<dim, Number>(g, stress);
          }
        for (int k = 0; k < n_stress<dim>; ++k)
          {
            before[k] = stress[k];
            stress[k] += batch.pass.step * rate[k];
            viscous[k] = batch.beta * rate[k];
          }
        unsigned int yielding = 0;
        if constexpr (kind == Kind::plastic)
          yielding =
            yield<dim, Number>(batch, bounds, q, volume, before, stress);
        for (int k = 0; k < n_stress<dim>; ++k)
          if (!is_kept<dim, kind>(k))
            store(stress[k], batch.stress_at(q, k));
        return yielding;
      }
    } // namespace
  }   // namespace KEYBLOCK_KERNELS
} // namespace Keyblock

#endif
