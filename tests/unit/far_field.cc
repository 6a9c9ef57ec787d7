// SPDX-License-Identifier: LGPL-2.1-or-later
// Kelvin's fields: gradients are derivatives of the displacements, stresses are
// in equilibrium, and a single force is carried by any surface around it.
#include <boost/test/unit_test.hpp>

#include <keyblock/far_field.h>

using namespace Keyblock;

namespace
{
  template <int dim>
  void
  check_fields()
  {
    const KelvinFields<dim> fields{2., 3.};
    const double step = 1e-4;
    Point<dim> x;
    for (int d = 0; d < dim; ++d)
      x[d] = 0.7 - 0.45 * d;
    for (unsigned int m = 0; m < KelvinFields<dim>::n; ++m)
      {
        const auto gradient = fields.gradient(m, x);
        Tensor<1, dim> divergence;
        for (int d = 0; d < dim; ++d)
          {
            Tensor<1, dim> shift;
            shift[d]                   = step;
            const Tensor<1, dim> slope = (fields.displacement(m, x + shift) -
                                          fields.displacement(m, x - shift)) /
                                         (2. * step);
            for (int i = 0; i < dim; ++i)
              BOOST_TEST(std::abs(slope[i] - gradient[i][d]) < 1e-6);
            divergence += (fields.stress(m, x + shift)[d] -
                           fields.stress(m, x - shift)[d]) /
                          (2. * step);
          }
        BOOST_TEST(divergence.norm() < 1e-5 * fields.stress(m, x).norm());
      }
  }
} // namespace

BOOST_AUTO_TEST_CASE(kelvin_fields)
{
  check_fields<2>();
  check_fields<3>();
}

// a force of 8 pi mu (1 - nu) * 2 along each axis: midpoint rule on a sphere
BOOST_AUTO_TEST_CASE(kelvin_force)
{
  const KelvinFields<3> fields{2., 3.};
  const unsigned int n = 100;
  const double pi      = dealii::numbers::PI;
  for (unsigned int j = 0; j < 3; ++j)
    {
      Tensor<1, 3> carried;
      for (unsigned int a = 0; a < n; ++a)
        for (unsigned int b = 0; b < 2 * n; ++b)
          {
            const double polar = pi * (a + 0.5) / n, turn = pi * (b + 0.5) / n;
            const Point<3> x(std::sin(polar) * std::cos(turn),
                             std::sin(polar) * std::sin(turn),
                             std::cos(polar));
            carried -=
              fields.stress(j, x) * x * std::sin(polar) * (pi / n) * (pi / n);
          }
      carried[j] -= 16. * pi * fields.mu * (1. - fields.poisson_ratio());
      BOOST_TEST(carried.norm() < 0.05); // of 105.6, the rule 0.011
    }
}
