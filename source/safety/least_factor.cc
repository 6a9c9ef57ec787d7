// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/safety/least_factor.h>

#include <algorithm>
#include <limits>
#include <tuple>

namespace Keyblock
{
  namespace
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();

    /** The factor, or the greatest number that it is known to exceed. */
    double
    size_of(const SafetyFactor &factor)
    {
      using Outcome = SafetyFactor::Outcome;
      double alone  = infinity;
      if (factor.outcome == Outcome::falls_freely)
        alone = 0.;
      else if (factor.outcome == Outcome::bracketed)
        alone = factor.value();
      else if (factor.outcome == Outcome::undecided)
        alone =
          factor.undecided_lower > 0. ? factor.undecided_lower : factor.lower;
      else if (factor.outcome != Outcome::immovable &&
               factor.outcome != Outcome::by_statics &&
               factor.outcome != Outcome::carried)
        alone = factor.lower;
      return factor.group.empty() ? alone
                                  : std::min(alone, factor.value_of_group());
    }

    std::tuple<double, double, double>
    order_of(const SafetyFactor &factor)
    {
      return {size_of(factor),
              factor.limit_factor,
              -factor.support_demand.force};
    }
  } // namespace



  const SafetyFactor *
  least_factor(const std::vector<SafetyFactor> &factors,
               const unsigned int block)
  {
    const SafetyFactor *least = nullptr;
    for (const SafetyFactor &factor : factors)
      if (factor.block == block &&
          (least == nullptr || order_of(factor) <= order_of(*least)))
        least = &factor;
    return least;
  }



  const SafetyFactor *
  largest_demand(const std::vector<SafetyFactor> &factors,
                 const unsigned int block)
  {
    const SafetyFactor *largest = nullptr;
    for (const SafetyFactor &factor : factors)
      if (factor.block == block && factor.support_demand.factor > 0. &&
          (largest == nullptr ||
           factor.support_demand.force > largest->support_demand.force))
        largest = &factor;
    return largest;
  }



  const SafetyFactor *
  largest_tried_demand(const std::vector<SafetyFactor> &factors,
                       const unsigned int block)
  {
    using Outcome      = TriedDemand::Outcome;
    const auto size_of = [](const TriedDemand &demand) {
      return demand.outcome == Outcome::bracketed ? demand.force()
             : demand.outcome == Outcome::met     ? 0.
                                                  : infinity;
    };
    const SafetyFactor *largest = nullptr;
    for (const SafetyFactor &factor : factors)
      if (factor.block == block &&
          factor.tried_demand.outcome != Outcome::not_sought &&
          (largest == nullptr ||
           size_of(factor.tried_demand) > size_of(largest->tried_demand)))
        largest = &factor;
    return largest;
  }
} // namespace Keyblock
