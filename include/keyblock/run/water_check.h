// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_run_water_check_h
#define keyblock_run_water_check_h

#include <keyblock/blocks/interface.h>
#include <keyblock/scene/scene.h>

#include <string>
#include <vector>

namespace Keyblock
{
  /** Throw InputError if a formula of water has no finite value somewhere on
   * its joint, in any stage. */
  template <int dim>
  void check_water(const Scene<dim> &scene, const SplitMesh<dim> &split);

  /** Levels of water, as numbers, below all joints that they are for, a
   * sentence each. */
  template <int dim>
  std::vector<std::string> warnings_of_low_water(const Scene<dim> &scene,
                                                 const SplitMesh<dim> &split);
} // namespace Keyblock

#endif
