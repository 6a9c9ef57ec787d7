// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_mesh_polyhedron_h
#define keyblock_mesh_polyhedron_h

#include <keyblock/scene/solid.h>

namespace Keyblock
{
  /** Add a polyhedron to Gmsh's current model with OpenCASCADE; returns the tag
   * of its volume. Throws what Gmsh throws. */
  int add_polyhedron(const TriangleSurface &surface);
} // namespace Keyblock

#endif
