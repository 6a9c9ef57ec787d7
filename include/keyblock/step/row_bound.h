// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_step_row_bound_h
#define keyblock_step_row_bound_h

#include <keyblock/rock/dofs.h>
#include <keyblock/step/force_element.h>

#include <algorithm>

namespace Keyblock
{
  /** Bound by the sums of the rows of a stiffness, of absolute values, one for
   * each owned node [N/m] (Gershgorin's circles; collective). */
  template <int dim>
  StepBound
  bound_of_rows(const std::vector<double> &row,
                const std::vector<double> &inverse_mass,
                const Numbering<dim> &numbering)
  {
    StepBound bound;
    for (unsigned int node = 0; node < row.size(); ++node)
      bound.squared_frequency =
        std::max(bound.squared_frequency, row[node] * inverse_mass[node]);
    bound.squared_frequency =
      numbering.communicator.max(bound.squared_frequency);
    return bound;
  }
} // namespace Keyblock

#endif
