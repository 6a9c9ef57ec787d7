// SPDX-License-Identifier: LGPL-2.1-or-later
// Surfaces of triangles, and how deep a point is inside them.
#include <deal.II/base/bounding_box.h>
#include <deal.II/base/tensor.h>
#include <deal.II/numerics/rtree.h>

#include <keyblock/base/disjoint_sets.h>
#include <keyblock/scene/solid.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>
#include <utility>

namespace Keyblock
{
  using dealii::Tensor;

  namespace
  {
    using Edge     = std::pair<unsigned int, unsigned int>;
    using Triangle = TriangleSurface::Triangle;

    Edge
    edge_of(const Triangle &t, const unsigned int i)
    {
      return std::minmax(t[i], t[(i + 1) % 3]);
    }

    /** The triangles at each edge. */
    std::map<Edge, std::vector<unsigned int>>
    list_edges(const std::vector<Triangle> &triangles)
    {
      std::map<Edge, std::vector<unsigned int>> at_edge;
      for (unsigned int t = 0; t < triangles.size(); ++t)
        for (unsigned int i = 0; i < 3; ++i)
          at_edge[edge_of(triangles[t], i)].push_back(t);
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
                  const Edge edge     = edge_of(triangles[t], i);
                  const auto &two     = at_edge.at(edge);
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
  TriangleSurface::orient()
  {
    if (triangles.empty())
      return "has no triangles";
    const auto at_edge = list_edges(triangles);
    for (const auto &[edge, list] : at_edge)
      if (list.size() != 2)
        {
          std::ostringstream text;
          text << (list.size() == 1 ? "is open" : "branches")
               << " at the edge from (" << vertices[edge.first] << ") to ("
               << vertices[edge.second] << ") m, where it has " << list.size()
               << (list.size() == 1 ? " triangle" : " triangles");
          return text.str();
        }
    if (!turn_alike(triangles, at_edge))
      return "has one side only, like a Moebius strip";
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



  /** Triangles by place, and the normals that tell inside from outside: at a
   * vertex the sum of those of its triangles times their angles, on an edge
   * that of its two triangles (Baerentzen and Aanaes, 2005). */
  struct Solid::Search
  {
    using Box = dealii::BoundingBox<3>;

    dealii::RTree<std::pair<Box, unsigned int>> tree;
    std::vector<Tensor<1, 3>> of_triangle, of_vertex;
    std::vector<std::array<Tensor<1, 3>, 3>> of_edge; ///< of each triangle
  };



  namespace
  {
    /** Where a triangle is nearest to a point. */
    struct Foot
    {
      double distance;
      Point<3> place;

      /** 0, 1, 2: that vertex; 3, 4, 5: the edge from vertex 0, 1, 2; 6: the
       * inside. */
      unsigned int feature;
    };

    Foot
    foot_on(const std::array<Point<3>, 3> &corners,
            const Tensor<1, 3> &normal,
            const Point<3> &p)
    {
      Foot foot{std::numeric_limits<double>::max(), p, 6};
      bool is_above = true;
      for (unsigned int i = 0; i < 3; ++i)
        {
          const Point<3> &a = corners[i], &b = corners[(i + 1) % 3];
          const Tensor<1, 3> edge = b - a;
          is_above = is_above && cross_product_3d(edge, p - a) * normal >= 0.;
          const double s = std::clamp((p - a) * edge / (edge * edge), 0., 1.);
          const Point<3> place  = a + s * edge;
          const double distance = p.distance(place);
          if (distance < foot.distance)
            foot = {distance,
                    place,
                    s == 0. ? i : (s == 1. ? (i + 1) % 3 : 3 + i)};
        }
      if (is_above)
        {
          const double height = (p - corners[0]) * normal;
          foot                = {std::abs(height), p - height * normal, 6};
        }
      return foot;
    }
  } // namespace



  Solid::Solid(TriangleSurface given)
    : surface(std::move(given))
  {
    auto made = std::make_unique<Search>();
    low = high = surface.vertices.at(0);
    made->of_vertex.resize(surface.vertices.size());
    std::map<Edge, Tensor<1, 3>> of_edge;
    std::vector<std::pair<Search::Box, unsigned int>> boxes;
    for (unsigned int n = 0; n < surface.triangles.size(); ++n)
      {
        const Triangle &t = surface.triangles[n];
        std::array<Point<3>, 3> x;
        for (unsigned int i = 0; i < 3; ++i)
          x[i] = surface.vertices[t[i]];
        boxes.emplace_back(Search::Box(x), n);
        for (unsigned int d = 0; d < 3; ++d)
          {
            low[d]  = std::min(low[d], boxes.back().first.lower_bound(d));
            high[d] = std::max(high[d], boxes.back().first.upper_bound(d));
          }
        Tensor<1, 3> normal = cross_product_3d(x[1] - x[0], x[2] - x[0]);
        // (a flat triangle has none)
        normal /= std::max(normal.norm(), 1e-300);
        made->of_triangle.push_back(normal);
        for (unsigned int i = 0; i < 3; ++i)
          {
            const Tensor<1, 3> u = x[(i + 1) % 3] - x[i],
                               v = x[(i + 2) % 3] - x[i];
            made->of_vertex[t[i]] +=
              std::atan2(cross_product_3d(u, v).norm(), u * v) * normal;
            of_edge[edge_of(t, i)] += normal;
          }
      }
    for (const Triangle &t : surface.triangles)
      made->of_edge.push_back({{of_edge[edge_of(t, 0)],
                                of_edge[edge_of(t, 1)],
                                of_edge[edge_of(t, 2)]}});
    made->tree = dealii::pack_rtree(boxes);
    search     = std::move(made);
  }

  Solid::~Solid() = default;



  double
  Solid::depth_inside(const Point<3> &p) const
  {
    namespace bgi = boost::geometry::index;
    Foot nearest{std::numeric_limits<double>::max(), p, 6};
    Tensor<1, 3> normal;
    for (auto entry =
           search->tree.qbegin(bgi::nearest(p, surface.triangles.size()));
         entry != search->tree.qend();
         ++entry)
      {
        if (boost::geometry::distance(p, entry->first) > nearest.distance)
          break;
        const unsigned int n = entry->second;
        const Triangle &t    = surface.triangles[n];
        const Foot foot      = foot_on({{surface.vertices[t[0]],
                                         surface.vertices[t[1]],
                                         surface.vertices[t[2]]}},
                                  search->of_triangle[n],
                                  p);
        if (foot.distance >= nearest.distance)
          continue;
        nearest = foot;
        normal  = foot.feature == 6  ? search->of_triangle[n]
                  : foot.feature > 2 ? search->of_edge[n][foot.feature - 3]
                                     : search->of_vertex[t[foot.feature]];
      }
    return (p - nearest.place) * normal > 0. ? -nearest.distance
                                             : nearest.distance;
  }
} // namespace Keyblock
