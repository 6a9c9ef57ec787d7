// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/blocks/face_quadrature.h>
#include <keyblock/blocks/nodal_areas.h>

namespace Keyblock
{
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
        for (const auto &point :
             gauss_points<dim>(face_corners(mesh, cell, face)))
          for (unsigned int v = 0; v < areas.size(); ++v)
            areas[v] += point.shape[v] * point.area.norm();
      }
    return areas;
  }



  template <int dim>
  Point<dim>
  area_center(const Mesh<dim> &mesh,
              const unsigned int cell,
              const unsigned int face)
  {
    const auto areas    = nodal_areas(mesh, cell, face);
    const auto vertices = mesh.face_vertices(cell, face);
    // from a corner on: far from the origin, sums would round
    const Point<dim> &corner = mesh.vertices[vertices[0]];
    Tensor<1, dim> moment;
    double sum = 0.;
    for (unsigned int v = 0; v < vertices.size(); ++v)
      {
        moment += areas[v] * (mesh.vertices[vertices[v]] - corner);
        sum += areas[v];
      }
    return corner + moment / sum;
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
        auto points = gauss_points<dim>(face_corners(mesh, cell, face));
        turn_outward(points, outward);
        for (const auto &point : points)
          for (unsigned int v = 0; v < areas.size(); ++v)
            areas[v] += point.shape[v] * point.area;
      }
    return areas;
  }

#define INSTANTIATE(dim)                                                       \
  template std::array<double, Mesh<dim>::n_face_vertices> nodal_areas(         \
    const Mesh<dim> &, const unsigned int, const unsigned int);                \
  template Point<dim> area_center(const Mesh<dim> &,                           \
                                  const unsigned int,                          \
                                  const unsigned int);                         \
  template std::array<Tensor<1, dim>, Mesh<dim>::n_face_vertices>              \
  nodal_area_vectors(const Mesh<dim> &,                                        \
                     const unsigned int,                                       \
                     const unsigned int);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock
