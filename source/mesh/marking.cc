// SPDX-License-Identifier: LGPL-2.1-or-later
// From the generators' cells to the mesh of the run: order, outer boundaries,
// and the marks of materials, excavations and joints.
#include <keyblock/mesh/mesh_marks.h>

#include <deal.II/base/utilities.h>

#include <keyblock/base/errors.h>
#include <keyblock/scene/joint_facets.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <sstream>
#include <tuple>

namespace Keyblock
{
  namespace
  {
    template <int dim>
    void
    sort_cells_along_hilbert_curve(Mesh<dim> &mesh)
    {
      std::vector<Point<dim>> centers(mesh.n_cells());
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        centers[c] = mesh.cell_center(c);
      const auto keys =
        dealii::Utilities::inverse_Hilbert_space_filling_curve(centers, 20);
      std::vector<unsigned int> order(mesh.n_cells());
      std::iota(order.begin(), order.end(), 0);
      std::stable_sort(order.begin(),
                       order.end(),
                       [&keys](unsigned int a, unsigned int b) {
                         return keys[a] < keys[b];
                       });
      auto cells  = mesh.cells;
      auto region = mesh.region;
      for (unsigned int c = 0; c < order.size(); ++c)
        {
          mesh.cells[c]  = cells[order[c]];
          mesh.region[c] = region[order[c]];
        }
      std::vector<unsigned int> place(order.size());
      for (unsigned int c = 0; c < order.size(); ++c)
        place[order[c]] = c;
      for (auto &hanging : mesh.hanging_faces)
        {
          hanging.coarse_cell = place[hanging.coarse_cell];
          hanging.fine_cell   = place[hanging.fine_cell];
        }
      std::sort(mesh.hanging_faces.begin(),
                mesh.hanging_faces.end(),
                [](const auto &a, const auto &b) {
                  return std::tie(a.coarse_cell, a.fine_cell) <
                         std::tie(b.coarse_cell, b.fine_cell);
                });
      // vertices in the order in which the cells meet them
      std::vector<unsigned int> rank(mesh.vertices.size(), none);
      std::vector<Point<dim>> vertices;
      for (auto &cell : mesh.cells)
        for (unsigned int &v : cell)
          {
            if (rank[v] == none)
              {
                rank[v] = vertices.size();
                vertices.push_back(mesh.vertices[v]);
              }
            v = rank[v];
          }
      std::vector<typename Mesh<dim>::BoundaryFace> kept;
      for (auto face : mesh.boundary_faces)
        {
          bool is_used = true;
          for (unsigned int &v : face.vertices)
            is_used = is_used && (v = rank[v]) != none;
          if (is_used)
            kept.push_back(face);
        }
      mesh.boundary_faces = kept;
      for (auto &face : mesh.marked_faces)
        for (unsigned int &v : face.vertices)
          v = rank[v];
      mesh.vertices = std::move(vertices);
    }



    /** Refuse scenes whose check is on a joint that is not in the model. */
    template <int dim>
    void
    check_joint_of_check(const Mesh<dim> &mesh, const Scene<dim> &scene)
    {
      for (const unsigned int j : mesh.report.outside)
        AssertThrow(scene.checks.joint.empty() ||
                      scene.joints_called(scene.checks.joint).front() != j,
                    InputError("The entry 'Check/Joint' is '" +
                               scene.checks.joint +
                               "', but that joint is outside the model; check "
                               "'Joints/" +
                               scene.joints[j]->name +
                               "/Point', 'Dip' and 'Extent' against "
                               "'Domain'."));
    }



    /** Note the joints of an exact mesh that have no face in it. */
    template <int dim>
    void
    list_joints_outside(Mesh<dim> &mesh, const Scene<dim> &scene)
    {
      std::vector<bool> is_inside(scene.joints.size(), false);
      for (const auto &face : mesh.marked_faces)
        if (mesh.surfaces[face.surface].is_joint())
          is_inside[mesh.surfaces[face.surface].joint] = true;
      // a bent joint is inside if one of its facets is
      for (const auto &joints : joints_by_surface(scene))
        if (std::none_of(joints.begin(),
                         joints.end(),
                         [&is_inside](const unsigned int j) {
                           return is_inside[j];
                         }))
          mesh.report.outside.insert(mesh.report.outside.end(),
                                     joints.begin(),
                                     joints.end());
    }



    /** Outer faces on edge number i of a polygon, from 1, get `id i`. */
    void
    mark_polygon_edges(Mesh<2> &mesh, const std::vector<Point<2>> &corners)
    {
      for (unsigned int i = 0; i < corners.size(); ++i)
        {
          const Point<2> &a       = corners[i];
          const Tensor<1, 2> edge = corners[(i + 1) % corners.size()] - a;
          for (unsigned int c = 0; c < mesh.n_cells(); ++c)
            for (unsigned int f = 0; f < Mesh<2>::n_cell_faces; ++f)
              {
                bool is_on_edge = mesh.neighbor[c][f] == none;
                for (const unsigned int v : mesh.face_vertices(c, f))
                  {
                    const Tensor<1, 2> way = mesh.vertices[v] - a;
                    const double along     = way * edge / edge.norm_square();
                    is_on_edge =
                      is_on_edge && along > -1e-7 && along < 1. + 1e-7 &&
                      (way - along * edge).norm() < 1e-7 * edge.norm();
                  }
                if (is_on_edge)
                  mesh.boundary_id[c][f] = i + 1;
              }
        }
    }
  } // namespace



