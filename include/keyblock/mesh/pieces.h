// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_mesh_pieces_h
#define keyblock_mesh_pieces_h

#include <keyblock/mesh/simplex_mesh.h>

#include <vector>

namespace Keyblock
{
  /** Pieces of a simplex mesh between its marked facets: those of joints and
   * of the outlines of excavations. */
  template <int dim>
  struct Pieces
  {
    std::vector<unsigned int> of_cell; ///< no_index: of cells not alive

    // by piece
    std::vector<double> volume;        ///< [m^dim]
    std::vector<double> wanted_volume; ///< of a cell of the wanted size [m^dim]
    std::vector<Point<dim>> center;

    explicit Pieces(const SimplexMesh<dim> &mesh);

  private:
    /** The piece of the cell @p seed. */
    void fill(const SimplexMesh<dim> &mesh, const unsigned int seed);
  };
} // namespace Keyblock

#endif
