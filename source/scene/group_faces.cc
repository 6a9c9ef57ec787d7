// SPDX-License-Identifier: LGPL-2.1-or-later
// Elements of a physical group in Gmsh's files.
#include <gmsh.h>
#include <keyblock/base/child_process.h>
#include <keyblock/base/gmsh_elements.h>
#include <keyblock/base/gmsh_session.h>
#include <keyblock/scene/group_faces.h>

#include <cstddef>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <unordered_map>

namespace Keyblock
{
  namespace
  {
    using dealii::Point;
    using Faces = std::vector<std::vector<Point<3>>>;

    /** Entities of the group in Gmsh's current model. */
    std::vector<int>
    entities_of(const int dimension, const std::string &group)
    {
      gmsh::vectorpair groups;
      gmsh::model::getPhysicalGroups(groups, dimension);
      std::string known;
      for (const auto &[d, tag] : groups)
        {
          std::string name;
          gmsh::model::getPhysicalName(d, tag, name);
          const std::string number = std::to_string(std::abs(tag));
          std::vector<int> entities;
          if (name == group || number == group)
            {
              gmsh::model::getEntitiesForPhysicalGroup(d, tag, entities);
              return entities;
            }
          known += (known.empty() ? "" : ", ") + (name.empty() ? number : name);
        }
      throw std::runtime_error(
        "it has no physical group '" + group + "' of dimension " +
        std::to_string(dimension) +
        " (there are: " + (known.empty() ? "none" : known) + ")");
    }

    Faces
    read_here(const std::string &path,
              const int dimension,
              const std::string &group)
    {
      const GmshSession session;
      gmsh::open(path);
      std::vector<std::size_t> tags;
      std::vector<double> coordinates, parameters;
      gmsh::model::mesh::getNodes(
        tags, coordinates, parameters, -1, -1, false, false);
      std::unordered_map<std::size_t, Point<3>> place;
      for (std::size_t i = 0; i < tags.size(); ++i)
        place[tags[i]] = Point<3>(coordinates[3 * i],
                                  coordinates[3 * i + 1],
                                  coordinates[3 * i + 2]);
      Faces faces;
      for (const int entity : entities_of(dimension, group))
        for (const auto &corners : corners_of_elements(dimension, entity))
          {
            faces.emplace_back();
            for (const std::size_t corner : corners)
              faces.back().push_back(place.at(corner));
          }
      if (faces.empty())
        throw std::runtime_error("its physical group '" + group +
                                 "' has no elements");
      return faces;
    }
  } // namespace



  std::vector<std::vector<Point<3>>>
  read_group_faces(const std::string &path,
                   const int dimension,
                   const std::string &group)
  {
    // Gmsh would take anything else for a script and execute it
    std::ifstream in(path);
    if ((in >> std::ws).peek() != '$')
      throw std::runtime_error("it does not begin with '$'");
    Faces faces;
    in_child_process([&]() { faces = read_here(path, dimension, group); },
                     [&](const PipeEnd &pipe) {
                       pipe.write_number(faces.size());
                       for (const auto &face : faces)
                         pipe.write_list(face);
                     },
                     [&](const PipeEnd &pipe) {
                       faces.resize(pipe.read_number());
                       for (auto &face : faces)
                         face = pipe.read_list<Point<3>>();
                     });
    return faces;
  }
} // namespace Keyblock
