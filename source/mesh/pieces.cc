// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/mesh/pieces.h>

#include <cmath>

namespace Keyblock
{
  namespace
  {
    /** Volume of a regular cell of unit edge [-]. */
    template <int dim>
    constexpr double unit_volume = (dim == 2) ? 0.433 : 0.1179;
  } // namespace



  template <int dim>
  Pieces<dim>::Pieces(const SimplexMesh<dim> &mesh)
    : of_cell(mesh.cells.size(), no_index)
  {
    for (unsigned int seed = 0; seed < mesh.cells.size(); ++seed)
      if (mesh.cells[seed].is_alive && of_cell[seed] == no_index)
        fill(mesh, seed);
  }



  template <int dim>
  void
  Pieces<dim>::fill(const SimplexMesh<dim> &mesh, const unsigned int seed)
  {
    const unsigned int piece = volume.size();
    double total = 0., size = 0.;
    unsigned int n_cells = 0;
    Tensor<1, dim> moment;
    std::vector<unsigned int> open = {seed};
    of_cell[seed]                  = piece;
    while (!open.empty())
      {
        const unsigned int c = open.back();
        open.pop_back();
        const auto &cell  = mesh.cells[c].vertices;
        const double part = mesh.volume(cell);
        total += part;
        size += mesh.size_at(cell);
        ++n_cells;
        for (const unsigned int v : cell)
          moment += part / (dim + 1) * mesh.vertices[v];
        for (unsigned int i = 0; i <= dim; ++i)
          if (mesh.marks.count(mesh.facet(c, i)) == 0)
            {
              const unsigned int other = mesh.neighbor(c, i);
              if (other != no_index && of_cell[other] == no_index)
                {
                  of_cell[other] = piece;
                  open.push_back(other);
                }
            }
      }
    volume.push_back(total);
    wanted_volume.push_back(unit_volume<dim> * std::pow(size / n_cells, dim));
    center.push_back(Point<dim>(moment / total));
  }

  template struct Pieces<2>;
  template struct Pieces<3>;
} // namespace Keyblock
