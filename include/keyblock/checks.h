// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_checks_h
#define keyblock_checks_h

#include <keyblock/output.h>

namespace Keyblock
{
  /** What a closed form is computed from. */
  template <int dim>
  struct CheckInput
  {
    const Scene<dim> &scene;
    const Blocks<dim> &blocks;
    const History &history;

    /** Index into blocks of the block each monitor watches, or `none`. */
    const std::vector<unsigned int> &block_of_monitor;

    /** Energies at the end of each stage. */
    const std::vector<StageReport> &stages;
  };

  /**
   * Compare the last stage with the closed form that `Check/Closed form`
   * names: values NAME, NAME_reference and NAME_relative_error, references
   * computed from the scene's own entries and blocks. Rank 0 only.
   */
  template <int dim>
  CheckValues evaluate_checks(const CheckInput<dim> &input);
} // namespace Keyblock

#endif
