// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_mesh_place_digits_h
#define keyblock_mesh_place_digits_h

#include <keyblock/base/box.h>
#include <keyblock/mesh/mesh.h>

#include <cmath>

namespace Keyblock
{
  /** Significant digits that tell places of the mesh apart as @p digits do
   * where it lies about the origin: more, if it is far away, as in the
   * coordinates of a survey. */
  template <int dim>
  int
  digits_of_place(const Mesh<dim> &mesh, const int digits)
  {
    const BoundingBox<dim> box(mesh.vertices);
    const double farthest = farthest_coordinate(box),
                 extent   = longest_side(box);
    return extent > 0. && farthest > extent
             ? digits +
                 static_cast<int>(std::ceil(std::log10(farthest / extent)))
             : digits;
  }
} // namespace Keyblock

#endif
