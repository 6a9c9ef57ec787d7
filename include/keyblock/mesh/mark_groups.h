// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_mesh_mark_groups_h
#define keyblock_mesh_mark_groups_h

#include <keyblock/mesh/cut.h>

#include <string>
#include <vector>

namespace Keyblock
{
  /**
   * Mark the faces of @p mixed that are of a physical group which is a joint of
   * the scene; returns the planes that the marks name. Throws InputError for a
   * face that is none of a cell. @p origin: begin of the sentence
   */
  template <int dim>
  std::vector<Surface<dim>> mark_groups(MixedMesh &mixed,
                                        const Scene<dim> &scene,
                                        const std::string &origin);
} // namespace Keyblock

#endif
