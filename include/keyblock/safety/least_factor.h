// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_safety_least_factor_h
#define keyblock_safety_least_factor_h

#include <keyblock/safety/safety_factor.h>

namespace Keyblock
{
  /**
   * Of @p factors after several stages the most dangerous one of a block, by
   * its index: the least, of equal ones (all that end at SafetySettings::wanted
   * or hold at SafetySettings::highest are equal) that with the least factor by
   * limit equilibrium, then that which asks for the most support, then the
   * last. Null: none was looked for.
   */
  const SafetyFactor *least_factor(const std::vector<SafetyFactor> &factors,
                                   const unsigned int block);

  /** That which asks for the most support of the factors of a block, the first
   * of equal ones. Null: none asks for a factor. */
  const SafetyFactor *largest_demand(const std::vector<SafetyFactor> &factors,
                                     const unsigned int block);

  /** The same of support by trials; what is out of reach is most. Null: none
   * was looked for. */
  const SafetyFactor *
  largest_tried_demand(const std::vector<SafetyFactor> &factors,
                       const unsigned int block);
} // namespace Keyblock

#endif
