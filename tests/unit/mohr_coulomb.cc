// SPDX-License-Identifier: LGPL-2.1-or-later
// Returns to the Mohr-Coulomb surface at a single point.
#include <boost/test/unit_test.hpp>

#include <keyblock/rock/mohr_coulomb.h>

#include <random>

BOOST_AUTO_TEST_SUITE(mohr_coulomb)

using namespace Keyblock;

namespace
{
  constexpr double radian = 3.14159265358979323846 / 180.;
  constexpr double young = 15e9, poisson = 0.3;
  constexpr double mu = young / (2. * (1. + poisson));
  constexpr double lambda =
    young * poisson / ((1. + poisson) * (1. - 2. * poisson));

  using Triple = std::array<double, 3>;

  /** The rock of the powerhouse: c = 0.6 MPa, phi = 35 degrees. */
  YieldStrength
  rock(const double dilation, const double tension = -1.)
  {
    return YieldStrength::from(0.6e6, 35. * radian, dilation * radian, tension);
  }

  void
  check_return(const YieldStrength &strength,
               const Triple &trial,
               const Triple &expected)
  {
    Triple s = {{1e6 * trial[0], 1e6 * trial[1], 1e6 * trial[2]}};
    BOOST_TEST(return_to_yield_surface(s, strength, lambda, mu));
    for (int i = 0; i < 3; ++i)
      BOOST_TEST(std::abs(s[i] - 1e6 * expected[i]) <= 1.);
  }

  /** Elastic energy of the difference of two principal stresses. */
  double
  distance(const Triple &a, const Triple &b)
  {
    const double stress[6] = {
      a[0] - b[0], a[1] - b[1], a[2] - b[2], 0., 0., 0.};
    return elastic_energy_density<3>(stress, lambda, mu);
  }
} // namespace

BOOST_AUTO_TEST_CASE(returns_to_faces_edges_apex_and_cut_off)
{
  const YieldStrength s = rock(10.);
  BOOST_TEST(std::abs(s.slope - 3.690172) < 1e-6);
  BOOST_TEST(std::abs(s.uniaxial - 2.305179e6) < 1.);
  BOOST_TEST(std::abs(s.apex - 0.856889e6) < 1.);
  check_return(s, {{0., -2., -8.}}, {{-1.394165, -2.253215, -7.449886}});
  check_return(s, {{1., 0.8, -3.}}, {{-0.021510, -0.021510, -2.384556}});
  check_return(s, {{2., 1.8, 1.5}}, {{0.856889, 0.856889, 0.856889}});
  check_return(rock(10., 0.3e6), {{1., -0.2, -0.5}}, {{0.3, -0.5, -0.8}});
  // without dilation no flow reaches the apex, which is the answer all the same
  check_return(rock(0.), {{2., 1.8, 1.5}}, {{0.856889, 0.856889, 0.856889}});
}

BOOST_AUTO_TEST_CASE(strength_under_confinement)
{
  // compression strength at confinements of 1 and 5 MPa, extension at 5 MPa
  for (const auto &[confinement, axial] :
       {std::array<double, 2>{{1., 5.99535}}, {{5., 20.75604}}})
    {
      Triple s = {
        {-1e6 * confinement, -1e6 * confinement, -1e6 * (axial + 1e-5)}};
      BOOST_TEST(return_to_yield_surface(s, rock(10.), lambda, mu));
      s = {{-1e6 * confinement, -1e6 * confinement, -1e6 * (axial - 1e-5)}};
      BOOST_TEST(!return_to_yield_surface(s, rock(10.), lambda, mu));
    }
  Triple s = {{-0.730270e6 + 2., -5e6, -5e6}};
  BOOST_TEST(return_to_yield_surface(s, rock(10.), lambda, mu));
  s = {{-0.730270e6 - 2., -5e6, -5e6}};
  BOOST_TEST(!return_to_yield_surface(s, rock(10.), lambda, mu));
}

