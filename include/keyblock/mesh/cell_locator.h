// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_mesh_cell_locator_h
#define keyblock_mesh_cell_locator_h

#include <deal.II/numerics/rtree.h>

#include <keyblock/mesh/cell_point.h>

#include <functional>

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

    /** Where @p point is, in the first of several cells. */
    CellPoint<dim> find(const Point<dim> &point) const;

    /** The same of all cells that it is in, ascending. */
    std::vector<CellPoint<dim>> find_all(const Point<dim> &point) const;

    /** Where @p point is in @p cell, or, by what goes on there, just beside it;
     * none of no cell, the nearest vertex where nothing goes on. */
    CellPoint<dim> find_in(const unsigned int cell,
                           const Point<dim> &point) const;

    /** Cells whose boxes the line from @p a to @p b meets. */
    std::vector<unsigned int> list_along(const Point<dim> &a,
                                         const Point<dim> &b) const;

  private:
    using Entry = std::pair<dealii::BoundingBox<dim>, unsigned int>;

    const Mesh<dim> &mesh;
    dealii::RTree<Entry> tree;
  };
} // namespace Keyblock

#endif
