// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_rock_cell_points_h
#define keyblock_rock_cell_points_h

#include <keyblock/rock/cell_transfer.h>
#include <keyblock/rock/material.h>
#include <keyblock/rock/shape.h>

// Between the vertices of cells and their Gauss points; part of
// rock/cell_kernels.cc, for the instruction set KEYBLOCK_KERNELS.
namespace Keyblock
{
  namespace KEYBLOCK_KERNELS
  {
    namespace
    {
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

      /** Divergence of the field with derivatives @p v, times the determinant.
       */
      template <int dim, typename Number>
      KEYBLOCK_ALWAYS_INLINE Number
      dilatation_at(const int q,
                    const AlongEdges<dim, Number> &v,
                    const Jacobian<dim, Number> &jacobian)
      {
        Number sum = Number();
        for (int i = 0; i < dim; ++i)
          for (int d = 0; d < dim; ++d)
            sum += v.value[d][i][without_bit(q, d)] * jacobian.cofactor[d][i];
        return sum;
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
    } // namespace
  }   // namespace KEYBLOCK_KERNELS
} // namespace Keyblock

#endif
