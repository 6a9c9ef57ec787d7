// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_scene_plane_faces_h
#define keyblock_scene_plane_faces_h

#include <keyblock/scene/solid.h>

#include <vector>

namespace Keyblock
{
  /** A plane face of a surface of triangles: closed lines of vertices, the
   * outer one first; none if they touch each other. */
  struct PlaneFace
  {
    std::vector<std::vector<unsigned int>> loops;
    std::vector<TriangleSurface::Triangle> triangles; ///< that it is made of
  };

  /** The faces of a surface whose triangles turn alike, closed or open:
   * triangles that lie in one plane and share edges are one, the largest of
   * them first, and vertices within straight edges are left out. */
  std::vector<PlaneFace> list_faces(const TriangleSurface &surface);
} // namespace Keyblock

#endif
