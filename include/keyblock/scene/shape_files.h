// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_scene_shape_files_h
#define keyblock_scene_shape_files_h

#include <keyblock/scene/scene.h>

#include <string>
#include <vector>

namespace Keyblock
{
  /**
   * Read the files of excavations whose shape is `file` on rank 0 and put what
   * they contain into all ranks' @p scene: solids in 3D, a polygon in the place
   * of the file in 2D. Throws InputError for what cannot be used, also for
   * shapes that are outside of the domain or larger (collective).
   */
  template <int dim>
  void read_shape_files(const Communicator &communicator, Scene<dim> &scene);

  /** Closed surfaces inside others of the same excavation, one sentence each:
   * rock within them would float, and is excavated, too. */
  template <int dim>
  std::vector<std::string> warnings_of_nested_solids(const Scene<dim> &scene);
} // namespace Keyblock

#endif
