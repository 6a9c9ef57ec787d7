// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_blocks_lined_faces_h
#define keyblock_blocks_lined_faces_h

#include <keyblock/blocks/ground.h>

namespace Keyblock
{
  /** What was one vertex before the split, by vertex; `none` where there is
   * no pair. */
  template <int dim>
  std::vector<unsigned int> groups_of_vertices(const SplitMesh<dim> &split);

  /**
   * The structural liner @p liner (index into Scene::liners) on @p faces:
   * turned into the opening, with points at what was one vertex before the
   * split, and where it meets outer boundaries that supports hold along their
   * normals. Throws InputError in 3D if cells of two sizes meet on the faces.
   */
  template <int dim>
  std::vector<LinedFace<dim>> lay_out_faces(const Scene<dim> &scene,
                                            const SplitMesh<dim> &split,
                                            const unsigned int liner,
                                            const std::vector<CellFace> &faces);
} // namespace Keyblock

#endif
