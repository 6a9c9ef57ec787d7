// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/rock/quadratic_fit.h>

#include <cmath>

namespace Keyblock
{
  namespace
  {
    /** Share of its diagonal entry that is left of a pivot of equations that
     * can be solved [-]. */
    constexpr double least_pivot = 1e-5;

    /** Squared distance that points nearer than it count alike within [-]. */
    constexpr double near = 0.05;
  } // namespace



  QuadraticFit::QuadraticFit(const std::vector<std::array<double, 2>> &points)
  {
    std::array<std::array<double, n>, n> lower{};
    std::vector<std::array<double, n>> functions;
    for (const auto &[x, y] : points)
      {
        functions.push_back({{1., x, y, 0.5 * x * x, x * y, 0.5 * y * y}});
        const double root = 1. / (x * x + y * y + near);
        weights.emplace_back();
        for (unsigned int i = 0; i < n; ++i)
          {
            weights.back()[i] = root * root * functions.back()[i];
            for (unsigned int j = 0; j <= i; ++j)
              lower[i][j] += weights.back()[i] * functions.back()[j];
          }
      }
    // Cholesky's decomposition of the normal equations
    for (unsigned int i = 0; i < n; ++i)
      {
        const double whole = lower[i][i];
        for (unsigned int j = 0; j <= i; ++j)
          {
            for (unsigned int k = 0; k < j; ++k)
              lower[i][j] -= lower[i][k] * lower[j][k];
            if (j < i)
              lower[i][j] /= lower[j][j];
          }
        if (!(lower[i][i] > least_pivot * whole))
          {
            weights.clear();
            return;
          }
        lower[i][i] = std::sqrt(lower[i][i]);
      }
    for (auto &w : weights)
      {
        for (unsigned int i = 0; i < n; ++i)
          {
            for (unsigned int k = 0; k < i; ++k)
              w[i] -= lower[i][k] * w[k];
            w[i] /= lower[i][i];
          }
        for (unsigned int i = n; i-- > 0;)
          {
            for (unsigned int k = i + 1; k < n; ++k)
              w[i] -= lower[k][i] * w[k];
            w[i] /= lower[i][i];
          }
      }
  }
} // namespace Keyblock
