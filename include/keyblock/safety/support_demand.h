// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_safety_support_demand_h
#define keyblock_safety_support_demand_h

#include <set>
#include <string>
#include <utility>
#include <vector>

namespace Keyblock
{
  /** What a wanted factor of a block asks for besides the support it has. */
  struct SupportDemand
  {
    double factor = 0.; ///< the wanted one; 0: none is wanted [-]
    /** Against the free faces, without the ground's surface that a block with a
     * dug face moves away from; infinite: none does [N]. */
    double force    = 0.;
    double pressure = 0.; ///< the same, uniform on these faces [Pa]

    /** The same by bolts of the scene's sets: in 2D their number in each of the
     * rings that the set's Spacing parts. Where it has bolts of the set, more
     * like them; 0: no number does. Else, of bolts normal to those faces. */
    std::vector<std::pair<std::string, unsigned int>> numbers;

    std::vector<unsigned int> others; ///< that it goes with, whose free faces
                                      ///< and bolts count, too, by index

    /** Sets whose bolts all end in blocks that it goes with. */
    std::set<std::string> loose_sets;

    /** Ask for what another one of the same block asks for, too: the greater
     * force, and of each set bolts that are enough for both. */
    void include(const SupportDemand &other);
  };
} // namespace Keyblock

#endif
