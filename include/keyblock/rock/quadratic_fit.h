// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_rock_quadratic_fit_h
#define keyblock_rock_quadratic_fit_h

#include <array>
#include <vector>

namespace Keyblock
{
  /**
   * Weights of the values at points of a plane in the quadratic function that
   * comes nearest to them, nearer points counting for more; quadratic functions
   * are met exactly. No points if the given ones do not tell such a function,
   * as six on a conic do not.
   */
  class QuadraticFit
  {
  public:
    /** @param points about the origin, distances of about one */
    explicit QuadraticFit(const std::vector<std::array<double, 2>> &points);

    unsigned int
    n_points() const
    {
      return weights.size();
    }

    /** Of value @p i in the slope along the second axis at the origin. */
    double
    slope(const unsigned int i) const
    {
      return weights[i][2];
    }

  private:
    static constexpr unsigned int n = 6;
    std::vector<std::array<double, n>> weights; ///< of 1, x, y, xx, xy, yy
  };
} // namespace Keyblock

#endif
