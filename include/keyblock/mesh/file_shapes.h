// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_mesh_file_shapes_h
#define keyblock_mesh_file_shapes_h

#include <keyblock/scene/scene.h>

#include <ostream>
#include <string>
#include <vector>

namespace Keyblock
{
  /** Size and volume of each excavation from a file, a line each. */
  template <int dim>
  void print_file_shapes(std::ostream &out, const Scene<dim> &scene);

  /** Excavations from files that are smaller than a cell is wanted there, as
   * sentences. */
  template <int dim>
  std::vector<std::string> warnings_of_file_shapes(const Scene<dim> &scene);
} // namespace Keyblock

#endif
