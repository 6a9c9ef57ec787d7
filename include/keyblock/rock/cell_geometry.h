// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_rock_cell_geometry_h
#define keyblock_rock_cell_geometry_h

#include <keyblock/rock/shape.h>

#include <array>

namespace Keyblock
{
  template <int dim, typename Number>
  using Corners = std::array<std::array<Number, dim>, (1 << dim)>;

  /**
   * Gradients of the shape functions at Gauss point @p q of the cell with
   * vertices @p x, times the determinant of the Jacobian: cofactor . slope.
   * Returns the determinant. (Multiplying by the inverse determinant is left
   * to the caller: forces need the product, strains the quotient.)
   */
  template <int dim, typename Number>
  inline Number
  gradients_times_determinant(const int q,
                              const Corners<dim, Number> &x,
                              Corners<dim, Number> &gradient)
  {
    constexpr int n = 1 << dim;
    Number j[dim][dim]; // j[d][e] = d x_e / d xi_d
    for (int d = 0; d < dim; ++d)
      for (int e = 0; e < dim; ++e)
        {
          j[d][e] = shape<dim>.slope[q][0][d] * x[0][e];
          for (int a = 1; a < n; ++a)
            j[d][e] += shape<dim>.slope[q][a][d] * x[a][e];
        }
    Number cofactor[dim][dim]; // of j: inverse(j)[e][d] = cofactor[d][e] / det
    Number determinant;
    if constexpr (dim == 2)
      {
        cofactor[0][0] = j[1][1];
        cofactor[0][1] = -j[1][0];
        cofactor[1][0] = -j[0][1];
        cofactor[1][1] = j[0][0];
        determinant    = j[0][0] * j[1][1] - j[0][1] * j[1][0];
      }
    else
      {
        for (int d = 0; d < 3; ++d)
          for (int e = 0; e < 3; ++e)
            {
              const int d1 = (d + 1) % 3, d2 = (d + 2) % 3;
              const int e1 = (e + 1) % 3, e2 = (e + 2) % 3;
              cofactor[d][e] = j[d1][e1] * j[d2][e2] - j[d1][e2] * j[d2][e1];
            }
        determinant = j[0][0] * cofactor[0][0] + j[0][1] * cofactor[0][1] +
                      j[0][2] * cofactor[0][2];
      }
    for (int a = 0; a < n; ++a)
      for (int e = 0; e < dim; ++e)
        {
          gradient[a][e] = cofactor[0][e] * shape<dim>.slope[q][a][0];
          for (int d = 1; d < dim; ++d)
            gradient[a][e] += cofactor[d][e] * shape<dim>.slope[q][a][d];
        }
    return determinant;
  }
} // namespace Keyblock

#endif
