// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_blocks_liner_layout_h
#define keyblock_blocks_liner_layout_h

#include <keyblock/blocks/ground.h>

namespace Keyblock
{
  /** Faces of @p ground that are free and beside one of the excavations of
   * @p names, on outer boundaries not. */
  template <int dim>
  std::vector<CellFace>
  list_excavation_faces(const Ground<dim> &ground,
                        const std::vector<std::string> &names);

  /**
   * The shotcrete of the scene as it is sprayed on the faces that are there
   * after its stage has excavated: what it weighs on each vertex, the traces of
   * joints that it covers, and its faces if it is structural. Throws InputError
   * if there is no face, or if cells of two sizes meet under one that bends.
   */
  template <int dim>
  std::vector<LaidLiner<dim>> lay_out_liners(const Scene<dim> &scene,
                                             const SplitMesh<dim> &split);
} // namespace Keyblock

#endif
