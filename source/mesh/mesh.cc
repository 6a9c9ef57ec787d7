// SPDX-License-Identifier: LGPL-2.1-or-later
// Geometry, neighbours and quality of a mesh.
#include <keyblock/mesh/mesh.h>
#include <keyblock/scene/boundary_names.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace Keyblock
{
  bool
  means_group(const std::string &words,
              const unsigned int id,
              const GroupNames &names)
  {
    if (words.rfind("id ", 0) != 0)
      return false;
    const std::string word = words.substr(3);
    const auto named       = names.find(id);
    return word == std::to_string(id) ||
           (named != names.end() && word == named->second);
  }



  template <int dim>
  const std::vector<std::string> &
  Mesh<dim>::boundary_names()
  {
    return Keyblock::boundary_names<dim>();
  }



  template <int dim>
  typename Mesh<dim>::FaceVertices
  Mesh<dim>::face_vertices(const unsigned int cell,
                           const unsigned int face) const
  {
    static const auto vertices_of_face = [] {
      std::array<FaceVertices, n_cell_faces> list;
      for (unsigned int f = 0; f < n_cell_faces; ++f)
        for (unsigned int v = 0; v < n_face_vertices; ++v)
          list[f][v] = GeometryInfo<dim>::face_to_cell_vertices(f, v);
      return list;
    }();
    FaceVertices result;
    for (unsigned int v = 0; v < n_face_vertices; ++v)
      result[v] = cells[cell][vertices_of_face[face][v]];
    return result;
  }



  template <int dim>
  Point<dim>
  Mesh<dim>::cell_center(const unsigned int cell) const
  {
    Point<dim> center;
    for (const unsigned int v : cells[cell])
      center += vertices[v] / double(n_cell_vertices);
    return center;
  }



  template <int dim>
  Point<dim>
  Mesh<dim>::face_center(const unsigned int cell, const unsigned int face) const
  {
    Point<dim> center;
    for (const unsigned int v : face_vertices(cell, face))
      center += vertices[v] / double(n_face_vertices);
    return center;
  }



  template <int dim>
  Tensor<1, dim>
  Mesh<dim>::face_area_vector(const unsigned int cell,
                              const unsigned int face) const
  {
    const FaceVertices f = face_vertices(cell, face);
    Tensor<1, dim> area;
    if constexpr (dim == 2)
      area = cross_product_2d(vertices[f[1]] - vertices[f[0]]);
    else
      area = 0.5 * cross_product_3d(vertices[f[3]] - vertices[f[0]],
                                    vertices[f[2]] - vertices[f[1]]);
    return (area * (face_center(cell, face) - cell_center(cell)) > 0.) ? area
                                                                       : -area;
  }



  template <int dim>
  double
  Mesh<dim>::cell_volume(const unsigned int cell) const
  {
    // divergence theorem over the bilinear faces; exact
    const Point<dim> center = cell_center(cell);
    double volume           = 0.;
    for (unsigned int face = 0; face < n_cell_faces; ++face)
      {
        if constexpr (dim == 2)
          volume += face_area_vector(cell, face) *
                    (face_center(cell, face) - center) / dim;
        else
          {
            const FaceVertices f = face_vertices(cell, face);
            const double sign    = (face % 2 == 0) ? -1. : 1.;
            const double g       = 0.5 / std::sqrt(3.);
            for (const double s : {0.5 - g, 0.5 + g})
              for (const double t : {0.5 - g, 0.5 + g})
                {
                  const Tensor<1, dim> a =
                    (1. - t) * (vertices[f[1]] - vertices[f[0]]) +
                    t * (vertices[f[3]] - vertices[f[2]]);
                  const Tensor<1, dim> b =
                    (1. - s) * (vertices[f[2]] - vertices[f[0]]) +
                    s * (vertices[f[3]] - vertices[f[1]]);
                  const Tensor<1, dim> x =
                    (1. - s) * (1. - t) * (vertices[f[0]] - center) +
                    s * (1. - t) * (vertices[f[1]] - center) +
                    (1. - s) * t * (vertices[f[2]] - center) +
                    s * t * (vertices[f[3]] - center);
                  volume += sign * 0.25 * (x * cross_product_3d(a, b)) / dim;
                }
          }
      }
    return volume;
  }



  template <int dim>
  double
  Mesh<dim>::scaled_jacobian(const unsigned int cell) const
  {
    double minimum = 1.;
    for (unsigned int v = 0; v < n_cell_vertices; ++v)
      {
        Tensor<2, dim> edges;
        double lengths = 1.;
        for (unsigned int d = 0; d < dim; ++d)
          {
            const unsigned int low = v & ~(1u << d), high = v | (1u << d);
            edges[d] = vertices[cells[cell][high]] - vertices[cells[cell][low]];
            lengths *= edges[d].norm();
          }
        minimum = std::min(minimum, determinant(edges) / lengths);
      }
    return minimum;
  }



  template <int dim>
  bool
  Mesh<dim>::is_on(const unsigned int cell,
                   const unsigned int face,
                   const std::string &name) const
  {
    if (neighbor[cell][face] != none)
      return false;
    if (name == "all")
      return boundary[cell][face] != none || boundary_id[cell][face] != none;
    const unsigned int b = boundary[cell][face];
    if (b != none && boundary_names()[b] == name)
      return true;
    const unsigned int id = boundary_id[cell][face];
    return id != none && means_group(name, id, boundary_id_names);
  }



  template <int dim>
  void
  find_neighbors(Mesh<dim> &mesh)
  {
    struct Face
    {
      typename Mesh<dim>::FaceVertices key;
      unsigned int cell, face;
    };
    std::vector<Face> faces;
    faces.reserve(mesh.n_cells() * Mesh<dim>::n_cell_faces);
    std::array<unsigned int, Mesh<dim>::n_cell_faces> no_face;
    no_face.fill(none);
    mesh.neighbor.assign(mesh.n_cells(), no_face);
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      for (unsigned int f = 0; f < Mesh<dim>::n_cell_faces; ++f)
        {
          Face face{mesh.face_vertices(c, f), c, f};
          std::sort(face.key.begin(), face.key.end());
          faces.push_back(face);
        }
    std::sort(faces.begin(), faces.end(), [](const Face &a, const Face &b) {
      return std::tie(a.key, a.cell, a.face) < std::tie(b.key, b.cell, b.face);
    });
    for (unsigned int i = 0; i + 1 < faces.size(); ++i)
      if (faces[i].key == faces[i + 1].key)
        {
          const Face &a                 = faces[i];
          const Face &b                 = faces[i + 1];
          mesh.neighbor[a.cell][a.face] = b.cell;
          mesh.neighbor[b.cell][b.face] = a.cell;
        }
    for (const auto &hanging : mesh.hanging_faces)
      {
        mesh.neighbor[hanging.coarse_cell][hanging.coarse_face] =
          hanging.fine_cell;
        mesh.neighbor[hanging.fine_cell][hanging.fine_face] =
          hanging.coarse_cell;
      }
  }



  template <int dim>
  bool
  turn_alike(const typename Mesh<dim>::FaceVertices &a,
             const typename Mesh<dim>::FaceVertices &b)
  {
    if constexpr (dim == 2)
      return a == b;
    else
      {
        const auto next_of = [](const auto &face, const unsigned int vertex) {
          static constexpr unsigned int around[4] = {0, 1, 3, 2};
          unsigned int i                          = 0;
          while (face[around[i]] != vertex)
            ++i;
          return face[around[(i + 1) % 4]];
        };
        return next_of(a, a[0]) == next_of(b, a[0]);
      }
  }



  template <int dim>
  double
  least_over_median_thickness(const Mesh<dim> &mesh)
  {
    std::vector<double> thickness;
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      {
        double largest = 0.;
        for (unsigned int f = 0; f < Mesh<dim>::n_cell_faces; ++f)
          largest = std::max(largest, mesh.face_area_vector(c, f).norm());
        thickness.push_back(mesh.cell_volume(c) / largest);
      }
    const auto middle = thickness.begin() + thickness.size() / 2;
    std::nth_element(thickness.begin(), middle, thickness.end());
    return *std::min_element(thickness.begin(), thickness.end()) / *middle;
  }



  template <int dim>
  MeshQuality
  measure_quality(const Mesh<dim> &mesh)
  {
    MeshQuality quality;
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      {
        const double jacobian = mesh.scaled_jacobian(c);
        if (jacobian < quality.minimum_scaled_jacobian)
          quality = {jacobian, c};
      }
    return quality;
  }

  template struct Mesh<2>;
  template struct Mesh<3>;
  template void find_neighbors(Mesh<2> &);
  template void find_neighbors(Mesh<3> &);
  template bool turn_alike<2>(const Mesh<2>::FaceVertices &,
                              const Mesh<2>::FaceVertices &);
  template bool turn_alike<3>(const Mesh<3>::FaceVertices &,
                              const Mesh<3>::FaceVertices &);
  template double least_over_median_thickness(const Mesh<2> &);
  template double least_over_median_thickness(const Mesh<3> &);
  template MeshQuality measure_quality(const Mesh<2> &);
  template MeshQuality measure_quality(const Mesh<3> &);
} // namespace Keyblock
