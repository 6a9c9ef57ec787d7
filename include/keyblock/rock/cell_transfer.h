// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_rock_cell_transfer_h
#define keyblock_rock_cell_transfer_h

#include <keyblock/base/simd.h>

#include <array>
#include <cstddef>
#include <utility>

// Between nodes and cells, several side by side; part of rock/cell_kernels.cc,
// for the instruction set KEYBLOCK_KERNELS.
namespace Keyblock
{
  namespace KEYBLOCK_KERNELS
  {
    namespace
    {
      template <int dim>
      using Nodes = std::array<unsigned int, 1 << dim>;

      /** Values at the vertices of a cell, or of several side by side. */
      template <int dim, typename Number>
      struct AtVertices
      {
        Number value[1 << dim][dim];
      };


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

      // The first two components of nodes, (x, y) of one lane after the other,
      // transposed into lanes of x and y.
#if KEYBLOCK_LANES == 2
      template <int dim>
      KEYBLOCK_ALWAYS_INLINE void
      gather_pairs(const Nodes<dim> *nodes,
                   const int a,
                   const double *field,
                   Lanes2 &x,
                   Lanes2 &y)
      {
        const Lanes2 p = load<Lanes2>(field + dim * nodes[0][a]);
        const Lanes2 r = load<Lanes2>(field + dim * nodes[1][a]);
        x              = __builtin_shufflevector(p, r, 0, 2);
        y              = __builtin_shufflevector(p, r, 1, 3);
      }

      template <int dim>
      KEYBLOCK_ALWAYS_INLINE void
      scatter_pairs(const Nodes<dim> *nodes,
                    const int a,
                    const Lanes2 x,
                    const Lanes2 y,
                    double *field)
      {
        add_pair(__builtin_shufflevector(x, y, 0, 2),
                 field + dim * nodes[0][a]);
        add_pair(__builtin_shufflevector(x, y, 1, 3),
                 field + dim * nodes[1][a]);
      }

#elif KEYBLOCK_LANES == 4
      template <int dim>
      KEYBLOCK_ALWAYS_INLINE void
      gather_pairs(const Nodes<dim> *nodes,
                   const int a,
                   const double *field,
                   Lanes4 &x,
                   Lanes4 &y)
      {
        const Lanes4 p =
          __builtin_shufflevector(load<Lanes2>(field + dim * nodes[0][a]),
                                  load<Lanes2>(field + dim * nodes[2][a]),
                                  0,
                                  1,
                                  2,
                                  3);
        const Lanes4 r =
          __builtin_shufflevector(load<Lanes2>(field + dim * nodes[1][a]),
                                  load<Lanes2>(field + dim * nodes[3][a]),
                                  0,
                                  1,
                                  2,
                                  3);
        x = __builtin_shufflevector(p, r, 0, 4, 2, 6);
        y = __builtin_shufflevector(p, r, 1, 5, 3, 7);
      }

      template <int dim>
      KEYBLOCK_ALWAYS_INLINE void
      scatter_pairs(const Nodes<dim> *nodes,
                    const int a,
                    const Lanes4 x,
                    const Lanes4 y,
                    double *field)
      {
        const Lanes4 even = __builtin_shufflevector(x, y, 0, 4, 2, 6);
        const Lanes4 odd  = __builtin_shufflevector(x, y, 1, 5, 3, 7);
        add_pair(__builtin_shufflevector(even, even, 0, 1),
                 field + dim * nodes[0][a]);
        add_pair(__builtin_shufflevector(odd, odd, 0, 1),
                 field + dim * nodes[1][a]);
        add_pair(__builtin_shufflevector(even, even, 2, 3),
                 field + dim * nodes[2][a]);
        add_pair(__builtin_shufflevector(odd, odd, 2, 3),
                 field + dim * nodes[3][a]);
      }

#else
      template <int dim>
      KEYBLOCK_ALWAYS_INLINE Lanes8
      join_four(const Nodes<dim> *nodes,
                const int first,
                const int a,
                const double *field)
      {
        const Lanes4 low =
          __builtin_shufflevector(load<Lanes2>(field + dim * nodes[first][a]),
                                  load<Lanes2>(field +
                                               dim * nodes[first + 2][a]),
                                  0,
                                  1,
                                  2,
                                  3);
        const Lanes4 high = __builtin_shufflevector(
          load<Lanes2>(field + dim * nodes[first + 4][a]),
          load<Lanes2>(field + dim * nodes[first + 6][a]),
          0,
          1,
          2,
          3);
        return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
      }

