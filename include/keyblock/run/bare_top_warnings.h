// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_run_bare_top_warnings_h
#define keyblock_run_bare_top_warnings_h

#include <keyblock/blocks/blocks.h>
#include <keyblock/scene/scene.h>

#include <string>
#include <vector>

namespace Keyblock
{
  /** Blocks with a free face that are infinite by nothing but the top of the
   * domain, or edges of its polygon, where nothing presses: the surface of
   * the ground, one would say. */
  template <int dim>
  std::vector<std::string> warnings_of_bare_top(const Scene<dim> &scene,
                                                const Mesh<dim> &mesh,
                                                const Blocks<dim> &blocks);
} // namespace Keyblock

#endif
