// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_mesh_cell_piece_h
#define keyblock_mesh_cell_piece_h

#include <keyblock/mesh/mesh.h>

namespace Keyblock
{
  /** A piece of a line in one cell. */
  struct CellPiece
  {
    double begin = 0., end = 0.; ///< distances from where the line begins [m]
    unsigned int cell = none;    ///< none: it is in no cell
  };
} // namespace Keyblock

#endif
