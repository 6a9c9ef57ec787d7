// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_mesh_polyhedron_h
#define keyblock_mesh_polyhedron_h

#include <keyblock/scene/solid.h>

#include <vector>

namespace Keyblock
{
  /** A plane face of a polyhedron: closed lines of vertices, the outer one
   * first. */
  struct PolyhedronFace
  {
    std::vector<std::vector<unsigned int>> loops;
    std::vector<TriangleSurface::Triangle> triangles; ///< that it is made of
  };

  /** The faces of an oriented surface: triangles that lie in one plane and
   * share edges are one, and vertices within straight edges are left out. */
  std::vector<PolyhedronFace> list_faces(const TriangleSurface &surface);

  /** Add a polyhedron to Gmsh's current model with OpenCASCADE; returns the tag
   * of its volume. Throws what Gmsh throws. */
  int add_polyhedron(const TriangleSurface &surface);
} // namespace Keyblock

#endif
