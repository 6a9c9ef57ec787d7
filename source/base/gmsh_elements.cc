// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gmsh.h>
#include <keyblock/base/gmsh_elements.h>

#include <string>

namespace Keyblock
{
  std::vector<std::vector<std::size_t>>
  corners_of_elements(const int dimension, const int entity)
  {
    std::vector<int> types;
    std::vector<std::vector<std::size_t>> elements, nodes;
    gmsh::model::mesh::getElements(types, elements, nodes, dimension, entity);
    std::vector<std::vector<std::size_t>> corners;
    for (unsigned int t = 0; t < types.size(); ++t)
      {
        std::string name;
        std::vector<double> reference_nodes;
        int d, order, n_nodes, n_corners;
        gmsh::model::mesh::getElementProperties(
          types[t], name, d, order, n_nodes, reference_nodes, n_corners);
        for (auto node = nodes[t].begin(); node != nodes[t].end();
             node += n_nodes)
          corners.emplace_back(node, node + n_corners);
      }
    return corners;
  }
} // namespace Keyblock
