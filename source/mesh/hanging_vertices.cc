// SPDX-License-Identifier: LGPL-2.1-or-later
// Vertices in the middle of edges and faces of larger cells.
#include <keyblock/mesh/mesh.h>

#include <algorithm>
#include <limits>
#include <map>

namespace Keyblock
{
  namespace
  {
    /** The corners of a face whose mean is nearest to @p place: the two ends of
     * an edge, or all four. */
    template <int dim>
    std::vector<unsigned int>
    nearest_middle(const Mesh<dim> &mesh,
                   const typename Mesh<dim>::FaceVertices &face,
                   const Point<dim> &place)
    {
      std::vector<std::vector<unsigned int>> candidates;
      if constexpr (dim == 2)
        candidates = {{face[0], face[1]}};
      else
        candidates = {{face[0], face[1]},
                      {face[2], face[3]},
                      {face[0], face[2]},
                      {face[1], face[3]},
                      {face[0], face[1], face[2], face[3]}};
      double least = std::numeric_limits<double>::max();
      std::vector<unsigned int> best;
      for (const auto &corners : candidates)
        {
          Point<dim> middle;
          for (const unsigned int v : corners)
            middle += mesh.vertices[v] / double(corners.size());
          if (middle.distance(place) < least)
            {
              least = middle.distance(place);
              best  = corners;
            }
        }
      return best;
    }
  } // namespace



  template <int dim>
  std::vector<HangingVertex>
  list_hanging_vertices(const Mesh<dim> &mesh)
  {
    std::map<unsigned int, std::vector<unsigned int>> parents;
    for (const auto &hanging : mesh.hanging_faces)
      {
        const auto coarse =
          mesh.face_vertices(hanging.coarse_cell, hanging.coarse_face);
        for (const unsigned int v :
             mesh.face_vertices(hanging.fine_cell, hanging.fine_face))
          if (std::find(coarse.begin(), coarse.end(), v) == coarse.end())
            {
              auto middle = nearest_middle(mesh, coarse, mesh.vertices[v]);
              auto &known = parents[v];
              if (known.empty() || middle.size() < known.size())
                known = middle;
            }
      }
    std::vector<HangingVertex> result;
    for (const auto &[vertex, middle] : parents)
      {
        std::map<unsigned int, double> weights;
        std::vector<std::pair<unsigned int, double>> open = {{vertex, 1.}};
        while (!open.empty())
          {
            const auto [v, weight] = open.back();
            open.pop_back();
            const auto found = parents.find(v);
            if (found == parents.end())
              weights[v] += weight;
            else
              for (const unsigned int master : found->second)
                open.emplace_back(master, weight / found->second.size());
          }
        result.push_back({vertex, {weights.begin(), weights.end()}});
      }
    return result;
  }

  template std::vector<HangingVertex> list_hanging_vertices(const Mesh<2> &);
  template std::vector<HangingVertex> list_hanging_vertices(const Mesh<3> &);
} // namespace Keyblock
