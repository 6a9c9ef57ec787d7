// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_safety_support_demand_h
#define keyblock_safety_support_demand_h

#include <string>
#include <utility>
#include <vector>

namespace Keyblock
{
  /** What a wanted factor of a block asks for besides the support it has. */
  struct SupportDemand
  {
    double factor   = 0.; ///< the wanted one; 0: none is wanted [-]
    double force    = 0.; ///< against the free faces; infinite: none does [N]
    double pressure = 0.; ///< the same, uniform on the free faces [Pa]

    /** The same by bolts of the scene's sets normal to the free faces: in 2D
     * their number in each of the rings that the set's Spacing parts. */
    std::vector<std::pair<std::string, unsigned int>> numbers;
  };
} // namespace Keyblock

#endif
