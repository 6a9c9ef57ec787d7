// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_blocks_excavation_parts_h
#define keyblock_blocks_excavation_parts_h

#include <keyblock/mesh/surface.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace Keyblock
{
  /** Faces this much steeper than 45 degrees are still roof or floor, so that
   * rounding does not part those at 45 degrees, as horseshoes of six chords
   * have [-]. */
  constexpr double part_tolerance = 1e-5;

  /** Part of an excavation, roof, walls or floor, of a face whose unit normal
   * into the rock has the component @p up [-]. */
  inline std::string
  part_of_excavation(const double up)
  {
    return std::abs(up) < std::sqrt(0.5) - part_tolerance ? "walls"
           : up > 0.                                      ? "roof"
                                                          : "floor";
  }

  /** Whether a face with the unit normal @p inward, into the rock, is of one of
   * the @p parts, as upward() is @p up. */
  template <int dim>
  bool
  is_of_parts(const Tensor<1, dim> &inward,
              const Tensor<1, dim> &up,
              const std::vector<std::string> &parts)
  {
    return std::find(parts.begin(),
                     parts.end(),
                     part_of_excavation(inward * up)) != parts.end();
  }
} // namespace Keyblock

#endif
