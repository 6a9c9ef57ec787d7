// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_safety_least_support_h
#define keyblock_safety_least_support_h

#include <limits>

namespace Keyblock
{
  /** Halvings by which a demand is found. */
  constexpr unsigned int n_demand_halvings = 60;

  /** Bolts of a set more than which are none. */
  constexpr unsigned int most_bolts = 4096;

  /** The least number at which @p is_enough, which stays so for larger ones;
   * 0: none up to most_bolts. */
  template <typename IsEnough>
  unsigned int
  least_number(const IsEnough &is_enough)
  {
    unsigned int low = 0, high = 1;
    while (!is_enough(high))
      {
        if (high >= most_bolts)
          return 0;
        low = high;
        high *= 2;
      }
    while (high - low > 1)
      {
        const unsigned int middle        = low + (high - low) / 2;
        (is_enough(middle) ? high : low) = middle;
      }
    return high;
  }

  /** The least force for which @p is_enough holds, from @p first on by steps
   * of a @p ratio; more may push the block elsewhere. Infinite if there is
   * none below @p most. */
  template <typename IsEnough>
  double
  least_force(const IsEnough &is_enough,
              const double first,
              const double most,
              const double ratio)
  {
    double low = 0., high = first;
    while (0. < high && high < most && !is_enough(high))
      {
        low = high;
        high *= ratio;
      }
    if (!(0. < high && high < most))
      return std::numeric_limits<double>::infinity();
    for (unsigned int i = 0; i < n_demand_halvings; ++i)
      {
        const double middle              = 0.5 * (low + high);
        (is_enough(middle) ? high : low) = middle;
      }
    return high;
  }
} // namespace Keyblock

#endif
