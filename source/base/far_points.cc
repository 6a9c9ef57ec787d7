// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/vtu_file.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Keyblock
{
  namespace
  {
    /** Distance from the origin over the extent, up to which numbers of 32 bits
     * tell places apart to a millionth of the extent [-]. */
    constexpr double most_extents = 16.;
  } // namespace



  bool
  are_far(const std::vector<double> &points)
  {
    double farthest = 0., extent = 0.;
    for (unsigned int d = 0; d < 3; ++d)
      {
        double low = std::numeric_limits<double>::max(), high = -low;
        for (std::size_t i = d; i < points.size(); i += 3)
          {
            low  = std::min(low, points[i]);
            high = std::max(high, points[i]);
          }
        if (low > high)
          return false;
        farthest = std::max({farthest, std::abs(low), std::abs(high)});
        extent   = std::max(extent, high - low);
      }
    return farthest > most_extents * extent;
  }
} // namespace Keyblock
