// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_blocks_nodal_areas_h
#define keyblock_blocks_nodal_areas_h

#include <keyblock/mesh/mesh.h>

#include <array>

namespace Keyblock
{
  /** Integral of each vertex's shape function over a face, in the order of
   * Mesh::face_vertices() [m^(dim-1)]. */
  template <int dim>
  std::array<double, Mesh<dim>::n_face_vertices>
  nodal_areas(const Mesh<dim> &mesh,
              const unsigned int cell,
              const unsigned int face);

  /** The centroid of a face's area. */
  template <int dim>
  Point<dim> area_center(const Mesh<dim> &mesh,
                         const unsigned int cell,
                         const unsigned int face);

  /** The same of the shape function times the outward normal, exact: they sum
   * up to Mesh::face_area_vector() [m^(dim-1)]. */
  template <int dim>
  std::array<Tensor<1, dim>, Mesh<dim>::n_face_vertices>
  nodal_area_vectors(const Mesh<dim> &mesh,
                     const unsigned int cell,
                     const unsigned int face);
} // namespace Keyblock

#endif
