// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_rock_mohr_coulomb_h
#define keyblock_rock_mohr_coulomb_h

#include <keyblock/rock/material.h>

#include <algorithm>
#include <cmath>

// Mohr-Coulomb plasticity at one point (theory, section 10).
namespace Keyblock
{
  /** Strength of a point, tension positive: k s1 - s3 <= strength and
   * s1 <= tension, for principal stresses s1 >= s2 >= s3. */
  struct YieldStrength
  {
    double slope      = 1.; ///< k = (1 + sin phi) / (1 - sin phi) [-]
    double flow_slope = 1.; ///< the same of the dilation angle [-]
    double uniaxial   = 0.; ///< 2 c sqrt(k), compressive strength [Pa]
    double tension    = 0.; ///< cut-off [Pa]
    double apex       = 0.; ///< c cot phi, or a large number [Pa]

    /** @param angle, @p dilation in radians; a negative @p tensile_strength
     * stands for the apex: no cut-off. */
    static YieldStrength
    from(const double cohesion,
         const double angle,
         const double dilation,
         const double tensile_strength)
    {
      YieldStrength s;
      const auto slope_of = [](const double a) {
        return (1. + std::sin(a)) / (1. - std::sin(a));
      };
      s.slope      = slope_of(angle);
      s.flow_slope = slope_of(dilation);
      s.uniaxial   = 2. * cohesion * std::sqrt(s.slope);
      s.apex       = angle > 0. ? cohesion / std::tan(angle) : 1e30;
      s.tension =
        tensile_strength < 0. ? s.apex : std::min(tensile_strength, s.apex);
      return s;
    }
  };

  /** Strength before and after failure. */
  struct MohrCoulomb
  {
    YieldStrength peak, residual;
    double softening_strain = 0.; ///< from peak to residual [-]
    bool has_residual       = false;

    YieldStrength
    at(const double plastic_strain) const
    {
      if (!has_residual || plastic_strain <= 0.)
        return peak;
      const double share = softening_strain > 0.
                             ? std::min(1., plastic_strain / softening_strain)
                             : 1.;
      const auto mix     = [share](const double a, const double b) {
        return a + share * (b - a);
      };
      YieldStrength s;
      s.slope      = mix(peak.slope, residual.slope);
      s.flow_slope = mix(peak.flow_slope, residual.flow_slope);
      s.uniaxial   = mix(peak.uniaxial, residual.uniaxial);
      s.apex       = s.slope > 1. ? s.uniaxial / (s.slope - 1.) : peak.apex;
      s.tension    = std::min(s.apex, mix(peak.tension, residual.tension));
      return s;
    }
  };



  inline double
  dot(const std::array<double, 3> &a, const std::array<double, 3> &b)
  {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  }