BOOST_AUTO_TEST_CASE(random_trials_end_on_the_surface)
{
  std::mt19937 random(1);
  std::uniform_real_distribution<double> stress(-20e6, 6e6), angle(0., 60.),
    share(0., 1.);
  unsigned int n_returns = 0;
  for (unsigned int i = 0; i < 20000; ++i)
    {
      const double phi         = angle(random);
      const bool is_cut        = share(random) < 0.5;
      const double cohesion    = 2e6 * share(random);
      const bool is_associated = share(random) < 0.5;
      const double psi         = is_associated ? phi : phi * share(random);
      const YieldStrength strength =
        YieldStrength::from(cohesion,
                            phi * radian,
                            psi * radian,
                            is_cut ? cohesion * share(random) : -1.);
      Triple trial = {{stress(random), stress(random), stress(random)}};
      std::sort(trial.begin(), trial.end(), std::greater<double>());
      Triple s = trial;
      if (!return_to_yield_surface(s, strength, lambda, mu))
        continue;
      ++n_returns;
      BOOST_TEST(strength.slope * s[0] - s[2] - strength.uniaxial <=
                 1e-9 * 20e6 * strength.slope);
      BOOST_TEST(s[0] - strength.tension <= 1e-9 * 20e6);
      BOOST_TEST(s[0] >= s[1] - 1e-3);
      BOOST_TEST(s[1] >= s[2] - 1e-3);
      if (!is_associated)
        continue;
      // closest point: no admissible neighbour is nearer to the trial
      const double least = distance(trial, s);
      for (unsigned int j = 0; j < 20; ++j)
        {
          Triple other = s;
          for (double &x : other)
            x += 1e4 * (share(random) - 0.5);
          std::sort(other.begin(), other.end(), std::greater<double>());
          if (strength.slope * other[0] - other[2] <= strength.uniaxial &&
              other[0] <= strength.tension)
            BOOST_TEST(distance(trial, other) >= least * (1. - 1e-9));
        }
    }
  BOOST_TEST(n_returns > 5000);
}

BOOST_AUTO_TEST_CASE(tensors_return_like_their_principal_stresses)
{
  // (0, -2, -8) MPa turned about two axes, and in the plane
  const YieldStrength strength = rock(10.);
  const double expected[3]     = {-1.394165e6, -2.253215e6, -7.449886e6};
  const double c = std::cos(0.7), s = std::sin(0.7);
  const double d = std::cos(1.9), e = std::sin(1.9);
  const double axis[3][3] = {{c, s * d, s * e},
                             {-s, c * d, c * e},
                             {0., -e, d}};
  const double trial[3]   = {0., -2e6, -8e6};
  const int row[6] = {0, 1, 2, 1, 0, 0}, column[6] = {0, 1, 2, 2, 2, 1};
  double stress[6] = {}, exact[6] = {};
  for (int k = 0; k < 6; ++k)
    for (int i = 0; i < 3; ++i)
      {
        stress[k] += trial[i] * axis[i][row[k]] * axis[i][column[k]];
        exact[k] += expected[i] * axis[i][row[k]] * axis[i][column[k]];
      }
  BOOST_TEST(apply_mohr_coulomb<3>(strength, lambda, mu, stress));
  for (int k = 0; k < 6; ++k)
    BOOST_TEST(std::abs(stress[k] - exact[k]) <= 1.);

  double plane[4] = {-4e6 + 4e6 * std::cos(0.8),
                     -4e6 - 4e6 * std::cos(0.8),
                     -2e6,
                     4e6 * std::sin(0.8)};
  BOOST_TEST(apply_mohr_coulomb<2>(strength, lambda, mu, plane));
  const double mean = 0.5 * (expected[0] + expected[2]);
  const double half = 0.5 * (expected[0] - expected[2]);
  BOOST_TEST(std::abs(plane[0] - mean - half * std::cos(0.8)) <= 1.);
  BOOST_TEST(std::abs(plane[2] - expected[1]) <= 1.);
  BOOST_TEST(std::abs(plane[3] - half * std::sin(0.8)) <= 1.);
}

BOOST_AUTO_TEST_CASE(surely_elastic_is_elastic)
{
  std::mt19937 random(2);
  std::uniform_real_distribution<double> stress(-8e6, 1e6);
  const YieldStrength strength = rock(0.);
  unsigned int n_sure          = 0;
  for (unsigned int i = 0; i < 20000; ++i)
    {
      Triple s        = {{stress(random), stress(random), stress(random)}};
      double point[6] = {s[0], s[1], s[2], 0., 0., 0.};
      if (!is_surely_elastic<3>(point, strength))
        continue;
      ++n_sure;
      std::sort(s.begin(), s.end(), std::greater<double>());
      BOOST_TEST(!return_to_yield_surface(s, strength, lambda, mu));
    }
  BOOST_TEST(n_sure > 100);
}

BOOST_AUTO_TEST_SUITE_END()
