// SPDX-License-Identifier: LGPL-2.1-or-later
// The cells of Gmsh's model.
#include <gmsh.h>
#include <keyblock/base/gmsh_elements.h>
#include <keyblock/mesh/cut.h>

#include <cstddef>
#include <cstdlib>
#include <stdexcept>
#include <unordered_map>

namespace Keyblock
{
  namespace
  {
    /** Elements of the current Gmsh model, their corners being node tags. */
    struct TaggedElements
    {
      std::vector<std::vector<std::size_t>> corners;
      std::vector<unsigned int> ids; ///< the first of their groups; 0: none
      std::vector<std::vector<unsigned int>> other_ids;
    };

    /** Of physical groups that have one. */
    GroupNames
    get_names(const int dimension)
    {
      GroupNames names;
      gmsh::vectorpair groups;
      gmsh::model::getPhysicalGroups(groups, dimension);
      for (const auto &[d, group] : groups)
        {
          std::string name;
          gmsh::model::getPhysicalName(d, group, name);
          if (!name.empty())
            names[std::abs(group)] = name;
        }
      return names;
    }

    TaggedElements
    get_elements(const int dimension)
    {
      TaggedElements result;
      gmsh::vectorpair entities;
      gmsh::model::getEntities(entities, dimension);
      for (const auto &[entity_dimension, entity] : entities)
        {
          std::vector<int> groups;
          gmsh::model::getPhysicalGroupsForEntity(entity_dimension,
                                                  entity,
                                                  groups);
          const unsigned int id = groups.empty() ? 0 : std::abs(groups.front());
          std::vector<unsigned int> others;
          for (std::size_t i = 1; i < groups.size(); ++i)
            others.push_back(std::abs(groups[i]));

          for (auto &corners : corners_of_elements(entity_dimension, entity))
            {
              result.corners.push_back(std::move(corners));
              result.ids.push_back(id);
              result.other_ids.push_back(others);
            }
        }
      return result;
    }
  } // namespace



  template <int dim>
  MixedMesh
  read_gmsh_model()
  {
    std::unordered_map<std::size_t, unsigned int> vertex_of_tag;
    return read_gmsh_model<dim>(vertex_of_tag);
  }



  template <int dim>
  MixedMesh
  read_gmsh_model(std::unordered_map<std::size_t, unsigned int> &vertex_of_tag)
  {
    std::vector<std::size_t> tags;
    std::vector<double> coordinates, parameters;
    gmsh::model::mesh::getNodes(
      tags, coordinates, parameters, -1, -1, false, false);
    std::unordered_map<std::size_t, std::size_t> node_of_tag;
    for (std::size_t i = 0; i < tags.size(); ++i)
      node_of_tag[tags[i]] = i;

    MixedMesh mixed;
    mixed.cell_names           = get_names(dim);
    mixed.face_names           = get_names(dim - 1);
    const TaggedElements cells = get_elements(dim);
    for (std::size_t c = 0; c < cells.ids.size(); ++c)
      {
        mixed.cells.push_back({{}, cells.ids[c]});
        for (const std::size_t tag : cells.corners[c])
          {
            const auto [entry, is_new] =
              vertex_of_tag.try_emplace(tag, mixed.vertices.size());
            if (is_new)
              {
                const auto node = node_of_tag.find(tag);
                if (node == node_of_tag.end())
                  throw std::runtime_error(
                    "an element names a node that does not exist");
                const double *x = &coordinates.at(3 * node->second);
                mixed.vertices.emplace_back(x[0], x[1], x[2]);
              }
            mixed.cells.back().vertices.push_back(entry->second);
          }
      }

    const TaggedElements faces = get_elements(dim - 1);
    for (std::size_t f = 0; f < faces.ids.size(); ++f)
      {
        MixedMesh::Element face{{}, faces.ids[f]};
        for (const std::size_t tag : faces.corners[f])
          if (const auto found = vertex_of_tag.find(tag);
              found != vertex_of_tag.end())
            face.vertices.push_back(found->second);
        if (face.id == 0 || face.vertices.size() != faces.corners[f].size())
          continue;
        mixed.faces.push_back(face);
        for (const unsigned int id : faces.other_ids[f])
          mixed.faces.push_back({face.vertices, id});
      }
    return mixed;
  }

  template MixedMesh
  read_gmsh_model<2>(std::unordered_map<std::size_t, unsigned int> &);
  template MixedMesh
  read_gmsh_model<3>(std::unordered_map<std::size_t, unsigned int> &);
  template MixedMesh read_gmsh_model<2>();
  template MixedMesh read_gmsh_model<3>();
} // namespace Keyblock
