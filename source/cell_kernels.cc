// SPDX-License-Identifier: LGPL-2.1-or-later
// The loops over cells. This text is compiled once per instruction set, with
// KEYBLOCK_KERNELS its name and KEYBLOCK_LANES the cells that a register holds
// (see CMakeLists.txt). The integration is explained in theory.md, section 2:
// gradients are taken along the edges of the cell, interpolated to the Gauss
// points, and forces go the same way back.
#include <keyblock/cell_kernels.h>
#include <keyblock/material.h>
#include <keyblock/shape.h>
#include <keyblock/simd.h>

#include <cstddef>
#include <utility>

#define KEYBLOCK_JOIN_(a, b) a##b
#define KEYBLOCK_JOIN(a, b) KEYBLOCK_JOIN_(a, b)
#define KEYBLOCK_LANES_TYPE KEYBLOCK_JOIN(Lanes, KEYBLOCK_LANES)

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

      template <int dim>
      using Nodes = std::array<unsigned int, 1 << dim>;

      /** Values at the vertices of a cell, or of several side by side. */
      template <int dim, typename Number>
      struct AtVertices
      {
        Number value[1 << dim][dim];
      };

      // ---- between nodes and cells

      /** Lanes from @p value(0), value(1), ... (A detour by an array in memory
       * would wait for its last store.) */
      template <typename Number, typename Value, std::size_t... lane>
      KEYBLOCK_ALWAYS_INLINE Number
      make_lanes(const Value &value, const std::index_sequence<lane...> &)
      {
        return Number{value(lane)...};
      }

      KEYBLOCK_ALWAYS_INLINE void
      add_pair(const Lanes2 pair, double *to)
      {
        store(load<Lanes2>(to) + pair, to);
      }

      // pairs (x, y) of even and odd lanes, transposed into lanes of x and y
#if KEYBLOCK_LANES == 2
      KEYBLOCK_ALWAYS_INLINE void
      gather_pairs(const Nodes<2> *nodes,
                   const int a,
                   const double *field,
                   Lanes2 &x,
                   Lanes2 &y)
      {
        const Lanes2 p = load<Lanes2>(field + 2 * nodes[0][a]);
        const Lanes2 r = load<Lanes2>(field + 2 * nodes[1][a]);
        x              = __builtin_shufflevector(p, r, 0, 2);
        y              = __builtin_shufflevector(p, r, 1, 3);
      }

      KEYBLOCK_ALWAYS_INLINE void
      scatter_pairs(const Nodes<2> *nodes,
                    const int a,
                    const Lanes2 x,
                    const Lanes2 y,
                    double *field)
      {
        add_pair(__builtin_shufflevector(x, y, 0, 2), field + 2 * nodes[0][a]);
        add_pair(__builtin_shufflevector(x, y, 1, 3), field + 2 * nodes[1][a]);
      }

#elif KEYBLOCK_LANES == 4
      KEYBLOCK_ALWAYS_INLINE void
      gather_pairs(const Nodes<2> *nodes,
                   const int a,
                   const double *field,
                   Lanes4 &x,
                   Lanes4 &y)
      {
        const Lanes4 p =
          __builtin_shufflevector(load<Lanes2>(field + 2 * nodes[0][a]),
                                  load<Lanes2>(field + 2 * nodes[2][a]),
                                  0,
                                  1,
                                  2,
                                  3);
        const Lanes4 r =
          __builtin_shufflevector(load<Lanes2>(field + 2 * nodes[1][a]),
                                  load<Lanes2>(field + 2 * nodes[3][a]),
                                  0,
                                  1,
                                  2,
                                  3);
        x = __builtin_shufflevector(p, r, 0, 4, 2, 6);
        y = __builtin_shufflevector(p, r, 1, 5, 3, 7);
      }

      KEYBLOCK_ALWAYS_INLINE void
      scatter_pairs(const Nodes<2> *nodes,
                    const int a,
                    const Lanes4 x,
                    const Lanes4 y,
                    double *field)
      {
        const Lanes4 even = __builtin_shufflevector(x, y, 0, 4, 2, 6);
        const Lanes4 odd  = __builtin_shufflevector(x, y, 1, 5, 3, 7);
        add_pair(__builtin_shufflevector(even, even, 0, 1),
                 field + 2 * nodes[0][a]);
        add_pair(__builtin_shufflevector(odd, odd, 0, 1),
                 field + 2 * nodes[1][a]);
        add_pair(__builtin_shufflevector(even, even, 2, 3),
                 field + 2 * nodes[2][a]);
        add_pair(__builtin_shufflevector(odd, odd, 2, 3),
                 field + 2 * nodes[3][a]);
      }