  template <int dim>
  void
  mark_boundaries(Mesh<dim> &mesh, const Scene<dim> &scene)
  {
    Point<dim> origin = mesh.vertices[0];
    Tensor<2, dim> frame;
    if (scene.domain.shape == DomainShape::box ||
        scene.domain.shape == DomainShape::parallelepiped)
      {
        origin = scene.domain.corner;
        for (unsigned int d = 0; d < dim; ++d)
          if (scene.domain.shape == DomainShape::box)
            frame[d][d] = scene.domain.size[d];
          else
            frame[d] = scene.domain.edges[d];
      }
    else
      {
        Point<dim> far = origin;
        for (const Point<dim> &p : scene.domain.shape == DomainShape::polygon
                                     ? scene.domain.polygon
                                     : mesh.vertices)
          for (unsigned int d = 0; d < dim; ++d)
            {
              origin[d] = std::min(origin[d], p[d]);
              far[d]    = std::max(far[d], p[d]);
            }
        for (unsigned int d = 0; d < dim; ++d)
          frame[d][d] = far[d] - origin[d];
      }
    const Tensor<2, dim> to_unit = transpose(invert(frame));

    std::array<unsigned int, Mesh<dim>::n_cell_faces> no_face;
    no_face.fill(none);
    mesh.boundary.assign(mesh.n_cells(), no_face);
    mesh.boundary_id.assign(mesh.n_cells(), no_face);
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      for (unsigned int f = 0; f < Mesh<dim>::n_cell_faces; ++f)
        if (mesh.neighbor[c][f] == none)
          for (unsigned int side = 0; side < 2 * dim; ++side)
            {
              bool is_on_side = true;
              for (const unsigned int v : mesh.face_vertices(c, f))
                {
                  const Tensor<1, dim> unit =
                    to_unit * (mesh.vertices[v] - origin);
                  is_on_side =
                    is_on_side && std::abs(unit[side / 2] - side % 2) < 1e-7;
                }
              if (is_on_side)
                mesh.boundary[c][f] = side;
            }

    if constexpr (dim == 2)
      if (scene.domain.shape == DomainShape::polygon)
        mark_polygon_edges(mesh, scene.domain.polygon);
    std::map<typename Mesh<dim>::FaceVertices, unsigned int> ids;
    for (auto face : mesh.boundary_faces)
      {
        std::sort(face.vertices.begin(), face.vertices.end());
        ids[face.vertices] = face.id;
      }
    if (!ids.empty())
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        for (unsigned int f = 0; f < Mesh<dim>::n_cell_faces; ++f)
          if (mesh.neighbor[c][f] == none)
            {
              auto key = mesh.face_vertices(c, f);
              std::sort(key.begin(), key.end());
              const auto found = ids.find(key);
              if (found != ids.end())
                mesh.boundary_id[c][f] = found->second;
            }
  }


  namespace
  {
    void
    broadcast(const Communicator &communicator, GroupNames &names)
    {
      std::string lines;
      for (const auto &[id, name] : names)
        lines += std::to_string(id) + ' ' + name + '\n';
      std::istringstream in(communicator.text_of_root(lines));
      names.clear();
      for (unsigned int id; in >> id;)
        {
          in.ignore();
          std::getline(in, names[id]);
        }
    }
  } // namespace



  template <int dim>
  Mesh<dim>
  make_mesh(const Communicator &communicator,
            const Scene<dim> &scene,
            const dealii::ConditionalOStream &out,
            const std::vector<SizeDemand<dim>> &demands)
  {
    Mesh<dim> mesh;
    communicator.on_root([&]() {
      if (scene.meshing.generator == MeshGenerator::structured)
        mesh = make_structured_mesh(scene);
      else if (scene.meshing.generator == MeshGenerator::gmsh)
        mesh = make_gmsh_mesh(scene, out, demands);
      else
        mesh = read_mesh(scene);
      if (scene.meshing.is_refined())
        refine_mesh(mesh, scene);
      sort_cells_along_hilbert_curve(mesh);
    });
    communicator.broadcast(mesh.vertices);
    communicator.broadcast(mesh.cells);
    communicator.broadcast(mesh.region);
    communicator.broadcast(mesh.boundary_faces);
    broadcast(communicator, mesh.region_names);
    broadcast(communicator, mesh.boundary_id_names);
    communicator.broadcast(mesh.hanging_faces);
    communicator.broadcast(mesh.surfaces);
    communicator.broadcast(mesh.marked_faces);

    find_neighbors(mesh);
    mark_boundaries(mesh, scene);
    check_boundary_groups(mesh, scene);
    mark_materials(mesh, scene);
    mark_excavations(mesh, scene);
    check_rock_is_left(mesh, scene);
    mark_joints(mesh, scene);
    communicator.on_root([&]() {
      if (mesh.report.way == "exact")
        list_joints_outside(mesh, scene);
      check_joint_of_check(mesh, scene);
    });
    return mesh;
  }



  template void mark_boundaries(Mesh<2> &, const Scene<2> &);
  template void mark_boundaries(Mesh<3> &, const Scene<3> &);
  template Mesh<2> make_mesh(const Communicator &,
                             const Scene<2> &,
                             const dealii::ConditionalOStream &,
                             const std::vector<SizeDemand<2>> &);
  template Mesh<3> make_mesh(const Communicator &,
                             const Scene<3> &,
                             const dealii::ConditionalOStream &,
                             const std::vector<SizeDemand<3>> &);
} // namespace Keyblock
