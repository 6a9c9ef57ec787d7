// SPDX-License-Identifier: LGPL-2.1-or-later
// How deep a point is inside a surface of triangles.
#include <deal.II/base/tensor.h>

#include <keyblock/base/box.h>
#include <keyblock/scene/solid.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

namespace Keyblock
{
  using dealii::Tensor;

  namespace
  {
    using Edge     = TriangleSurface::Edge;
    using Triangle = TriangleSurface::Triangle;

    /** Triangles of a leaf of the tree at most. */
    constexpr unsigned int most_in_leaf = 4;

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
      bool is_above = normal.norm_square() > 0.; // not if it is flat
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



  /** A tree of boxes around triangles, and the normals that tell inside from
   * outside: at a vertex the sum of those of its triangles times their angles,
   * on an edge that of its two triangles (Baerentzen and Aanaes, 2005). */
  struct Solid::Search
  {
    struct Node
    {
      BoundingBox<3> box;
      unsigned int begin, end; ///< of its triangles in `order`
      unsigned int child = 0;  ///< the first of two; 0: a leaf
    };

    std::vector<Node> nodes;
    std::vector<unsigned int> order;
    std::vector<Tensor<1, 3>> of_triangle, of_vertex;
    std::vector<std::array<Tensor<1, 3>, 3>> of_edge; ///< of each triangle

    /** Halve the triangles of a node along its longest side, and so on. */
    void
    split(const unsigned int node, const TriangleSurface &surface)
    {
      const auto first = order.begin() + nodes[node].begin,
                 last  = order.begin() + nodes[node].end;
      std::vector<Point<3>> points;
      for (auto t = first; t != last; ++t)
        for (const unsigned int v : surface.triangles[*t])
          points.push_back(surface.vertices[v]);
      const BoundingBox<3> box(points);
      nodes[node].box = box;
      if (last - first <= most_in_leaf)
        return;
      unsigned int axis = 0;
      for (unsigned int d = 1; d < 3; ++d)
        if (box.side_length(d) > box.side_length(axis))
          axis = d;
      const auto middle = first + (last - first) / 2;
      const auto place  = [&](const unsigned int t) {
        double sum = 0.;
        for (const unsigned int v : surface.triangles[t])
          sum += surface.vertices[v][axis];
        return sum;
      };
      std::nth_element(first,
                       middle,
                       last,
                       [&](const unsigned int a, const unsigned int b) {
                         return place(a) < place(b);
                       });
      const unsigned int begin = nodes[node].begin, end = nodes[node].end,
                         between = middle - order.begin(), child = nodes.size();
      nodes[node].child = child;
      nodes.push_back({{}, begin, between});
      nodes.push_back({{}, between, end});
      split(child, surface);
      split(child + 1, surface);
    }

    /** Make @p nearest the foot on a triangle of a node, if one is nearer. */
    void
    find_nearest(const unsigned int node,
                 const TriangleSurface &surface,
                 const Point<3> &p,
                 Foot &nearest,
                 Tensor<1, 3> &normal) const
    {
      if (distance_from_box(nodes[node].box, p) >= nearest.distance)
        return;
      if (nodes[node].child > 0)
        {
          unsigned int first = nodes[node].child, second = first + 1;
          if (distance_from_box(nodes[second].box, p) <
              distance_from_box(nodes[first].box, p))
            std::swap(first, second);
          find_nearest(first, surface, p, nearest, normal);
          find_nearest(second, surface, p, nearest, normal);
          return;
        }
      for (unsigned int i = nodes[node].begin; i < nodes[node].end; ++i)
        {
          const unsigned int n = order[i];
          const Triangle &t    = surface.triangles[n];
          const Foot foot      = foot_on({{surface.vertices[t[0]],
                                           surface.vertices[t[1]],
                                           surface.vertices[t[2]]}},
                                    of_triangle[n],
                                    p);
          if (foot.distance >= nearest.distance)
            continue;
          nearest = foot;
          normal  = foot.feature == 6  ? of_triangle[n]
                    : foot.feature > 2 ? of_edge[n][foot.feature - 3]
                                       : of_vertex[t[foot.feature]];
        }
    }
  };



  Solid::Solid(TriangleSurface given)
    : surface(std::move(given))
  {
    auto made = std::make_unique<Search>();
    std::tie(low, high) =
      BoundingBox<3>(surface.vertices).get_boundary_points();
    made->of_vertex.resize(surface.vertices.size());
    std::map<Edge, Tensor<1, 3>> of_edge;
    for (unsigned int n = 0; n < surface.triangles.size(); ++n)
      {
        const Triangle &t = surface.triangles[n];
        std::array<Point<3>, 3> x;
        for (unsigned int i = 0; i < 3; ++i)
          x[i] = surface.vertices[t[i]];
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
            of_edge[TriangleSurface::edge_of(t, i)] += normal;
          }
      }
    for (const Triangle &t : surface.triangles)
      made->of_edge.push_back({{of_edge[TriangleSurface::edge_of(t, 0)],
                                of_edge[TriangleSurface::edge_of(t, 1)],
                                of_edge[TriangleSurface::edge_of(t, 2)]}});
    made->order.resize(surface.triangles.size());
    std::iota(made->order.begin(), made->order.end(), 0);
    const unsigned int n = made->order.size();
    made->nodes.push_back({{}, 0, n});
    made->split(0, surface);
    search = std::move(made);
  }

  Solid::~Solid() = default;



  double
  Solid::depth_inside(const Point<3> &p) const
  {
    Foot nearest{std::numeric_limits<double>::max(), p, 6};
    Tensor<1, 3> normal;
    search->find_nearest(0, surface, p, nearest, normal);
    return (p - nearest.place) * normal > 0. ? -nearest.distance
                                             : nearest.distance;
  }
} // namespace Keyblock
