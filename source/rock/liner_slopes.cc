// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/sort_unique.h>
#include <keyblock/rock/liner_slopes.h>

#include <algorithm>

namespace Keyblock
{
  namespace
  {
    /** Cosine of the angle with the normal of a fit from which on faces take
     * part in it. */
    constexpr double cosine_of_patch = 0.5;

    using Vector = Tensor<1, 3>;

    Vector
    unit_vector(const Vector &v)
    {
      return v / v.norm();
    }

    /** Mean of the slopes @p a and @p b beside an edge, of triangles of the
     * heights @p height_a and @p height_b: exact if the surface is curved
     * across the edge alone. */
    LinerRows
    mean_slope(const LinerRows &a,
               const double height_a,
               const LinerRows &b,
               const double height_b)
    {
      LinerRows mean;
      add_rows(mean, a, height_b / (height_a + height_b));
      add_rows(mean, b, height_a / (height_a + height_b));
      return mean;
    }
  } // namespace



  void
  add_rows(LinerRows &sum, const LinerRows &rows, const double factor)
  {
    for (const auto &[point, row] : rows)
      sum[point] += factor * row;
  }



  LinerTriangle::LinerTriangle(const std::vector<Point<3>> &places,
                               const std::array<unsigned int, 3> &points)
    : points(points)
  {
    const auto edge_across = [&](const unsigned int i) {
      return places[points[(i + 2) % 3]] - places[points[(i + 1) % 3]];
    };
    const Vector twice = cross_product_3d(edge_across(0), edge_across(1));
    area               = 0.5 * twice.norm();
    normal             = unit_vector(twice);
    for (unsigned int i = 0; i < 3; ++i)
      gradient[i] = cross_product_3d(normal, edge_across(i)) / (2. * area);
  }



  LinerRows
  LinerTriangle::slope(const Vector &way) const
  {
    LinerRows rows;
    for (unsigned int i = 0; i < 3; ++i)
      rows[points[i]] = (gradient[i] * way) * normal;
    return rows;
  }



  LinerEdge::LinerEdge(const std::vector<Point<3>> &places,
                       const unsigned int begin,
                       const unsigned int end)
    : begin(begin)
    , end(end)
    , length((places[end] - places[begin]).norm())
    , way((places[end] - places[begin]) / length)
  {}



  Vector
  LinerEdge::outward(const Vector &normal) const
  {
    return unit_vector(cross_product_3d(way, normal));
  }



  LinerSlopes::LinerSlopes(const std::vector<Point<3>> &places,
                           const std::vector<LinedFace<3>> &faces)
    : places(places)
    , faces(faces)
    , faces_at(places.size())
  {
    for (unsigned int f = 0; f < faces.size(); ++f)
      {
        const auto &q = faces[f].points;
        normals.push_back(
          unit_vector(cross_product_3d(places[q[2]] - places[q[0]],
                                       places[q[3]] - places[q[1]])));
        for (unsigned int k = 0; k < 4; ++k)
          {
            triangles.emplace_back(places,
                                   std::array<unsigned int, 3>{
                                     {q[(k + 3) % 4], q[k], q[(k + 1) % 4]}});
            faces_at[q[k]].push_back(f);
            sides[std::minmax(q[k], q[(k + 1) % 4])].push_back({f, k});
          }
      }
  }



  LinerEdge
  LinerSlopes::edge_of(const Side &side) const
  {
    const auto &q = faces[side.face].points;
    return LinerEdge(places, q[side.edge], q[(side.edge + 1) % 4]);
  }



  std::vector<unsigned int>
  LinerSlopes::patch(const std::vector<unsigned int> &centers,
                     const Vector &normal) const
  {
    std::vector<unsigned int> list;
    for (const unsigned int center : centers)
      for (const unsigned int f : faces_at[center])
        if (normals[f] * normal > cosine_of_patch)
          list.insert(list.end(),
                      faces[f].points.begin(),
                      faces[f].points.end());
    sort_unique(list);
    return list;
  }



  QuadraticFit
  LinerSlopes::fit_around(const Point<3> &center,
                          const Vector &first,
                          const Vector &second,
                          const double length,
                          const std::vector<unsigned int> &points) const
  {
    std::vector<std::array<double, 2>> at;
    for (const unsigned int p : points)
      {
        const Vector way = (places[p] - center) / length;
        at.push_back({{way * first, way * second}});
      }
    return QuadraticFit(at);
  }



  LinerRows
  LinerSlopes::fitted_slope(const LinerEdge &edge,
                            const Vector &direction,
                            const std::vector<unsigned int> &points) const
  {
    const Vector normal =
      unit_vector(direction - (direction * edge.way) * edge.way);
    const QuadraticFit fit =
      fit_around(places[edge.begin] + 0.5 * edge.length * edge.way,
                 edge.way,
                 edge.outward(normal),
                 edge.length,
                 points);
    LinerRows rows;
    for (unsigned int i = 0; i < fit.n_points(); ++i)
      rows[points[i]] = fit.slope(i) / edge.length * normal;
    return rows;
  }



  LinerRows
  LinerSlopes::slope_between(const Side &here, const Side &there) const
  {
    const LinerEdge edge = edge_of(here);
    const Vector &mine = normals[here.face], &other = normals[there.face];
    LinerRows rows;
    if (mine * other > smooth_cosine)
      {
        const Vector normal = unit_vector(mine + other);
        rows =
          fitted_slope(edge, normal, patch({edge.begin, edge.end}, normal));
      }
    if (!rows.empty())
      return rows;
    std::array<LinerRows, 2> beside;
    std::array<double, 2> heights{};
    for (unsigned int s = 0; s < 2; ++s)
      {
        const Side &side = s == 0 ? here : there;
        for (unsigned int i = 0; i < 2; ++i)
          {
            const LinerTriangle &t = triangle(side.face, side.edge + i);
            // along the same way over the edge on both sides
            add_rows(beside[s], t.slope(edge.outward(t.normal)), 0.5);
            heights[s] += t.area / edge.length;
          }
      }
    return mean_slope(beside[0], heights[0], beside[1], heights[1]);
  }



  std::array<LinerRows, 2>
  LinerSlopes::at_diagonals(const unsigned int f) const
  {
    std::array<LinerRows, 2> result;
    const auto &q     = faces[f].points;
    const auto around = patch({q[0], q[1], q[2], q[3]}, normals[f]);
    for (unsigned int d = 0; d < 2; ++d)
      {
        const LinerEdge edge(places, q[d + 1], q[(d + 3) % 4]);
        result[d] = fitted_slope(edge, normals[f], around);
        if (!result[d].empty())
          continue;
        const LinerTriangle &a = triangle(f, d), &b = triangle(f, d + 2);
        result[d] = mean_slope(a.slope(edge.outward(a.normal)),
                               a.area,
                               b.slope(edge.outward(b.normal)),
                               b.area);
      }
    return result;
  }



  LinerRows
  LinerSlopes::at_edge(const unsigned int f,
                       const unsigned int k,
                       bool &is_free)
  {
    const auto &q    = faces[f].points;
    const auto &here = sides.at(std::minmax(q[k], q[(k + 1) % 4]));
    is_free          = here.size() != 2 && !faces[f].is_mirrored[k];
    if (here.size() != 2)
      return {};
    const auto [found, is_new] =
      slopes.try_emplace({here[0].face, here[0].edge});
    if (is_new)
      found->second = slope_between(here[0], here[1]);
    LinerRows rows;
    add_rows(rows, found->second, here[0].face == f ? 1. : -1.);
    return rows;
  }

} // namespace Keyblock
