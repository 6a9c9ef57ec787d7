// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_output_factor_json_h
#define keyblock_output_factor_json_h

#include <keyblock/safety/safety_factor.h>

#include <nlohmann/json.hpp>

#include <vector>

// Safety factors as they stand in summary.json.
namespace Keyblock
{
  using Json = nlohmann::ordered_json;

  /** The factor of limit equilibrium, or that there is none that fails. */
  void put_limit_factor(const double factor, Json &json);

  /** Factors of one block, in the order of the stages. */
  void put_factors(const std::vector<SafetyFactor> &factors,
                   const unsigned int block,
                   Json &json);
} // namespace Keyblock

#endif