      template <int dim>
      KEYBLOCK_ALWAYS_INLINE void
      gather_pairs(const Nodes<dim> *nodes,
                   const int a,
                   const double *field,
                   Lanes8 &x,
                   Lanes8 &y)
      {
        const Lanes8 p = join_four<dim>(nodes, 0, a, field);
        const Lanes8 r = join_four<dim>(nodes, 1, a, field);
        x = __builtin_shufflevector(p, r, 0, 8, 2, 10, 4, 12, 6, 14);
        y = __builtin_shufflevector(p, r, 1, 9, 3, 11, 5, 13, 7, 15);
      }

      template <int dim>
      KEYBLOCK_ALWAYS_INLINE void
      scatter_four(const Nodes<dim> *nodes,
                   const int first,
                   const int a,
                   const Lanes8 pairs,
                   double *field)
      {
        add_pair(__builtin_shufflevector(pairs, pairs, 0, 1),
                 field + dim * nodes[first][a]);
        add_pair(__builtin_shufflevector(pairs, pairs, 2, 3),
                 field + dim * nodes[first + 2][a]);
        add_pair(__builtin_shufflevector(pairs, pairs, 4, 5),
                 field + dim * nodes[first + 4][a]);
        add_pair(__builtin_shufflevector(pairs, pairs, 6, 7),
                 field + dim * nodes[first + 6][a]);
      }

      template <int dim>
      KEYBLOCK_ALWAYS_INLINE void
      scatter_pairs(const Nodes<dim> *nodes,
                    const int a,
                    const Lanes8 x,
                    const Lanes8 y,
                    double *field)
      {
        scatter_four<dim>(
          nodes,
          0,
          a,
          __builtin_shufflevector(x, y, 0, 8, 2, 10, 4, 12, 6, 14),
          field);
        scatter_four<dim>(
          nodes,
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
        constexpr int begin = width > 1 ? 2 : 0; // of components one by one
        for (int a = 0; a < (1 << dim); ++a)
          {
            if constexpr (width > 1)
              gather_pairs<dim>(nodes, a, field, x.value[a][0], x.value[a][1]);
            for (int d = begin; d < dim; ++d)
              x.value[a][d] = make_lanes<Number>(
                [&](const std::size_t l) __attribute__((always_inline)) {
                  return field[dim * nodes[l][a] + d];
                },
                std::make_index_sequence<width>());
          }
      }

      /** Add @p force to @p field at the vertices. */
      template <int dim, typename Number>
      KEYBLOCK_ALWAYS_INLINE void
      scatter(const Nodes<dim> *nodes,
              const AtVertices<dim, Number> &force,
              double *field)
      {
        constexpr int width = n_lanes<Number>;
        constexpr int begin = width > 1 ? 2 : 0;
        for (int a = 0; a < (1 << dim); ++a)
          {
            if constexpr (width > 1)
              scatter_pairs<dim>(
                nodes, a, force.value[a][0], force.value[a][1], field);
            for (int d = begin; d < dim; ++d)
              {
                double lane[width];
                store(force.value[a][d], lane);
                for (int l = 0; l < width; ++l)
                  field[dim * nodes[l][a] + d] += lane[l];
              }
          }
      }
    } // namespace
  }   // namespace KEYBLOCK_KERNELS
} // namespace Keyblock

#endif
