// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_step_initial_tension_h
#define keyblock_step_initial_tension_h

#include <keyblock/blocks/interface.h>
#include <keyblock/rock/internal_force.h>

namespace Keyblock
{
  /**
   * A warning if the initial stress has more tension somewhere than its
   * round-off explains, with the largest principal stress and its place; else
   * empty. Throws InputError if most of the rock is under tension in all
   * directions (in 2D: of the plane), which no rock in the ground is: a sign
   * is wrong then. Collective.
   */
  template <int dim>
  std::string warning_of_tension(const Communicator &communicator,
                                 const Scene<dim> &scene,
                                 const SplitMesh<dim> &split,
                                 const CellArrays<dim> &cells);
} // namespace Keyblock

#endif
