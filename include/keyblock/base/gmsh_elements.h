// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_base_gmsh_elements_h
#define keyblock_base_gmsh_elements_h

#include <cstddef>
#include <vector>

namespace Keyblock
{
  /** Tags of the corner nodes of each element on an entity of Gmsh's current
   * model, without the nodes in between that elements of higher order have.
   * Throws what Gmsh throws. */
  std::vector<std::vector<std::size_t>> corners_of_elements(const int dimension,
                                                            const int entity);
} // namespace Keyblock

#endif
