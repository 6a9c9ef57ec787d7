// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_rock_material_h
#define keyblock_rock_material_h

#include <keyblock/base/simd.h>

#include <array>

namespace Keyblock
{
  /** Stress components: xx, yy, zz, xy in 2D; xx, yy, zz, yz, xz, xy in 3D. */
  template <int dim>
  constexpr int n_stress = dim == 2 ? 4 : 6;

  template <int dim, typename Number>
  using Gradient = std::array<std::array<Number, dim>, dim>;

  /**
   * Stress of a linear elastic body under the symmetric part of the
   * displacement gradient @p g, plane strain in 2D: adds
   * lambda tr(e) 1 + 2 mu e to @p stress, which holds n_stress<dim> values.
   */
  template <int dim, typename Number>
  KEYBLOCK_ALWAYS_INLINE void
  add_elastic_stress(const Gradient<dim, Number> &g,
                     const Number lambda,
                     const Number mu,
                     Number *stress)
  {
    if constexpr (dim == 2)
      {
        const Number pressure = lambda * (g[0][0] + g[1][1]);
        stress[0] += pressure + 2. * mu * g[0][0];
        stress[1] += pressure + 2. * mu * g[1][1];
        stress[2] += pressure;
        stress[3] += mu * (g[0][1] + g[1][0]);
      }
    else
      {
        const Number pressure = lambda * (g[0][0] + g[1][1] + g[2][2]);
        stress[0] += pressure + 2. * mu * g[0][0];
        stress[1] += pressure + 2. * mu * g[1][1];
        stress[2] += pressure + 2. * mu * g[2][2];
        stress[3] += mu * (g[1][2] + g[2][1]);
        stress[4] += mu * (g[0][2] + g[2][0]);
        stress[5] += mu * (g[0][1] + g[1][0]);
      }
  }



  /** Stress times a vector: row sums of stress . g. */
  template <int dim, typename Number>
  KEYBLOCK_ALWAYS_INLINE std::array<Number, dim>
  apply_stress(const Number *stress, const std::array<Number, dim> &g)
  {
    if constexpr (dim == 2)
      return {{stress[0] * g[0] + stress[3] * g[1],
               stress[3] * g[0] + stress[1] * g[1]}};
    else
      return {{stress[0] * g[0] + stress[5] * g[1] + stress[4] * g[2],
               stress[5] * g[0] + stress[1] * g[1] + stress[3] * g[2],
               stress[4] * g[0] + stress[3] * g[1] + stress[2] * g[2]}};
  }



  /**
   * Rotate @p stress by the rotation that belongs to the displacement gradient
   * @p g taken at the middle of the step: Q = (1 - W/2)^-1 (1 + W/2), W its
   * skew part. Exact for rigid rotations (Hughes and Winget 1980).
   */
  template <int dim, typename Number>
  KEYBLOCK_ALWAYS_INLINE void
  rotate_stress(const Gradient<dim, Number> &g, Number *stress)
  {
    if constexpr (dim == 2)
      {
        const Number half  = 0.25 * (g[1][0] - g[0][1]); // tan(angle / 2)
        const Number scale = 1. / (1. + half * half);
        const Number c = (1. - half * half) * scale, s = 2. * half * scale;
        const Number mean = 0.5 * (stress[0] + stress[1]);
        const Number diff = 0.5 * (stress[0] - stress[1]);
        const Number c2 = c * c - s * s, s2 = 2. * s * c;
        const Number shear = stress[3];
        stress[0]          = mean + diff * c2 - shear * s2;
        stress[1]          = mean - diff * c2 + shear * s2;
        stress[3]          = diff * s2 + shear * c2;
      }
    else
      {
        // Cayley map of the half-step axial vector r
        const std::array<Number, 3> r = {{0.25 * (g[2][1] - g[1][2]),
                                          0.25 * (g[0][2] - g[2][0]),
                                          0.25 * (g[1][0] - g[0][1])}};
        const Number r2               = r[0] * r[0] + r[1] * r[1] + r[2] * r[2];
        const Number scale            = 2. / (1. + r2);
        Number q[3][3];
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j)
            q[i][j] =
              scale * r[i] * r[j] + (i == j ? 1. - scale * r2 : 0. * r2);
        q[0][1] -= scale * r[2];
        q[1][0] += scale * r[2];
        q[0][2] += scale * r[1];
        q[2][0] -= scale * r[1];
        q[1][2] -= scale * r[0];
        q[2][1] += scale * r[0];
        const Number s[3][3] = {{stress[0], stress[5], stress[4]},
                                {stress[5], stress[1], stress[3]},
                                {stress[4], stress[3], stress[2]}};
        const int row[6] = {0, 1, 2, 1, 0, 0}, column[6] = {0, 1, 2, 2, 2, 1};
        for (int k = 0; k < 6; ++k)
          {
            Number sum = 0. * r2;
            for (int i = 0; i < 3; ++i)
              for (int j = 0; j < 3; ++j)
                sum += q[row[k]][i] * s[i][j] * q[column[k]][j];
            stress[k] = sum;
          }
      }
  }



  /** Elastic energy per volume, half of stress : C^-1 : stress [J/m3]. */
  template <int dim, typename Number>
  KEYBLOCK_ALWAYS_INLINE Number
  elastic_energy_density(const Number *stress,
                         const Number lambda,
                         const Number mu)
  {
    Number square = Number();
    for (int k = 0; k < 3; ++k)
      square += stress[k] * stress[k];
    for (int k = 3; k < n_stress<dim>; ++k)
      square += 2. * stress[k] * stress[k];
    const Number trace = stress[0] + stress[1] + stress[2];
    return (square - lambda / (3. * lambda + 2. * mu) * trace * trace) /
           (4. * mu);
  }
} // namespace Keyblock

#endif