  /**
   * Return principal stresses @p s, sorted s1 >= s2 >= s3, to the yield
   * surface: the point that satisfies every plane and from which the trial
   * stress is reached by elastic strains along the flow directions of the
   * planes it lies on, with multipliers that are not negative (Koiter 1953).
   * For associated flow that is the closest point in the energy norm. Planes
   * are kept as sets of at most three, tried from faces over edges to corners;
   * if no set fits (beyond the apex without dilation) the apex is the answer.
   *
   * @param lambda, @p mu elastic constants [Pa]
   * @return whether the point yields
   */
  inline bool
  return_to_yield_surface(std::array<double, 3> &s,
                          const YieldStrength &strength,
                          const double lambda,
                          const double mu)
  {
    using Triple   = std::array<double, 3>;
    const double k = strength.slope, f = strength.flow_slope;
    const Triple normal[6] = {{{k, 0., -1.}},
                              {{1., 0., 0.}},
                              {{k, -1., 0.}},
                              {{0., k, -1.}},
                              {{0., 1., 0.}},
                              {{0., 0., 1.}}};
    const Triple flow[6]   = {{{f, 0., -1.}},
                              {{1., 0., 0.}},
                              {{f, -1., 0.}},
                              {{0., f, -1.}},
                              {{0., 1., 0.}},
                              {{0., 0., 1.}}};
    const double bound[6]  = {strength.uniaxial,
                              strength.tension,
                              strength.uniaxial,
                              strength.uniaxial,
                              strength.tension,
                              strength.tension};
    const double scale     = std::max({std::abs(s[0]), std::abs(s[2]), 1e-300});
    const double tolerance = 1e-11 * k * scale;
    const auto excess      = [&](const int i, const Triple &x) {
      return dot(normal[i], x) - bound[i];
    };
    if (excess(0, s) <= 0. && excess(1, s) <= 0.)
      return false;

    Triple stiff[6]; // elastic stress of a unit multiplier
    for (int i = 0; i < 6; ++i)
      {
        const double volume = flow[i][0] + flow[i][1] + flow[i][2];
        for (int d = 0; d < 3; ++d)
          stiff[i][d] = lambda * volume + 2. * mu * flow[i][d];
      }
    // tries one set of planes; true if it fits, with the result in s
    const auto fits = [&](const int *set, const int n) {
      double a[3][4];
      for (int i = 0; i < n; ++i)
        {
          for (int j = 0; j < n; ++j)
            a[i][j] = dot(normal[set[i]], stiff[set[j]]);
          a[i][n] = excess(set[i], s);
        }
      for (int i = 0; i < n; ++i)
        {
          int pivot = i;
          for (int r = i + 1; r < n; ++r)
            if (std::abs(a[r][i]) > std::abs(a[pivot][i]))
              pivot = r;
          if (std::abs(a[pivot][i]) < 1e-9 * mu)
            return false;
          std::swap(a[i], a[pivot]);
          for (int r = 0; r < n; ++r)
            if (r != i)
              {
                const double factor = a[r][i] / a[i][i];
                for (int c = i; c <= n; ++c)
                  a[r][c] -= factor * a[i][c];
              }
        }
      Triple x = s;
      for (int i = 0; i < n; ++i)
        {
          const double multiplier = a[i][n] / a[i][i];
          if (multiplier < -1e-12 * scale / mu)
            return false;
          for (int d = 0; d < 3; ++d)
            x[d] -= multiplier * stiff[set[i]][d];
        }
      for (int i = 0; i < 6; ++i)
        if (excess(i, x) > tolerance)
          return false;
      s = x;
      return true;
    };
    for (int i = 0; i < 6; ++i)
      {
        const int set[] = {i};
        if (fits(set, 1))
          return true;
      }
    for (int i = 0; i < 6; ++i)
      for (int j = i + 1; j < 6; ++j)
        {
          const int set[] = {i, j};
          if (fits(set, 2))
            return true;
        }
    for (int i = 0; i < 6; ++i)
      for (int j = i + 1; j < 6; ++j)
        for (int l = j + 1; l < 6; ++l)
          {
            const int set[] = {i, j, l};
            if (fits(set, 3))
              return true;
          }
    s.fill(std::min(strength.apex, strength.tension));
    return true;
  }



  /** Whether a stress is certainly elastic: inside the cone that touches the
   * Mohr-Coulomb pyramid from within, and below the cut-off. Cheap. */
  template <int dim>
  inline bool
  is_surely_elastic(const double *stress, const YieldStrength &strength)
  {
    const double p = (stress[0] + stress[1] + stress[2]) / 3.;
    double j2      = 0.;
    for (int k = 0; k < 3; ++k)
      j2 += 0.5 * (stress[k] - p) * (stress[k] - p);
    for (int k = 3; k < n_stress<dim>; ++k)
      j2 += stress[k] * stress[k];
    const double root = std::sqrt(j2);
    // k s1 - s3 = (k - 1) p + |s| times the amplitude of a cosine of the Lode
    // angle, at most 2 sqrt((k^2 + k + 1) / 3)
    const double k = strength.slope;
    return (k - 1.) * p + 2. * std::sqrt((k * k + k + 1.) / 3.) * root <=
             strength.uniaxial &&
           p + 1.1547005383792517 * root <= strength.tension;
  }



