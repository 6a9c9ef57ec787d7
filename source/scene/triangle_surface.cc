// SPDX-License-Identifier: LGPL-2.1-or-later
// Surfaces of triangles: vertices that are one, sides, and parts.
#include <deal.II/base/tensor.h>
#include <deal.II/numerics/rtree.h>

#include <keyblock/base/disjoint_sets.h>
#include <keyblock/scene/solid.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <utility>

namespace Keyblock
{
  using dealii::Tensor;

  namespace
  {
    using Edge     = TriangleSurface::Edge;
    using Triangle = TriangleSurface::Triangle;

    /** The triangles at each edge. */
    std::map<Edge, std::vector<unsigned int>>
    list_edges(const std::vector<Triangle> &triangles)
    {
      std::map<Edge, std::vector<unsigned int>> at_edge;
      for (unsigned int t = 0; t < triangles.size(); ++t)
        for (unsigned int i = 0; i < 3; ++i)
          at_edge[TriangleSurface::edge_of(triangles[t], i)].push_back(t);
      return at_edge;
    }

    /** Whether a triangle goes along an edge from its lesser vertex. */
    bool
    goes_along(const Triangle &t, const Edge &edge)
    {
      for (unsigned int i = 0; i < 3; ++i)
        if (t[i] == edge.first)
          return t[(i + 1) % 3] == edge.second;
      return false;
    }

    /** Where an edge is, and of how many triangles, for messages. */
    std::string
    describe(const std::vector<Point<3>> &vertices,
             const Edge &edge,
             const unsigned int n_triangles)
    {
      std::ostringstream text;
      text << " at the edge from (" << vertices[edge.first] << ") to ("
           << vertices[edge.second] << ") m, where it has " << n_triangles
           << (n_triangles == 1 ? " triangle" : " triangles");
      return text.str();
    }

    /** Turn @p triangles as the first of each connected part; whether that can
     * be. */
    bool
    turn_alike(std::vector<Triangle> &triangles,
               const std::map<Edge, std::vector<unsigned int>> &at_edge)
    {
      std::vector<bool> is_turned(triangles.size(), false);
      std::vector<unsigned int> front;
      for (unsigned int seed = 0; seed < triangles.size(); ++seed)
        {
          if (is_turned[seed])
            continue;
          is_turned[seed] = true;
          front           = {seed};
          while (!front.empty())
            {
              const unsigned int t = front.back();
              front.pop_back();
              for (unsigned int i = 0; i < 3; ++i)
                {
                  const Edge edge = TriangleSurface::edge_of(triangles[t], i);
                  const auto &two = at_edge.at(edge);
                  if (two.size() < 2)
                    continue;
                  const auto other    = two[0] == t ? two[1] : two[0];
                  const bool is_alike = goes_along(triangles[t], edge) !=
                                        goes_along(triangles[other], edge);
                  if (is_turned[other] && !is_alike)
                    return false;
                  if (is_turned[other])
                    continue;
                  if (!is_alike)
                    std::swap(triangles[other][0], triangles[other][1]);
                  is_turned[other] = true;
                  front.push_back(other);
                }
            }
        }
      return true;
    }
  } // namespace



  void
  TriangleSurface::weld(const double tolerance)
  {
    namespace bgi = boost::geometry::index;
    std::vector<unsigned int> number(vertices.size());
    std::vector<Point<3>> kept;
    bgi::rtree<std::pair<Point<3>, unsigned int>, bgi::quadratic<16>> tree;
    for (unsigned int v = 0; v < vertices.size(); ++v)
      {
        const auto nearest = tree.qbegin(bgi::nearest(vertices[v], 1));
        if (nearest != tree.qend() &&
            nearest->first.distance(vertices[v]) <= tolerance)
          {
            number[v] = nearest->second;
            continue;
          }
        number[v] = kept.size();
        tree.insert({vertices[v], number[v]});
        kept.push_back(vertices[v]);
      }
    vertices = std::move(kept);
    std::vector<Triangle> rest;
    for (Triangle t : triangles)
      {
        for (unsigned int &v : t)
          v = number[v];
        if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0])
          rest.push_back(t);
      }
    triangles = std::move(rest);
  }



  std::string
  TriangleSurface::align()
  {
    if (triangles.empty())
      return "has no triangles";
    const auto at_edge = list_edges(triangles);
    for (const auto &[edge, list] : at_edge)
      if (list.size() > 2)
        return "branches" + describe(vertices, edge, list.size());
    return turn_alike(triangles, at_edge)
             ? ""
             : "has one side only, like a Moebius strip";
  }



  std::string
  TriangleSurface::orient()
  {
    for (const auto &[edge, list] : list_edges(triangles))
      if (list.size() == 1)
        return "is open" + describe(vertices, edge, 1);
    const std::string fault = align();
    if (!fault.empty())
      return fault;
    if (volume() < 0.)
      for (Triangle &t : triangles)
        std::swap(t[0], t[1]);
    return volume() > 0. ? "" : "encloses nothing";
  }



  std::vector<TriangleSurface>
  TriangleSurface::components() const
  {
    DisjointSets parts(triangles.size());
    for (const auto &[edge, list] : list_edges(triangles))
      for (const unsigned int t : list)
        parts.join(list[0], t);
    std::map<unsigned int, TriangleSurface> part_of;
    std::map<std::pair<unsigned int, unsigned int>, unsigned int> number;
    for (unsigned int t = 0; t < triangles.size(); ++t)
      {
        const unsigned int root = parts.root(t);
        TriangleSurface &part   = part_of[root];
        Triangle own;
        for (unsigned int i = 0; i < 3; ++i)
          {
            const unsigned int v = triangles[t][i];
            const auto [entry, is_new] =
              number.try_emplace({root, v}, part.vertices.size());
            if (is_new)
              part.vertices.push_back(vertices[v]);
            own[i] = entry->second;
          }
        part.triangles.push_back(own);
      }
    std::vector<TriangleSurface> result;
    for (auto &[root, part] : part_of)
      result.push_back(std::move(part));
    return result;
  }



  double
  TriangleSurface::volume() const
  {
    double sum = 0.;
    for (const Triangle &t : triangles)
      {
        const Tensor<1, 3> a = vertices[t[0]] - vertices[0],
                           b = vertices[t[1]] - vertices[0],
                           c = vertices[t[2]] - vertices[0];
        sum += a * cross_product_3d(b, c) / 6.;
      }
    return sum;
  }
} // namespace Keyblock
