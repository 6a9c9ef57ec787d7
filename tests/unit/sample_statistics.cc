// SPDX-License-Identifier: LGPL-2.1-or-later
// Statistics of samples, and the distributions that they are drawn from.
#include <keyblock/safety/sample_statistics.h>
#include <keyblock/scene/study.h>

#include <boost/test/unit_test.hpp>

#include <cmath>

BOOST_AUTO_TEST_SUITE(sample_statistics)

using namespace Keyblock;

namespace
{
  /** Mean and deviation of a variable, by its quantiles. */
  SampleStatistics
  drawn(const StudyVariable &variable)
  {
    constexpr unsigned int n = 20000;
    std::vector<double> values;
    for (unsigned int i = 0; i < n; ++i)
      values.push_back(variable.quantile((i + 0.5) / n, i));
    return SampleStatistics(values);
  }

  StudyVariable
  variable(const Distribution distribution)
  {
    StudyVariable v;
    v.distribution = distribution;
    v.mean         = 30.;
    v.deviation    = 6.;
    return v;
  }

  bool
  is_near(const double a, const double b, const double tolerance)
  {
    return std::abs(a - b) < tolerance;
  }
} // namespace

BOOST_AUTO_TEST_CASE(distributions_have_their_moments)
{
  for (const Distribution d : {Distribution::normal, Distribution::lognormal})
    {
      const SampleStatistics s = drawn(variable(d));
      BOOST_TEST(is_near(s.mean, 30., 1e-3));
      BOOST_TEST(is_near(s.deviation, 6., 1e-2));
    }
  const SampleStatistics e = drawn(variable(Distribution::exponential));
  BOOST_TEST(is_near(e.mean, 30., 1e-2));
  BOOST_TEST(is_near(e.deviation, 30., 1e-1));

  StudyVariable v = variable(Distribution::uniform);
  v.minimum       = 2.;
  v.maximum       = 8.;
  BOOST_TEST(is_near(drawn(v).mean, 5., 1e-9));
  BOOST_TEST(is_near(drawn(v).deviation, 6. / std::sqrt(12.), 1e-3));
  v.distribution = Distribution::triangular;
  v.mode         = 2.;
  BOOST_TEST(is_near(drawn(v).mean, 4., 1e-3));
  BOOST_TEST(is_near(drawn(v).deviation, 6. / std::sqrt(18.), 1e-3));
  v.distribution = Distribution::sequence;
  BOOST_TEST(v.quantile(0.3, 7) == 9.);
}

BOOST_AUTO_TEST_CASE(distributions_are_cut_off)
{
  StudyVariable v = variable(Distribution::normal);
  v.minimum       = 30.;
  v.maximum       = 36.;
  // of what lies between one deviation and the mean, half is below
  // mean + 0.4399 deviations
  const SampleStatistics s = drawn(v);
  BOOST_TEST(s.sorted.front() >= 30.);
  BOOST_TEST(s.sorted.back() <= 36.);
  BOOST_TEST(is_near(s.percentile(0.5), 30. + 6. * 0.4440, 0.05));
}

BOOST_AUTO_TEST_CASE(probabilities_have_intervals)
{
  // Wilson (1927): 8 of 10
  const ProbabilityEstimate p = estimate_probability(8, 10);
  BOOST_TEST(p.value == 0.8);
  BOOST_TEST(is_near(p.lower, 0.4902, 1e-4));
  BOOST_TEST(is_near(p.upper, 0.9433, 1e-4));
  BOOST_TEST(estimate_probability(0, 50).lower == 0.);
  BOOST_TEST(is_near(estimate_probability(0, 50).upper, 0.07135, 1e-4));
}

BOOST_AUTO_TEST_CASE(ranks_are_correlated)
{
  BOOST_TEST(is_near(rank_correlation({1., 2., 3.}, {1., 8., 27.}), 1., 1e-12));
  BOOST_TEST(is_near(rank_correlation({1., 2., 3.}, {9., 4., 1.}), -1., 1e-12));
  BOOST_TEST(rank_correlation({1., 1., 1.}, {1., 2., 3.}) == 0.);
  // round-off has no rank
  BOOST_TEST(
    rank_correlation({1., 2., 3.}, {1. + 2e-16, 1. - 1e-16, 1. - 2e-16}) == 0.);
  BOOST_TEST(is_near(rank_correlation({1., 2., 3.}, {1., 1. + 1e-9, 1. + 2e-9}),
                     1.,
                     1e-12));
  // ties share their rank
  BOOST_TEST(is_near(rank_correlation({1., 2., 2., 3.}, {1., 2., 3., 4.}),
                     0.94868,
                     1e-5));
}

BOOST_AUTO_TEST_SUITE_END()
