// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_run_circle_warnings_h
#define keyblock_run_circle_warnings_h

#include <keyblock/mesh/mesh.h>
#include <keyblock/scene/scene.h>

#include <string>
#include <vector>

namespace Keyblock
{
  /** Circles in 2D, each in the model as a whole and by itself, whose area in
   * the mesh is more than a hundredth off. */
  template <int dim>
  std::vector<std::string> warnings_of_circles(const Scene<dim> &scene,
                                               const Mesh<dim> &mesh);
} // namespace Keyblock

#endif
