// SPDX-License-Identifier: LGPL-2.1-or-later
// Which faces of cells lie on which joint.
#include <keyblock/mesh/mesh_marks.h>

#include <keyblock/base/errors.h>
#include <keyblock/scene/joint_extent.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace Keyblock
{
  namespace
  {
    /** Mean of the points where the joint's plane cuts the edges of a cell. */
    template <int dim>
    Point<dim>
    cut_center(const Mesh<dim> &mesh,
               const unsigned int cell,
               const std::vector<double> &distance)
    {
      Point<dim> sum;
      unsigned int n = 0;
      for (unsigned int v = 0; v < Mesh<dim>::n_cell_vertices; ++v)
        for (unsigned int d = 0; d < dim; ++d)
          {
            const unsigned int a = mesh.cells[cell][v & ~(1u << d)];
            const unsigned int b = mesh.cells[cell][v | (1u << d)];
            if ((distance[a] < 0.) != (distance[b] < 0.))
              {
                const double s = distance[a] / (distance[a] - distance[b]);
                sum +=
                  mesh.vertices[a] + s * (mesh.vertices[b] - mesh.vertices[a]);
                ++n;
              }
          }
      return sum / n;
    }



    /** Mark joints as the generator knows them: of several on one face the
     * first of the scene. */
    template <int dim>
    void
    mark_known_joints(Mesh<dim> &mesh, const Scene<dim> &scene)
    {
      std::map<typename Mesh<dim>::FaceVertices,
               const typename Mesh<dim>::MarkedFace *>
        known;
      const auto joint_of = [&mesh](const auto &face) {
        return mesh.surfaces[face.surface].joint;
      };
      for (const auto &face : mesh.marked_faces)
        if (joint_of(face) != no_index)
          {
            auto key = face.vertices;
            std::sort(key.begin(), key.end());
            const auto entry = known.emplace(key, &face).first;
            if (rules(scene, joint_of(face), joint_of(*entry->second)))
              entry->second = &face;
          }
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        for (unsigned int f = 0; f < Mesh<dim>::n_cell_faces; ++f)
          {
            const auto vertices = mesh.face_vertices(c, f);
            auto key            = vertices;
            std::sort(key.begin(), key.end());
            const auto found = known.find(key);
            if (found == known.end())
              continue;
            mesh.joint[c][f] = joint_of(*found->second);
            mesh.side[c][f] =
              turn_alike<dim>(vertices, found->second->vertices) ==
                  is_inward<dim>(f)
                ? 1
                : -1;
          }
    }



    /** A joint without a face is left out if it is outside the mesh, and
     * refused if it is not. */
    template <int dim>
    void
    skip_joint(Mesh<dim> &mesh,
               const Scene<dim> &scene,
               const unsigned int index)
    {
      const Joint<dim> &joint = *scene.joints[index];
      const JointExtent<dim> extent(joint);
      std::vector<Point<dim>> places;
      if (!extent.is_infinite())
        places = extent.outermost_points();
      bool is_inside = false;
      for (unsigned int c = 0; c < mesh.n_cells() && !is_inside; ++c)
        {
          const Point<dim> center = mesh.cell_center(c);
          for (const Point<dim> &place : places)
            {
              bool is_near = true;
              for (unsigned int d = 0; d < dim; ++d)
                {
                  double reach = 0.;
                  for (const unsigned int v : mesh.cells[c])
                    reach = std::max(reach,
                                     std::abs(mesh.vertices[v][d] - center[d]));
                  is_near = is_near && std::abs(place[d] - center[d]) < reach;
                }
              is_inside = is_inside || is_near;
            }
        }
      AssertThrow(!is_inside,
                  InputError("The joint '" + joint.name +
                             "' lies between the faces of the cells, so that "
                             "none is on it; set 'Mesh/Generator' to gmsh, or "
                             "move it to cell faces ('Joints/" +
                             joint.name + "/Point', 'Dip' and 'Extent')."));
      mesh.report.outside.push_back(index);
    }



    /** Mark the faces on a joint, of several joints for the one that rules, and
     * add up its area. */
    template <int dim>
    void
    mark_joint(Mesh<dim> &mesh,
               const Scene<dim> &scene,
               const unsigned int index,
               std::vector<double> &area_of)
    {
      const Joint<dim> &joint     = *scene.joints[index];
      const double tolerance      = scene.meshing.joint_tolerance;
      const Tensor<1, dim> normal = joint.normal();
      const Point<dim> origin =
        joint.extent == JointShape::polygon ? joint.vertices[0] : joint.point;
      std::vector<double> distance(mesh.vertices.size());
      for (unsigned int v = 0; v < distance.size(); ++v)
        distance[v] = normal * (mesh.vertices[v] - origin);

      std::map<std::pair<unsigned int, unsigned int>, double> shared;
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        {
          const double size = std::pow(mesh.cell_volume(c), 1. / dim);
          double least = 0., greatest = 0.;
          for (const unsigned int v : mesh.cells[c])
            {
              least    = std::min(least, distance[v]);
              greatest = std::max(greatest, distance[v]);
            }
          if (greatest > tolerance * size && least < -tolerance * size)
            AssertThrow(!joint.is_within_extent(cut_center(mesh, c, distance),
                                                -1e-3 * size),
                        InputError(
                          "The mesh does not follow the joint '" + joint.name +
                          "': a cell crosses it near x = " +
                          std::to_string(mesh.cell_center(c)[0]) +
                          ", y = " + std::to_string(mesh.cell_center(c)[1]) +
                          "; set 'Mesh/Generator' to gmsh, move the joint to "
                          "cell faces, or raise 'Mesh/Joint tolerance'."));
          for (unsigned int f = 0; f < Mesh<dim>::n_cell_faces; ++f)
            {
              bool is_on_plane = true;
              for (const unsigned int v : mesh.face_vertices(c, f))
                is_on_plane =
                  is_on_plane && std::abs(distance[v]) <= tolerance * size;
              if (!is_on_plane ||
                  !joint.is_within_extent(mesh.face_center(c, f), 0.))
                continue;
              // of inner faces each cell sees one half
              const double here = mesh.face_area_vector(c, f).norm() *
                                  (mesh.neighbor[c][f] == none ? 1. : 0.5);
              area_of[index] += here;
              const unsigned int before = mesh.joint[c][f];
              const bool is_ruling =
                before == none || rules(scene, index, before);
              if (before != none)
                shared[is_ruling ? std::make_pair(index, before)
                                 : std::make_pair(before, index)] += here;
              if (!is_ruling)
                continue;
              mesh.joint[c][f] = index;
              mesh.side[c][f] =
                joint.distance(mesh.cell_center(c)) > 0. ? 1 : -1;
            }
        }
      for (const auto &[pair, both] : shared)
        mesh.report.merged.push_back(
          {pair.first,
           pair.second,
           both,
           both > (1. - 1e-9) * area_of[pair.second]});
      if (area_of[index] == 0.)
        skip_joint(mesh, scene, index);
    }
  } // namespace



  template <int dim>
  void
  mark_joints(Mesh<dim> &mesh, const Scene<dim> &scene)
  {
    std::array<unsigned int, Mesh<dim>::n_cell_faces> no_face;
    no_face.fill(none);
    mesh.joint.assign(mesh.n_cells(), no_face);
    std::array<signed char, Mesh<dim>::n_cell_faces> no_side;
    no_side.fill(0);
    mesh.side.assign(mesh.n_cells(), no_side);
    if (scene.meshing.generator == MeshGenerator::gmsh)
      {
        mark_known_joints(mesh, scene);
        return;
      }
    mark_known_joints(mesh, scene); // those of physical groups
    std::vector<double> area_of(scene.joints.size(), 0.); // [m^(dim-1)]
    for (unsigned int j = 0; j < scene.joints.size(); ++j)
      if (scene.joints[j]->form == JointForm::plane)
        mark_joint(mesh, scene, j, area_of);
  }

  template void mark_joints(Mesh<2> &, const Scene<2> &);
  template void mark_joints(Mesh<3> &, const Scene<3> &);
} // namespace Keyblock
