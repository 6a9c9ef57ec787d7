// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_mesh_gmsh_process_h
#define keyblock_mesh_gmsh_process_h

#include <string>

namespace Keyblock
{
  /** Mesh the current model of Gmsh up to entities of @p dimension; returns
   * Gmsh's first error, empty if there was none. */
  std::string mesh_entities(const int dimension);

  /** The same in a process of its own: Gmsh may crash over volumes between
   * thin triangles, which is an error like others then. */
  std::string mesh_entities_apart(const int dimension);
} // namespace Keyblock

#endif
