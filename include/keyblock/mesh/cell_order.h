// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_mesh_cell_order_h
#define keyblock_mesh_cell_order_h

#include <keyblock/mesh/mesh.h>

#include <vector>

namespace Keyblock
{
  /**
   * Order for a loop over the cells @p begin to @p end: front by front, from
   * one side of them to the other, each front in rows. The nodes of two fronts
   * stay in the cache, and nodes numbered in this order are met one after the
   * other. A structured box is swept row by row. Returns cell indices; cells
   * that no front reaches follow in their own order.
   */
  template <int dim>
  std::vector<unsigned int> sweep_order(const Mesh<dim> &mesh,
                                        const unsigned int begin,
                                        const unsigned int end);
} // namespace Keyblock

#endif
