// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_run_ramp_length_h
#define keyblock_run_ramp_length_h

#include <keyblock/run/model.h>

namespace Keyblock
{
  /**
   * Duration of a ramp that the scene leaves open: four periods of the lowest
   * mode of what is held [s]. Blocks that touch nothing any more, or hang on
   * bolts alone, count as held. Where no mode is found, as of parts that an
   * edge alone ties, the period is that of waves that cross as many cells as a
   * cube of all cells has along its side, four times (collective).
   */
  template <int dim>
  double find_ramp_duration(const Model<dim> &model);
} // namespace Keyblock

#endif
