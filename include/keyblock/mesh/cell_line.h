// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_mesh_cell_line_h
#define keyblock_mesh_cell_line_h

#include <keyblock/mesh/cell_locator.h>
#include <keyblock/mesh/cell_piece.h>

namespace Keyblock
{
  /**
   * The line from @p a to @p b as pieces in one cell each, or in none, from end
   * to end. It is cut where it goes through faces of cells, which are bilinear
   * in 3D. Pieces shorter than @p shortest [m] are not told from the ones
   * before them; of several cells around a piece, as along a face, one of the
   * same part as the piece before is taken.
   * @param part_of_cell of each cell of @p mesh
   */
  template <int dim>
  std::vector<CellPiece>
  cut_by_cells(const Mesh<dim> &mesh,
               const CellLocator<dim> &cells,
               const Point<dim> &a,
               const Point<dim> &b,
               const double shortest,
               const std::vector<unsigned int> &part_of_cell);
} // namespace Keyblock

#endif
