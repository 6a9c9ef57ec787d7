// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_run_free_field_warnings_h
#define keyblock_run_free_field_warnings_h

#include <keyblock/blocks/interface.h>
#include <keyblock/scene/scene.h>

#include <string>
#include <vector>

namespace Keyblock
{
  /** What the ground beside free fields leaves out in this scene: joints that
   * reach their sides, and that rock yields. */
  template <int dim>
  std::vector<std::string> warnings_of_free_fields(const Scene<dim> &scene,
                                                   const SplitMesh<dim> &split);
} // namespace Keyblock

#endif
