// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_rock_shape_h
#define keyblock_rock_shape_h

#include <array>

namespace Keyblock
{
  /**
   * Linear shape functions of the quadrilateral (dim = 2) and hexahedron
   * (dim = 3) on [0, 1]^dim in deal.II's vertex order, at the 2^dim Gauss
   * points. All Gauss weights are 1 / 2^dim.
   */
  template <int dim>
  struct Shape
  {
    static constexpr int n           = 1 << dim; ///< vertices = Gauss points
    static constexpr double weight   = 1. / n;
    static constexpr double gauss_lo = 0.21132486540518711775;
    static constexpr double gauss_hi = 0.78867513459481288225;

    std::array<std::array<double, n>, n> value{};
    std::array<std::array<std::array<double, dim>, n>, n> slope{};

    constexpr Shape()
    {
      for (int q = 0; q < n; ++q)
        for (int v = 0; v < n; ++v)
          {
            value[q][v] = 1.;
            for (int d = 0; d < dim; ++d)
              {
                value[q][v] *= factor(q, v, d);
                slope[q][v][d] = ((v >> d) & 1) ? 1. : -1.;
                for (int e = 0; e < dim; ++e)
                  if (e != d)
                    slope[q][v][d] *= factor(q, v, e);
              }
          }
    }

  private:
    static constexpr double
    factor(const int q, const int v, const int d)
    {
      const double s = ((q >> d) & 1) ? gauss_hi : gauss_lo;
      return ((v >> d) & 1) ? s : 1. - s;
    }
  };

  template <int dim>
  inline constexpr Shape<dim> shape{};
} // namespace Keyblock

#endif
