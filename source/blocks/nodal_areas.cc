// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/blocks/nodal_areas.h>

#include <cmath>

namespace Keyblock
{
  namespace
  {
    /** Call @p action(vertex of the face, shape function times weight, normal
     * times the size of the reference face's image) for Gauss's 2 x 2 points
     * of a face in 3D. */
    template <typename Action>
    void
    for_each_gauss_point(const Mesh<3> &mesh,
                         const unsigned int cell,
                         const unsigned int face,
                         const Action &action)
    {
      const auto f   = mesh.face_vertices(cell, face);
      const double g = 0.5 / std::sqrt(3.);
      for (const double s : {0.5 - g, 0.5 + g})
        for (const double t : {0.5 - g, 0.5 + g})
          {
            const Tensor<1, 3> a =
              (1. - t) * (mesh.vertices[f[1]] - mesh.vertices[f[0]]) +
              t * (mesh.vertices[f[3]] - mesh.vertices[f[2]]);
            const Tensor<1, 3> b =
              (1. - s) * (mesh.vertices[f[2]] - mesh.vertices[f[0]]) +
              s * (mesh.vertices[f[3]] - mesh.vertices[f[1]]);
            const Tensor<1, 3> normal = 0.25 * cross_product_3d(a, b);
            for (unsigned int v = 0; v < 4; ++v)
              action(v,
                     ((v & 1) ? s : 1. - s) * ((v & 2) ? t : 1. - t),
                     normal);
          }
    }
  } // namespace



  template <int dim>
  std::array<double, Mesh<dim>::n_face_vertices>
  nodal_areas(const Mesh<dim> &mesh,
              const unsigned int cell,
              const unsigned int face)
  {
    std::array<double, Mesh<dim>::n_face_vertices> areas;
    if constexpr (dim == 2)
      {
        const auto f = mesh.face_vertices(cell, face);
        areas.fill(0.5 * mesh.vertices[f[0]].distance(mesh.vertices[f[1]]));
      }
    else
      {
        areas.fill(0.);
        for_each_gauss_point(mesh,
                             cell,
                             face,
                             [&](const unsigned int v,
                                 const double shape,
                                 const Tensor<1, dim> &normal) {
                               areas[v] += shape * normal.norm();
                             });
      }
    return areas;
  }



  template <int dim>
  std::array<Tensor<1, dim>, Mesh<dim>::n_face_vertices>
  nodal_area_vectors(const Mesh<dim> &mesh,
                     const unsigned int cell,
                     const unsigned int face)
  {
    const Tensor<1, dim> outward = mesh.face_area_vector(cell, face);
    std::array<Tensor<1, dim>, Mesh<dim>::n_face_vertices> areas;
    if constexpr (dim == 2)
      areas.fill(0.5 * outward);
    else
      {
        Tensor<1, dim> sum;
        for_each_gauss_point(mesh,
                             cell,
                             face,
                             [&](const unsigned int v,
                                 const double shape,
                                 const Tensor<1, dim> &normal) {
                               areas[v] += shape * normal;
                               sum += shape * normal;
                             });
        if (sum * outward < 0.)
          for (Tensor<1, dim> &area : areas)
            area *= -1.;
      }
    return areas;
  }

#define INSTANTIATE(dim)                                                       \
  template std::array<double, Mesh<dim>::n_face_vertices> nodal_areas(         \
    const Mesh<dim> &, const unsigned int, const unsigned int);                \
  template std::array<Tensor<1, dim>, Mesh<dim>::n_face_vertices>              \
  nodal_area_vectors(const Mesh<dim> &,                                        \
                     const unsigned int,                                       \
                     const unsigned int);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock
