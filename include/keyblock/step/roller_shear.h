// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_step_roller_shear_h
#define keyblock_step_roller_shear_h

#include <keyblock/blocks/interface.h>
#include <keyblock/rock/internal_force.h>

namespace Keyblock
{
  /**
   * A warning for each support with Directions normal (a roller) along whose
   * boundaries the initial stress has shear that neither it nor another support
   * or a traction bears: it leaves the rock before anything is dug.
   * Collective.
   */
  template <int dim>
  std::vector<std::string> warnings_of_rollers(const Communicator &communicator,
                                               const Scene<dim> &scene,
                                               const SplitMesh<dim> &split,
                                               const CellArrays<dim> &cells);
} // namespace Keyblock

#endif