#else
      KEYBLOCK_ALWAYS_INLINE Lanes8
      join_four(const Nodes<2> *nodes,
                const int first,
                const int a,
                const double *field)
      {
        const Lanes4 low =
          __builtin_shufflevector(load<Lanes2>(field + 2 * nodes[first][a]),
                                  load<Lanes2>(field + 2 * nodes[first + 2][a]),
                                  0,
                                  1,
                                  2,
                                  3);
        const Lanes4 high =
          __builtin_shufflevector(load<Lanes2>(field + 2 * nodes[first + 4][a]),
                                  load<Lanes2>(field + 2 * nodes[first + 6][a]),
                                  0,
                                  1,
                                  2,
                                  3);
        return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
      }

      KEYBLOCK_ALWAYS_INLINE void
      gather_pairs(const Nodes<2> *nodes,
                   const int a,
                   const double *field,
                   Lanes8 &x,
                   Lanes8 &y)
      {
        const Lanes8 p = join_four(nodes, 0, a, field);
        const Lanes8 r = join_four(nodes, 1, a, field);
        x = __builtin_shufflevector(p, r, 0, 8, 2, 10, 4, 12, 6, 14);
        y = __builtin_shufflevector(p, r, 1, 9, 3, 11, 5, 13, 7, 15);
      }

      KEYBLOCK_ALWAYS_INLINE void
      scatter_four(const Nodes<2> *nodes,
                   const int first,
                   const int a,
                   const Lanes8 pairs,
                   double *field)
      {
        add_pair(__builtin_shufflevector(pairs, pairs, 0, 1),
                 field + 2 * nodes[first][a]);
        add_pair(__builtin_shufflevector(pairs, pairs, 2, 3),
                 field + 2 * nodes[first + 2][a]);
        add_pair(__builtin_shufflevector(pairs, pairs, 4, 5),
                 field + 2 * nodes[first + 4][a]);
        add_pair(__builtin_shufflevector(pairs, pairs, 6, 7),
                 field + 2 * nodes[first + 6][a]);
      }

      KEYBLOCK_ALWAYS_INLINE void
      scatter_pairs(const Nodes<2> *nodes,
                    const int a,
                    const Lanes8 x,
                    const Lanes8 y,
                    double *field)
      {
        scatter_four(nodes,
                     0,
                     a,
                     __builtin_shufflevector(x, y, 0, 8, 2, 10, 4, 12, 6, 14),
                     field);
        scatter_four(nodes,
                     1,
                     a,
                     __builtin_shufflevector(x, y, 1, 9, 3, 11, 5, 13, 7, 15),
                     field);
      }

