// SPDX-License-Identifier: LGPL-2.1-or-later
// Gmsh's cells and marked faces on their way to triangles or tetrahedra and
// back.
#include <keyblock/mesh/marked_mesh.h>
#include <keyblock/scene/joint_extent.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace Keyblock
{
  template <int dim>
  SimplexMesh<dim>
  make_simplex_mesh(const MarkedMesh<dim> &marked, const MeshSize<dim> &size)
  {
    SimplexMesh<dim> mesh;
    mesh.surfaces = marked.surfaces;
    for (const Point<3> &vertex : marked.mixed.vertices)
      {
        const Point<dim> p = in_model<dim>(vertex);
        mesh.add_vertex(p, simplex_coarsening<dim> * size(p));
      }
    for (const unsigned int corner : marked.corners)
      mesh.is_fixed[corner] = true;
    for (const MixedMesh::Element &element : marked.mixed.cells)
      {
        typename SimplexMesh<dim>::CellVertices cell;
        std::copy(element.vertices.begin(),
                  element.vertices.end(),
                  cell.begin());
        if (mesh.volume(cell) < 0.)
          std::swap(cell[0], cell[1]);
        mesh.add_cell(cell);
      }
    for (const MixedMesh::Element &face : marked.mixed.marked_faces)
      {
        typename SimplexMesh<dim>::Facet facet;
        std::copy(face.vertices.begin(), face.vertices.end(), facet.begin());
        bool is_odd;
        facet = mesh.sorted(facet, is_odd);
        mesh.add_mark(facet, {face.id, !is_odd});
      }
    return mesh;
  }



  template <int dim>
  MarkedMesh<dim>
  to_marked_mesh(const SimplexMesh<dim> &mesh)
  {
    MarkedMesh<dim> result;
    result.surfaces = mesh.surfaces;
    std::vector<unsigned int> number(mesh.vertices.size(), no_index);
    for (const auto &cell : mesh.cells)
      if (cell.is_alive)
        {
          MixedMesh::Element element{{}, 0};
          for (const unsigned int v : cell.vertices)
            {
              if (number[v] == no_index)
                {
                  number[v] = result.mixed.vertices.size();
                  Point<3> p;
                  for (unsigned int d = 0; d < dim; ++d)
                    p[d] = mesh.vertices[v][d];
                  result.mixed.vertices.push_back(p);
                }
              element.vertices.push_back(number[v]);
            }
          result.mixed.cells.push_back(element);
        }
    for (const auto &facet : mesh.marked_facets())
      for (const auto &mark : mesh.marks.at(facet))
        {
          MixedMesh::Element face{{}, mark.surface};
          for (const unsigned int v : facet)
            face.vertices.push_back(number[v]);
          if (!mark.plus_is_positive)
            std::swap(face.vertices[0], face.vertices[1]);
          result.mixed.marked_faces.push_back(face);
        }
    return result;
  }



  template <int dim>
  void
  list_merged_joints(const MarkedMesh<dim> &marked,
                     const Scene<dim> &scene,
                     MeshReport<dim> &report)
  {
    std::map<std::vector<unsigned int>, std::vector<unsigned int>> on_face;
    for (const MixedMesh::Element &face : marked.mixed.marked_faces)
      if (marked.surfaces[face.id].is_joint())
        {
          std::vector<unsigned int> key = face.vertices;
          std::sort(key.begin(), key.end());
          on_face[key].push_back(face.id);
        }
    std::map<std::pair<unsigned int, unsigned int>, double> shared;
    std::vector<double> area_of(scene.joints.size(), 0.);
    for (auto &[vertices, surfaces] : on_face)
      {
        const auto joint_of = [&marked](const unsigned int s) {
          return marked.surfaces[s].joint;
        };
        std::sort(surfaces.begin(),
                  surfaces.end(),
                  [&](const unsigned int s, const unsigned int t) {
                    return rules(scene, joint_of(s), joint_of(t));
                  });
        const Point<3> &a = marked.mixed.vertices[vertices[0]],
                       &b = marked.mixed.vertices[vertices[1]],
                       &c = marked.mixed.vertices[vertices.back()];
        const double area = dim == 2
                              ? a.distance(b)
                              : 0.5 * cross_product_3d(b - a, c - a).norm();
        for (const unsigned int s : surfaces)
          area_of[joint_of(s)] += area;
        if (surfaces.size() < 2)
          continue;
        Tensor<1, dim> sum;
        for (const unsigned int v : vertices)
          sum += in_model<dim>(marked.mixed.vertices[v]);
        const Point<dim> center(sum / double(vertices.size()));
        double low = 1e300, high = -1e300;
        for (const unsigned int s : surfaces)
          {
            if (s != surfaces.front())
              shared[{joint_of(surfaces.front()), joint_of(s)}] += area;
            const double place =
              marked.surfaces[s].distance(center) *
              (marked.surfaces[s].normal *
                     marked.surfaces[surfaces.front()].normal <
                   0.
                 ? -1.
                 : 1.);
            low  = std::min(low, place);
            high = std::max(high, place);
          }
        report.lost_rock.push_back({center, high - low});
      }
    for (const auto &[pair, area] : shared)
      report.merged.push_back({pair.first,
                               pair.second,
                               area,
                               area > (1. - 1e-9) * area_of[pair.second]});
  }



  template <int dim>
  void
  bend_outlines(Mesh<dim> &mesh)
  {
    constexpr double least_jacobian = 0.05;
    std::map<unsigned int, Point<dim>> straight;
    for (const auto &face : mesh.marked_faces)
      if (mesh.surfaces[face.surface].radius > 0.)
        for (const unsigned int v : face.vertices)
          {
            const Surface<dim> &circle = mesh.surfaces[face.surface];
            const double distance      = circle.distance(mesh.vertices[v]);
            if (std::abs(distance) < 1e-12 * circle.radius)
              continue;
            straight[v] = mesh.vertices[v];
            mesh.vertices[v] -= distance * circle.normal_at(mesh.vertices[v]);
          }
    bool has_changed = !straight.empty();
    while (has_changed)
      {
        has_changed = false;
        for (unsigned int c = 0; c < mesh.n_cells(); ++c)
          for (const unsigned int v : mesh.cells[c])
            {
              const auto entry = straight.find(v);
              if (entry != straight.end() &&
                  mesh.scaled_jacobian(c) < least_jacobian)
                {
                  mesh.vertices[v] = entry->second;
                  straight.erase(entry);
                  has_changed = true;
                }
            }
      }
  }

  template SimplexMesh<2> make_simplex_mesh(const MarkedMesh<2> &,
                                            const MeshSize<2> &);
  template MarkedMesh<2> to_marked_mesh(const SimplexMesh<2> &);
  template void
  list_merged_joints(const MarkedMesh<2> &, const Scene<2> &, MeshReport<2> &);
  template void bend_outlines(Mesh<2> &);
  template SimplexMesh<3> make_simplex_mesh(const MarkedMesh<3> &,
                                            const MeshSize<3> &);
  template MarkedMesh<3> to_marked_mesh(const SimplexMesh<3> &);
  template void
  list_merged_joints(const MarkedMesh<3> &, const Scene<3> &, MeshReport<3> &);
  template void bend_outlines(Mesh<3> &);
} // namespace Keyblock
