// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_mesh_cell_locator_h
#define keyblock_mesh_cell_locator_h

#include <deal.II/numerics/rtree.h>

#include <keyblock/mesh/mesh.h>

#include <functional>
#include <optional>

namespace Keyblock
{
  /** Finds the cell around a point, by the boxes of cells. */
  template <int dim>
  class CellLocator
  {
  public:
    /** Among the cells of @p mesh for which @p is_there holds. */
    CellLocator(const Mesh<dim> &mesh,
                const std::function<bool(unsigned int)> &is_there);

    /** A cell and the shares of its vertices in a point of it. */
    struct Place
    {
      unsigned int cell;
      std::array<double, Mesh<dim>::n_cell_vertices> weight; ///< sum 1 [-]
    };

    /** The cell that contains @p point, the first of several; nothing if there
     * is none. */
    std::optional<Place> find(const Point<dim> &point) const;

  private:
    using Entry = std::pair<dealii::BoundingBox<dim>, unsigned int>;

    const Mesh<dim> &mesh;
    dealii::RTree<Entry> tree;
  };
} // namespace Keyblock

#endif