#endif

      /** Values of @p field at the vertices of the cells @p nodes points to. */
      template <int dim, typename Number>
      KEYBLOCK_ALWAYS_INLINE void
      gather(const Nodes<dim> *nodes,
             const double *field,
             AtVertices<dim, Number> &x)
      {
        constexpr int width = n_lanes<Number>;
        for (int a = 0; a < (1 << dim); ++a)
          if constexpr (dim == 2 && width > 1)
            gather_pairs(nodes, a, field, x.value[a][0], x.value[a][1]);
          else
            for (int d = 0; d < dim; ++d)
              x.value[a][d] = make_lanes<Number>(
                [&](const std::size_t l) __attribute__((always_inline)) {
                  return field[dim * nodes[l][a] + d];
                },
                std::make_index_sequence<width>());
      }

      /** Add @p force to @p field at the vertices. */
      template <int dim, typename Number>
      KEYBLOCK_ALWAYS_INLINE void
      scatter(const Nodes<dim> *nodes,
              const AtVertices<dim, Number> &force,
              double *field)
      {
        constexpr int width = n_lanes<Number>;
        for (int a = 0; a < (1 << dim); ++a)
          if constexpr (dim == 2 && width > 1)
            scatter_pairs(
              nodes, a, force.value[a][0], force.value[a][1], field);
          else
            {
              double lane[dim][width];
              for (int d = 0; d < dim; ++d)
                store(force.value[a][d], lane[d]);
              for (int l = 0; l < width; ++l)
                for (int d = 0; d < dim; ++d)
                  field[dim * nodes[l][a] + d] += lane[d][l];
            }
      }

      // ---- between vertices and Gauss points

      /** Index without bit @p d, and with a zero put in there. */
      constexpr int
      without_bit(const int index, const int d)
      {
        return (index & ((1 << d) - 1)) | ((index >> (d + 1)) << d);
      }
      constexpr int
      with_zero_bit(const int index, const int d)
      {
        return (index & ((1 << d) - 1)) | ((index >> d) << (d + 1));
      }

      /** Derivatives of dim components along the dim axes of the unit cell. A
       * derivative does not vary along its own axis: it has 2^(dim - 1) values,
       * numbered by the bits of the other axes. */
      template <int dim, typename Number>
      struct AlongEdges
      {
        Number value[dim][dim][1 << (dim - 1)]; ///< [axis][component][point]
      };

      /** From the edges of a cell to its Gauss points, or back: the matrix is
       * symmetric. */
      template <int dim, typename Number>
      KEYBLOCK_ALWAYS_INLINE void
      interpolate(Number (&value)[1 << (dim - 1)])
      {
        constexpr double low = Shape<dim>::gauss_lo;
        for (int bit = 0; bit < dim - 1; ++bit)
          for (int p = 0; p < (1 << (dim - 1)); ++p)
            if (((p >> bit) & 1) == 0)
              {
                Number &a      = value[p];
                Number &b      = value[p | (1 << bit)];
                const Number d = low * (b - a);
                a              = a + d;
                b              = b - d;
              }
      }

      template <int dim, typename Number>
      KEYBLOCK_ALWAYS_INLINE void
      differentiate(const AtVertices<dim, Number> &x,
                    AlongEdges<dim, Number> &result)
      {
        for (int d = 0; d < dim; ++d)
          for (int i = 0; i < dim; ++i)
            {
              for (int p = 0; p < (1 << (dim - 1)); ++p)
                {
                  const int a = with_zero_bit(p, d);
                  result.value[d][i][p] =
                    x.value[a | (1 << d)][i] - x.value[a][i];
                }
              interpolate<dim>(result.value[d][i]);
            }
      }

      /** Add the forces of fluxes along the axes, which are overwritten, at the
       * vertices: the transpose. */
      template <int dim, typename Number>
      KEYBLOCK_ALWAYS_INLINE void
      scatter_flux(const Nodes<dim> *nodes,
                   AlongEdges<dim, Number> &flux,
                   double *field)
      {
        AtVertices<dim, Number> force;
        for (int d = 0; d < dim; ++d)
          for (int i = 0; i < dim; ++i)
            {
              interpolate<dim>(flux.value[d][i]);
              for (int p = 0; p < (1 << (dim - 1)); ++p)
                {
                  const int a    = with_zero_bit(p, d);
                  const Number f = Shape<dim>::weight * flux.value[d][i][p];
                  Number &low    = force.value[a][i];
                  Number &high   = force.value[a | (1 << d)][i];
                  low            = d == 0 ? -f : low - f;
                  high           = d == 0 ? f : high + f;
                }
            }
        scatter<dim>(nodes, force, field);
      }

      /** Cofactors of the Jacobian at a point (gradients of the unit cell's
       * coordinates times the determinant), and the determinant. */
      template <int dim, typename Number>
      struct Jacobian
      {
        Number cofactor[dim][dim]; ///< [axis][component]
        Number determinant;
      };

      template <int dim, typename Number>
      KEYBLOCK_ALWAYS_INLINE Jacobian<dim, Number>
      jacobian_at(const int q, const AlongEdges<dim, Number> &x)
      {
        Number j[dim][dim];
        for (int d = 0; d < dim; ++d)
          for (int e = 0; e < dim; ++e)
            j[d][e] = x.value[d][e][without_bit(q, d)];
        Jacobian<dim, Number> result;
        auto &c = result.cofactor;
        if constexpr (dim == 2)
          {
            c[0][0] = j[1][1];
            c[0][1] = -j[1][0];
            c[1][0] = -j[0][1];
            c[1][1] = j[0][0];
          }
        else
          for (int d = 0; d < 3; ++d)
            for (int e = 0; e < 3; ++e)
              {
                const int d1 = (d + 1) % 3, d2 = (d + 2) % 3;
                const int e1 = (e + 1) % 3, e2 = (e + 2) % 3;
                c[d][e] = j[d1][e1] * j[d2][e2] - j[d1][e2] * j[d2][e1];
              }
        result.determinant = j[0][0] * c[0][0];
        for (int e = 1; e < dim; ++e)
          result.determinant += j[0][e] * c[0][e];
        return result;
      }

      /** Gradient of the field with derivatives @p v, g[i][j] = d v_i / d x_j.
       */
      template <int dim, typename Number>
      KEYBLOCK_ALWAYS_INLINE Gradient<dim, Number>
      gradient_at(const int q,
                  const AlongEdges<dim, Number> &v,
                  const Jacobian<dim, Number> &jacobian)
      {
        const Number inverse = 1. / jacobian.determinant;
        Gradient<dim, Number> g;
        for (int i = 0; i < dim; ++i)
          for (int j = 0; j < dim; ++j)
            {
              Number sum =
                v.value[0][i][without_bit(q, 0)] * jacobian.cofactor[0][j];
              for (int d = 1; d < dim; ++d)
                sum +=
                  v.value[d][i][without_bit(q, d)] * jacobian.cofactor[d][j];
              g[i][j] = sum * inverse;
            }
        return g;
      }

      /** Add stress . cofactors at a point to the fluxes. */
      template <int dim, typename Number>
      KEYBLOCK_ALWAYS_INLINE void
      add_flux(const int q,
               const Number *stress,
               const Jacobian<dim, Number> &jacobian,
               AlongEdges<dim, Number> &flux)
      {
        for (int d = 0; d < dim; ++d)
          {
            std::array<Number, dim> normal;
            for (int e = 0; e < dim; ++e)
              normal[e] = jacobian.cofactor[d][e];
            const auto f = apply_stress<dim, Number>(stress, normal);
            for (int i = 0; i < dim; ++i)
              {
                // the first of the two points of this derivative sets it
                Number &sum = flux.value[d][i][without_bit(q, d)];
                sum         = ((q >> d) & 1) == 0 ? f[i] : sum + f[i];
              }
          }
      }

      template <int dim, typename Number>
      KEYBLOCK_ALWAYS_INLINE Number
      trace(const Gradient<dim, Number> &g)
      {
        Number sum = g[0][0];
        for (int d = 1; d < dim; ++d)
          sum += g[d][d];
        return sum;
      }

      // ---- stress at the points

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
          , lambda(load<Number>(pass.lambda + first))
          , mu(load<Number>(pass.mu + first))
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
      };

      /** Points of the batch that might yield go to the yield surface one by
       * one. */
      template <int dim, typename Number>
      KEYBLOCK_ALWAYS_INLINE void
      yield(const Batch<dim, Number> &batch,
            const int q,
            const Number volume,
            const Number *before,
            Number *stress)
      {
        constexpr int width       = n_lanes<Number>;
        const CellPass<dim> &pass = batch.pass;
        const unsigned short *strength =
          pass.strength + (batch.first - pass.first_plastic);
        const auto of_strength = [&](double ElasticBound::*const member)
          __attribute__((always_inline))
        {
          return make_lanes<Number>(
            [&](const std::size_t l) __attribute__((always_inline)) {
              return pass.bounds[strength[l]].*member;
            },
            std::make_index_sequence<width>());
        };
        const Number p = (stress[0] + stress[1] + stress[2]) * (1. / 3.);
        Number j2      = Number();
        for (int k = 0; k < 3; ++k)
          j2 += 0.5 * (stress[k] - p) * (stress[k] - p);
        for (int k = 3; k < n_stress<dim>; ++k)
          j2 += stress[k] * stress[k];
        const Number shear = of_strength(&ElasticBound::uniaxial) -
                             of_strength(&ElasticBound::slope) * p;
        const Number pull = of_strength(&ElasticBound::tension) - p;
        double room[4][width];
        store(shear, room[0]);
        store(pull, room[1]);
        store(shear * shear - of_strength(&ElasticBound::factor) * j2, room[2]);
        store(pull * pull - (4. / 3.) * j2, room[3]);
        for (int l = 0; l < width; ++l)
          if (!(room[0][l] >= 0. && room[1][l] >= 0. && room[2][l] >= 0. &&
                room[3][l] >= 0.))
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
              pass.yield(
                pass.owner, batch.first + l, q, volumes[l], old, trial);
              for (int k = 0; k < n_stress<dim>; ++k)
                {
                  values[1][k][l] = trial[k];
                  stress[k]       = load<Number>(values[1][k]);
                }
            }
      }

      /** Advance the stress at a point by the strain rate @p g, to whose
       * normal components @p third is added; @p viscous is set. */
      template <int dim, bool is_large, Kind kind, typename Number>
      KEYBLOCK_ALWAYS_INLINE void
      advance_stress(const Batch<dim, Number> &batch,
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
            stress[k] = load<Number>(batch.stress_at(q, k));
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
        if constexpr (kind == Kind::plastic)
          yield<dim, Number>(batch, q, volume, before, stress);
        for (int k = 0; k < n_stress<dim>; ++k)
          store(stress[k], batch.stress_at(q, k));
      }

      // ---- cells

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
            change += jacobian[q].determinant *
                      trace<dim>(gradient_at<dim>(q, rate, jacobian[q]));
          }
        const Number mean = change / volume;
        Number stress[n][n_stress<dim>], viscous[n][n_stress<dim>];
        for (int q = 0; q < n; ++q)
          {
            const auto g = gradient_at<dim>(q, rate, jacobian[q]);
            advance_stress<dim, is_large, kind, Number>(
              batch,
              q,
              g,
              (mean - trace<dim>(g)) * (1. / 3.),
              Shape<dim>::weight * jacobian[q].determinant,
              stress[q],
              viscous[q]);
          }
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

      /** Whole batches together; cells before and behind them one by one. */
      template <int dim, bool is_large, bool has_damping, Kind kind>
      void
      loop(const CellPass<dim> &pass)
      {
        using Number               = KEYBLOCK_LANES_TYPE;
        constexpr unsigned width   = n_lanes<Number>;
        const unsigned first_batch = (pass.begin + width - 1) / width * width;
        unsigned int c             = pass.begin;
        for (; c < pass.end && c < first_batch; ++c)
          work_on<dim, is_large, has_damping, kind, double>(pass, c);
        for (; c + width <= pass.end; c += width)
          work_on<dim, is_large, has_damping, kind, Number>(pass, c);
        for (; c < pass.end; ++c)
          work_on<dim, is_large, has_damping, kind, double>(pass, c);
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
    }
  } // namespace KEYBLOCK_KERNELS
} // namespace Keyblock
