// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_mesh_size_remedy_h
#define keyblock_mesh_size_remedy_h

#include <keyblock/base/number_text.h>
#include <keyblock/scene/domain.h>

#include <string>

namespace Keyblock
{
  /** What gives smaller cells where they are too large for joints and blocks,
   * or keeps faces on their joints: the end of a sentence, without its full
   * stop. */
  template <int dim>
  std::string
  remedy_of_coarse_cells(const Meshing<dim> &meshing)
  {
    if (meshing.generator == MeshGenerator::structured)
      return "raise 'Mesh/Cells'";
    if (meshing.generator == MeshGenerator::file)
      return "give a mesh with smaller cells in 'Domain/File'";
    const std::string unmoved =
      meshing.snap > 0. ? ", or set 'Mesh/Snap' to 0, which moves no face off "
                          "its joint, for smaller time steps"
                        : "";
    if (meshing.cells_across > 0.)
      return "lower 'Mesh/Least size' (now " +
             (meshing.least_size > 0.
                ? text_of(meshing.least_size) + " m"
                : std::string("a quarter of 'Size at excavation'")) +
             "), or raise 'Mesh/Cells across blocks' (now " +
             text_of(meshing.cells_across) + ")" + unmoved;
    return "lower 'Mesh/Size' or 'Mesh/Size at excavation', or set "
           "'Mesh/Cells across blocks'" +
           unmoved;
  }
} // namespace Keyblock

#endif
