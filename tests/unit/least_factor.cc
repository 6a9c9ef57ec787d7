// SPDX-License-Identifier: LGPL-2.1-or-later
// The most dangerous of the factors of a block after several stages.
#include <boost/test/unit_test.hpp>

#include <keyblock/safety/least_factor.h>

#include <limits>

using namespace Keyblock;

namespace
{
  using Outcome = SafetyFactor::Outcome;

  constexpr double infinity = std::numeric_limits<double>::infinity();

  /** A factor of block 0 with that of limit equilibrium and the support [N]
   * that it asks for; no support: none is wanted. */
  SafetyFactor
  factor_of(const std::string &stage,
            const Outcome outcome,
            const double lower,
            const double limit,
            const double support = -1.)
  {
    SafetyFactor factor;
    factor.stage   = stage;
    factor.outcome = outcome;
    factor.lower = factor.upper = lower;
    factor.limit_factor         = limit;
    if (support >= 0.)
      {
        factor.support_demand.factor = 1.2;
        factor.support_demand.force  = support;
      }
    return factor;
  }

  std::string
  stage_of(const SafetyFactor *factor)
  {
    return factor == nullptr ? "none" : factor->stage;
  }
} // namespace



BOOST_AUTO_TEST_CASE(stages_that_end_at_the_wanted_factor)
{
  for (const Outcome outcome : {Outcome::met, Outcome::clamped})
    {
      std::vector<SafetyFactor> factors = {
        factor_of("dig", outcome, 1.2, 0., 211.4e3),
        factor_of("bolt", outcome, 1.2, infinity, 0.)};
      BOOST_TEST(stage_of(least_factor(factors, 0)) == "dig");
      BOOST_TEST(stage_of(largest_demand(factors, 0)) == "dig");
      BOOST_TEST(stage_of(least_factor(factors, 1)) == "none");
      std::swap(factors[0], factors[1]);
      BOOST_TEST(stage_of(least_factor(factors, 0)) == "dig");
      BOOST_TEST(stage_of(largest_demand(factors, 0)) == "dig");
      // of equal ones that with the larger demand, then the last
      factors.push_back(factor_of("water", outcome, 1.2, 0., infinity));
      BOOST_TEST(stage_of(least_factor(factors, 0)) == "water");
      BOOST_TEST(stage_of(largest_demand(factors, 0)) == "water");
      factors.push_back(factor_of("wait", outcome, 1.2, 0., infinity));
      BOOST_TEST(stage_of(least_factor(factors, 0)) == "wait");
    }
}



BOOST_AUTO_TEST_CASE(least_factor_and_largest_demand_of_different_stages)
{
  const std::vector<SafetyFactor> factors = {
    factor_of("dig", Outcome::met, 1.2, 0.5, 3e3),
    factor_of("shake", Outcome::bracketed, 1.1, 0.9, 1e3),
    factor_of("bolt", Outcome::met, 1.2, infinity)};
  BOOST_TEST(stage_of(least_factor(factors, 0)) == "shake");
  BOOST_TEST(stage_of(largest_demand(factors, 0)) == "dig");
  BOOST_TEST(stage_of(largest_demand({factors[2]}, 0)) == "none");
}



BOOST_AUTO_TEST_CASE(largest_demand_by_trials)
{
  const auto asking = [](const std::string &stage,
                         const TriedDemand::Outcome outcome,
                         const double upper) {
    SafetyFactor factor;
    factor.stage                = stage;
    factor.tried_demand.outcome = outcome;
    factor.tried_demand.lower = factor.tried_demand.upper = upper;
    factor.tried_demand.area                              = 2.;
    return factor;
  };
  std::vector<SafetyFactor> factors = {
    asking("dig", TriedDemand::Outcome::met, 0.),
    asking("bench", TriedDemand::Outcome::bracketed, 3e3),
    asking("bolt", TriedDemand::Outcome::bracketed, 2e3),
    SafetyFactor()};
  BOOST_TEST(stage_of(largest_tried_demand(factors, 0)) == "bench");
  BOOST_TEST(factors[1].tried_demand.force() == 6e3);
  BOOST_TEST(stage_of(largest_tried_demand({factors[3]}, 0)) == "none");
  factors.push_back(asking("lake", TriedDemand::Outcome::out_of_reach, 0.));
  BOOST_TEST(stage_of(largest_tried_demand(factors, 0)) == "lake");
}
