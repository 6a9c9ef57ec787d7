// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_base_vector_h
#define keyblock_base_vector_h

#include <array>
#include <cmath>

namespace Keyblock
{
  /** A few numbers, for loops over contact points and nodes. */
  template <int dim>
  using Vector = std::array<double, dim>;

  template <int dim>
  inline double
  dot(const Vector<dim> &a, const Vector<dim> &b)
  {
    double sum = 0.;
    for (int d = 0; d < dim; ++d)
      sum += a[d] * b[d];
    return sum;
  }

  template <int dim>
  inline double
  norm(const Vector<dim> &a)
  {
    return std::sqrt(dot<dim>(a, a));
  }

  /** a + s b */
  template <int dim>
  inline Vector<dim>
  add(const Vector<dim> &a, const double s, const Vector<dim> &b)
  {
    Vector<dim> result;
    for (int d = 0; d < dim; ++d)
      result[d] = a[d] + s * b[d];
    return result;
  }
} // namespace Keyblock

#endif
