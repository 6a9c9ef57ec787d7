// SPDX-License-Identifier: LGPL-2.1-or-later
// Gmsh's mesh with what its faces lie on.
#include <gmsh.h>
#include <keyblock/mesh/excavation_region.h>
#include <keyblock/mesh/marked_mesh.h>
#include <keyblock/scene/joint_extent.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace Keyblock
{
  namespace
  {
    using gmsh::vectorpair;

    /** Line, plane or circle through an element of an outline. */
    template <int dim>
    Surface<dim>
    surface_through(const std::vector<Point<dim>> &element,
                    const bool is_circle,
                    const Scene<dim> &scene)
    {
      Surface<dim> surface;
      surface.point = element[0];
      if constexpr (dim == 2)
        {
          surface.normal = cross_product_2d(element[1] - element[0]);
          if (is_circle)
            for (const auto &excavation : scene.excavations)
              if (excavation->shape == ExcavationShape::circle &&
                  std::abs(depth_inside(*excavation, element[0])) +
                      std::abs(depth_inside(*excavation, element[1])) <
                    1e-6 * excavation->radius)
                {
                  surface.point  = excavation->center;
                  surface.radius = excavation->radius;
                }
        }
      else
        surface.normal =
          cross_product_3d(element[1] - element[0], element[2] - element[0]);
      surface.normal /= surface.normal.norm();
      return surface;
    }

    /** Reads Gmsh's current mesh. */
    template <int dim>
    class Reader
    {
    public:
      Reader(const GmshModel<dim> &model, const Scene<dim> &scene)
        : model(model)
        , scene(scene)
      {}

      MarkedMesh<dim>
      read()
      {
        result.mixed = read_gmsh_model<dim>(vertex_of_tag);
        if (!model.joints.empty())
          for (unsigned int j = 0; j < scene.joints.size(); ++j)
            {
              const JointExtent<dim> extent(*scene.joints[j]);
              result.surfaces.push_back({extent.origin, extent.normal, 0., j});
              for (const auto &[dimension, tag] : model.joints[j])
                joints_of_entity[tag].push_back(j);
            }
        vectorpair entities;
        gmsh::model::getEntities(entities, dim - 1);
        for (const auto &[dimension, tag] : entities)
          read_outline(tag);
        list_corners();
        return result;
      }

    private:
      void
      read_outline(const int tag)
      {
        std::vector<int> types;
        std::vector<std::vector<std::size_t>> elements, nodes;
        gmsh::model::mesh::getElements(types, elements, nodes, dim - 1, tag);
        std::string type;
        gmsh::model::getType(dim - 1, tag, type);
        const auto joints   = joints_of_entity.find(tag);
        const bool is_joint = (joints != joints_of_entity.end());
        // (a joint may lie on the face of an excavation)
        const bool is_outline = !is_joint || model.outlines.count(tag) > 0;
        const bool is_curved  = dim == 3 && !is_joint && type != "Plane";
        bool is_new           = is_outline;
        for (unsigned int t = 0; t < types.size(); ++t)
          for (std::size_t i = 0; i + dim <= nodes[t].size(); i += dim)
            {
              MixedMesh::Element face;
              for (unsigned int k = 0; k < dim; ++k)
                {
                  const auto found = vertex_of_tag.find(nodes[t][i + k]);
                  if (found != vertex_of_tag.end())
                    face.vertices.push_back(found->second);
                }
              if (face.vertices.size() != dim)
                continue;
              std::vector<Point<dim>> places;
              for (const unsigned int v : face.vertices)
                places.push_back(in_model<dim>(result.mixed.vertices[v]));
              if (is_new)
                {
                  result.surfaces.push_back(
                    surface_through<dim>(places, type == "Circle", scene));
                  result.surfaces.back().is_curved = is_curved;
                  // each triangle on a curved one has its plane
                  is_new = is_curved;
                }
              if (is_outline)
                mark(face, result.surfaces.size() - 1, places);
              if (is_joint)
                for (const unsigned int j : joints->second)
                  mark(face, j, places);
            }
      }

      /** The plus side is where the surface's normal points to. */
      void
      mark(MixedMesh::Element face,
           const unsigned int surface,
           const std::vector<Point<dim>> &places)
      {
        Tensor<1, dim> left; // or the right-hand normal
        if constexpr (dim == 2)
          left = -cross_product_2d(places[1] - places[0]);
        else
          left = cross_product_3d(places[1] - places[0], places[2] - places[0]);
        if (left * result.surfaces[surface].normal < 0.)
          std::swap(face.vertices[0], face.vertices[1]);
        face.id = surface;
        result.mixed.marked_faces.push_back(face);
      }

      void
      list_corners()
      {
        for (int dimension = 0; dimension < dim - 1; ++dimension)
          {
            vectorpair entities;
            gmsh::model::getEntities(entities, dimension);
            for (const auto &[d, tag] : entities)
              if (d == 0 || bounds_one_surface(tag))
                {
                  std::vector<std::size_t> tags;
                  std::vector<double> coordinates, parameters;
                  gmsh::model::mesh::getNodes(
                    tags, coordinates, parameters, d, tag);
                  for (const std::size_t node : tags)
                    if (vertex_of_tag.count(node) > 0)
                      result.corners.push_back(vertex_of_tag.at(node));
                }
          }
      }

      /** Whether no second surface keeps the nodes of a curve in place. */
      static bool
      bounds_one_surface(const int tag)
      {
        std::vector<int> surfaces, lower;
        gmsh::model::getAdjacencies(1, tag, surfaces, lower);
        return surfaces.size() < 2;
      }

      const GmshModel<dim> &model;
      const Scene<dim> &scene;
      MarkedMesh<dim> result;
      std::unordered_map<std::size_t, unsigned int> vertex_of_tag;
      std::map<int, std::vector<unsigned int>> joints_of_entity;
    };
  } // namespace



  template <int dim>
  MarkedMesh<dim>
  read_marked_mesh(const GmshModel<dim> &model, const Scene<dim> &scene)
  {
    return Reader<dim>(model, scene).read();
  }

  template MarkedMesh<2> read_marked_mesh(const GmshModel<2> &,
                                          const Scene<2> &);
  template MarkedMesh<3> read_marked_mesh(const GmshModel<3> &,
                                          const Scene<3> &);
} // namespace Keyblock