  /** Eigenvalues @p value, not sorted, and eigenvectors (columns of @p vector)
   * of a symmetric matrix, by Jacobi rotations; @p a is overwritten. */
  inline void
  diagonalize(double (&a)[3][3], double (&value)[3], double (&vector)[3][3])
  {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        vector[i][j] = i == j ? 1. : 0.;
    for (int sweep = 0; sweep < 20; ++sweep)
      {
        const double off =
          std::abs(a[0][1]) + std::abs(a[0][2]) + std::abs(a[1][2]);
        const double size =
          std::abs(a[0][0]) + std::abs(a[1][1]) + std::abs(a[2][2]) + off;
        if (off <= 1e-16 * size)
          break;
        for (int i = 0; i < 2; ++i)
          for (int j = i + 1; j < 3; ++j)
            {
              if (a[i][j] == 0.)
                continue;
              const double ratio = 0.5 * (a[j][j] - a[i][i]) / a[i][j];
              const double t     = (ratio >= 0. ? 1. : -1.) /
                               (std::abs(ratio) + std::hypot(1., ratio));
              const double c = 1. / std::hypot(1., t), s = t * c;
              for (int r = 0; r < 3; ++r)
                {
                  const double x = a[r][i], y = a[r][j];
                  a[r][i] = c * x - s * y;
                  a[r][j] = s * x + c * y;
                }
              for (int r = 0; r < 3; ++r)
                {
                  const double x = a[i][r], y = a[j][r];
                  a[i][r] = c * x - s * y;
                  a[j][r] = s * x + c * y;
                }
              for (int r = 0; r < 3; ++r)
                {
                  const double x = vector[r][i], y = vector[r][j];
                  vector[r][i] = c * x - s * y;
                  vector[r][j] = s * x + c * y;
                }
            }
      }
    for (int i = 0; i < 3; ++i)
      value[i] = a[i][i];
  }



  /**
   * Bring a trial @p stress (n_stress<dim> values) back to the yield surface,
   * principal directions kept; in 2D the out-of-plane stress is one of the
   * principal ones. Returns whether the point yields.
   */
  template <int dim>
  inline bool
  apply_mohr_coulomb(const YieldStrength &strength,
                     const double lambda,
                     const double mu,
                     double *stress)
  {
    if (is_surely_elastic<dim>(stress, strength))
      return false;
    double value[3], vector[3][3];
    double cosine = 1., sine = 0.; // of twice the angle to x, in 2D
    if constexpr (dim == 2)
      {
        const double mean   = 0.5 * (stress[0] + stress[1]);
        const double half   = 0.5 * (stress[0] - stress[1]);
        const double radius = std::hypot(half, stress[3]);
        if (radius > 0.)
          {
            cosine = half / radius;
            sine   = stress[3] / radius;
          }
        value[0] = mean + radius;
        value[1] = mean - radius;
        value[2] = stress[2];
      }
    else
      {
        double a[3][3] = {{stress[0], stress[5], stress[4]},
                          {stress[5], stress[1], stress[3]},
                          {stress[4], stress[3], stress[2]}};
        diagonalize(a, value, vector);
      }
    int order[3] = {0, 1, 2};
    std::sort(order, order + 3, [&](const int i, const int j) {
      return value[i] > value[j];
    });
    std::array<double, 3> s = {
      {value[order[0]], value[order[1]], value[order[2]]}};
    if (!return_to_yield_surface(s, strength, lambda, mu))
      return false;
    for (int i = 0; i < 3; ++i)
      value[order[i]] = s[i];
    if constexpr (dim == 2)
      {
        const double mean   = 0.5 * (value[0] + value[1]);
        const double radius = 0.5 * (value[0] - value[1]);
        stress[0]           = mean + radius * cosine;
        stress[1]           = mean - radius * cosine;
        stress[2]           = value[2];
        stress[3]           = radius * sine;
      }
    else
      {
        const int row[6] = {0, 1, 2, 1, 0, 0}, column[6] = {0, 1, 2, 2, 2, 1};
        for (int k = 0; k < 6; ++k)
          {
            stress[k] = 0.;
            for (int i = 0; i < 3; ++i)
              stress[k] += value[i] * vector[row[k]][i] * vector[column[k]][i];
          }
      }
    return true;
  }
} // namespace Keyblock

#endif
