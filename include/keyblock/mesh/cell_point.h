// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_mesh_cell_point_h
#define keyblock_mesh_cell_point_h

#include <keyblock/mesh/mesh.h>

namespace Keyblock
{
  /** A point in a cell, and the shares of the cell's vertices in it. */
  template <int dim>
  struct CellPoint
  {
    unsigned int cell = none; ///< none: it is in no cell
    std::array<double, Mesh<dim>::n_cell_vertices> weight{}; ///< sum 1 [-]
  };
} // namespace Keyblock

#endif
