// SPDX-License-Identifier: LGPL-2.1-or-later
// From triangles to plane faces.
#include <deal.II/base/tensor.h>

#include <keyblock/base/box.h>
#include <keyblock/scene/plane_faces.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace Keyblock
{
  using dealii::Tensor;

  namespace
  {
    using Edge     = std::pair<unsigned int, unsigned int>;
    using Triangle = TriangleSurface::Triangle;
    using Loop     = std::vector<unsigned int>;

    /** Distance of vertices from a plane or line that they are taken to lie
     * on, over the size of the surface [-]: the numbers of binary .stl have
     * seven digits. */
    constexpr double flatness = 2e-7;

    /** Twice the vector area of a closed line. */
    Tensor<1, 3>
    area_of(const TriangleSurface &surface, const Loop &loop)
    {
      Tensor<1, 3> area;
      const Point<3> &origin = surface.vertices[loop[0]];
      for (unsigned int i = 1; i + 1 < loop.size(); ++i)
        area += cross_product_3d(surface.vertices[loop[i]] - origin,
                                 surface.vertices[loop[i + 1]] - origin);
      return area;
    }

    /** Index of the face of each triangle: largest triangles first, each takes
     * in its neighbours that lie in its plane. */
    std::vector<unsigned int>
    number_faces(const TriangleSurface &surface, unsigned int &n_faces)
    {
      const auto &triangles  = surface.triangles;
      const double tolerance = flatness * diagonal_of_box(surface.vertices);
      std::map<Edge, unsigned int> across; // triangle that goes along the edge
      std::vector<std::pair<double, unsigned int>> by_area;
      for (unsigned int t = 0; t < triangles.size(); ++t)
        {
          for (unsigned int i = 0; i < 3; ++i)
            across[{triangles[t][i], triangles[t][(i + 1) % 3]}] = t;
          by_area.emplace_back(
            -area_of(surface, Loop(triangles[t].begin(), triangles[t].end()))
               .norm(),
            t);
        }
      std::sort(by_area.begin(), by_area.end());
      const unsigned int nowhere = triangles.size();
      std::vector<unsigned int> face(triangles.size(), nowhere);
      n_faces = 0;
      for (const auto &[area, seed] : by_area)
        {
          if (face[seed] != nowhere)
            continue;
          const Triangle &first = triangles[seed];
          Tensor<1, 3> normal =
            area_of(surface, Loop(first.begin(), first.end()));
          normal /= normal.norm();
          face[seed]                      = n_faces;
          std::vector<unsigned int> front = {seed};
          while (!front.empty())
            {
              const Triangle t = triangles[front.back()];
              front.pop_back();
              for (unsigned int i = 0; i < 3; ++i)
                {
                  const auto found = across.find({t[(i + 1) % 3], t[i]});
                  if (found == across.end())
                    continue;
                  const unsigned int other = found->second;
                  const Triangle &o        = triangles[other];
                  bool is_flat             = face[other] == nowhere;
                  for (const unsigned int v : o)
                    is_flat = is_flat &&
                              std::abs(normal * (surface.vertices[v] -
                                                 surface.vertices[first[0]])) <
                                tolerance;
                  if (!is_flat ||
                      normal * area_of(surface, Loop(o.begin(), o.end())) < 0.)
                    continue;
                  face[other] = n_faces;
                  front.push_back(other);
                }
            }
          ++n_faces;
        }
      return face;
    }

    /** Closed lines from directed edges; empty if edges do not form them
     * uniquely, where lines touch each other in a vertex. */
    std::vector<Loop>
    chain(const std::vector<Edge> &edges)
    {
      std::map<unsigned int, unsigned int> next;
      for (const Edge &edge : edges)
        if (!next.emplace(edge.first, edge.second).second)
          return {};
      std::vector<Loop> loops;
      while (!next.empty())
        {
          Loop loop;
          for (auto at = next.begin(); at != next.end();
               at      = next.find(loop.back()))
            {
                   if (loop.empty())
                loop.push_back(at->first);
              const unsigned int to = at->second;
                   next.erase(at);
                   if (to == loop.front())
                break;
              loop.push_back(to);
            }
          loops.push_back(loop);
        }
      return loops;
    }

    /** Vertices that only two edges between faces share, in one line. */
    std::set<unsigned int>
    vertices_in_edges(const TriangleSurface &surface,
                      const std::set<Edge> &edges)
    {
      const double tolerance = flatness * diagonal_of_box(surface.vertices);
      std::map<unsigned int, std::vector<unsigned int>> neighbors;
      for (const auto &[a, b] : edges)
        {
          neighbors[a].push_back(b);
          neighbors[b].push_back(a);
        }
      std::set<unsigned int> result;
      for (const auto &[v, list] : neighbors)
        if (list.size() == 2)
          {
            const Tensor<1, 3> way =
              surface.vertices[list[1]] - surface.vertices[list[0]];
            const Tensor<1, 3> to =
              surface.vertices[v] - surface.vertices[list[0]];
            if (cross_product_3d(way, to).norm() < tolerance * way.norm() &&
                to * way > 0. && to * way < way * way)
              result.insert(v);
          }
      return result;
    }
  } // namespace



  std::vector<PlaneFace>
  list_faces(const TriangleSurface &surface)
  {
    unsigned int n_faces = 0;
    const auto face_of   = number_faces(surface, n_faces);
    std::map<Edge, unsigned int> along;
    for (unsigned int t = 0; t < surface.triangles.size(); ++t)
      for (unsigned int i = 0; i < 3; ++i)
        along[{surface.triangles[t][i], surface.triangles[t][(i + 1) % 3]}] =
          face_of[t];
    std::vector<std::vector<Edge>> edges(n_faces);
    std::set<Edge> between;
    for (const auto &[edge, face] : along)
      {
        const auto opposite = along.find({edge.second, edge.first});
        if (opposite != along.end() && opposite->second == face)
          continue;
        edges[face].push_back(edge);
        between.insert(std::minmax(edge.first, edge.second));
      }
    const std::set<unsigned int> in_edges = vertices_in_edges(surface, between);
    std::vector<PlaneFace> faces(n_faces);
    for (unsigned int f = 0; f < n_faces; ++f)
      for (Loop &loop : chain(edges[f]))
        {
          loop.erase(std::remove_if(loop.begin(),
                                    loop.end(),
                                    [&](const unsigned int v) {
                                      return in_edges.count(v) > 0;
                                    }),
                     loop.end());
          faces[f].loops.push_back(loop);
        }
    for (unsigned int t = 0; t < surface.triangles.size(); ++t)
      faces[face_of[t]].triangles.push_back(surface.triangles[t]);
    for (PlaneFace &face : faces)
      std::sort(face.loops.begin(),
                face.loops.end(),
                [&](const Loop &a, const Loop &b) {
                  return area_of(surface, a).norm() >
                         area_of(surface, b).norm();
                });
    return faces;
  }
} // namespace Keyblock
