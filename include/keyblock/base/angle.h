// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_base_angle_h
#define keyblock_base_angle_h

#include <deal.II/base/numbers.h>

#include <cmath>

namespace Keyblock
{
  /** Tangent of an angle in degrees [-]. */
  inline double
  tangent_of(const double degrees)
  {
    return std::tan(degrees * dealii::numbers::PI / 180.);
  }
} // namespace Keyblock

#endif
