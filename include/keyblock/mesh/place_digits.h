// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_mesh_place_digits_h
#define keyblock_mesh_place_digits_h

#include <keyblock/mesh/mesh.h>

#include <algorithm>
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
    double farthest = 0., extent = 0.;
    for (unsigned int d = 0; d < dim && !mesh.vertices.empty(); ++d)
      {
        const auto [low, high] =
          std::minmax_element(mesh.vertices.begin(),
                              mesh.vertices.end(),
                              [d](const auto &a, const auto &b) {
                                return a[d] < b[d];
                              });
        farthest =
          std::max({farthest, std::abs((*low)[d]), std::abs((*high)[d])});
        extent = std::max(extent, (*high)[d] - (*low)[d]);
      }
    return extent > 0. && farthest > extent
             ? digits +
                 static_cast<int>(std::ceil(std::log10(farthest / extent)))
             : digits;
  }
} // namespace Keyblock

#endif
