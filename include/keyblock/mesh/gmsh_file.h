// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_mesh_gmsh_file_h
#define keyblock_mesh_gmsh_file_h

#include <keyblock/base/child_process.h>
#include <keyblock/mesh/cut.h>

namespace Keyblock
{
  /**
   * The cells and faces of a file in one of Gmsh's formats, as
   * read_gmsh_model() gives them.
   *
   * Gmsh reads it in a child process, because a damaged file can make it stop
   * or write where it must not; the child sends back lists only, and this
   * process checks them. Throws std::runtime_error with Gmsh's complaint, or
   * with how the child ended. The child takes no part in MPI.
   */
  template <int dim>
  MixedMesh read_gmsh_file(const std::string &path);

  /** Send what Gmsh has made or read to the process that asked for it. */
  void write_mixed_mesh(const PipeEnd &pipe, const MixedMesh &mixed);

  /** Receive it, and check that its elements have the vertices they name. */
  MixedMesh read_mixed_mesh(const PipeEnd &pipe);
} // namespace Keyblock

#endif
