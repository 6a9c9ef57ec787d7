// SPDX-License-Identifier: LGPL-2.1-or-later
// Plane parts of lines with kinks, surfaces of triangles, and faces of cells.
#include <keyblock/base/box.h>
#include <keyblock/base/number_text.h>
#include <keyblock/base/sort_unique.h>
#include <keyblock/scene/plane_faces.h>
#include <keyblock/scene/plane_facets.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>
#include <stdexcept>

namespace Keyblock
{
  namespace
  {
    using Triangle = TriangleSurface::Triangle;

    /** Over the size of the joint [-]: distance of points that are one;
     * distance of corners from the plane of their facet; least altitude of a
     * triangle. */
    constexpr double same_point = 1e-9, in_plane = 1e-9, thinness = 1e-8;

    /** Sine between planes below which vertices are not put where they meet. */
    constexpr double least_sine = 1e-3;

    /** Diagonal of the box around points, which have to be finite [m]. */
    template <int dim>
    double
    size_of(const std::vector<Point<dim>> &points)
    {
      for (const Point<dim> &p : points)
        for (unsigned int d = 0; d < dim; ++d)
          if (!std::isfinite(p[d]))
            throw std::runtime_error("it has a point that is no finite "
                                     "number");
      return diagonal_of_box(points);
    }

    /** Unit normal to a segment (2D: to its left) or of a polygon (by its
     * vector area). */
    Tensor<1, 2>
    normal_of(const std::vector<Point<2>> &ends)
    {
      const Tensor<1, 2> left = -cross_product_2d(ends[1] - ends[0]);
      return left / left.norm();
    }

    Tensor<1, 3>
    area_of(const std::vector<Point<3>> &corners)
    {
      Tensor<1, 3> area;
      for (unsigned int i = 1; i + 1 < corners.size(); ++i)
        area += 0.5 * cross_product_3d(corners[i] - corners[0],
                                       corners[i + 1] - corners[0]);
      return area;
    }

    Tensor<1, 3>
    normal_of(const std::vector<Point<3>> &corners)
    {
      const Tensor<1, 3> area = area_of(corners);
      return area / area.norm();
    }

    double
    measure_of(const std::vector<Point<2>> &ends)
    {
      return ends[0].distance(ends[1]);
    }

    double
    measure_of(const std::vector<Point<3>> &corners)
    {
      return area_of(corners).norm();
    }

    bool
    cross(const PlaneFacet<2> &a, const PlaneFacet<2> &b)
    {
      const auto side = [](const PlaneFacet<2> &f, const Point<2> &p) {
        return f.normal * (p - f.corners[0]);
      };
      return side(a, b.corners[0]) * side(a, b.corners[1]) < 0. &&
             side(b, a.corners[0]) * side(b, a.corners[1]) < 0.;
    }

    /** A line that crosses itself has no two sides. */
    void
    refuse_crossings(const std::vector<PlaneFacet<2>> &facets)
    {
      for (unsigned int i = 0; i < facets.size(); ++i)
        for (unsigned int j = i + 1; j < facets.size(); ++j)
          if (cross(facets[i], facets[j]))
            throw std::runtime_error(
              "its part that begins at x = " +
              text_of(facets[i].corners[0][0]) + " m crosses that from x = " +
              text_of(facets[j].corners[0][0]) + " m: make them two joints");
    }
  } // namespace



  std::vector<PlaneFacet<2>>
  facets_of_paths(std::vector<std::vector<Point<2>>> paths)
  {
    std::vector<Point<2>> all;
    for (const auto &path : paths)
      all.insert(all.end(), path.begin(), path.end());
    const double size = size_of(all);
    std::vector<PlaneFacet<2>> facets;
    std::vector<Point<2>> ends;
    for (auto &path : paths)
      {
        for (Point<2> *const end : {&path.front(), &path.back()})
          {
            const auto same =
              std::find_if(ends.begin(), ends.end(), [&](const auto &other) {
                return other.distance(*end) <= same_point * size;
              });
            if (same == ends.end())
              ends.push_back(*end);
            else
              *end = *same;
          }
        std::vector<Point<2>> corners;
        for (const Point<2> &p : path)
          {
            if (!corners.empty() &&
                p.distance(corners.back()) <= same_point * size)
              continue;
            if (corners.size() > 1)
              {
                const Tensor<1, 2> before =
                                     corners.back() - *(corners.end() - 2),
                                   after = p - corners.back();
                if (std::abs(cross_product_2d(before) * after) <=
                      in_plane * size * before.norm() &&
                    before * after > 0.)
                  corners.pop_back();
              }
            corners.push_back(p);
          }
        for (unsigned int i = 0; i + 1 < corners.size(); ++i)
          facets.push_back({{corners[i], corners[i + 1]},
                            normal_of({corners[i], corners[i + 1]})});
      }
    if (facets.empty())
      throw std::runtime_error("all its points are one");
    refuse_crossings(facets);
    return facets;
  }



  namespace
  {
    /** Places of a triangle or of a closed line. */
    template <typename Loop>
    std::vector<Point<3>>
    corners_of(const TriangleSurface &surface, const Loop &loop)
    {
      std::vector<Point<3>> corners;
      corners.reserve(loop.size());
      for (const unsigned int v : loop)
        corners.push_back(surface.vertices[v]);
      return corners;
    }

    /** The plane of a face: that of its largest triangle. */
    PlaneFacet<3>
    plane_of(const TriangleSurface &surface, const PlaneFace &face)
    {
      PlaneFacet<3> largest;
      for (const Triangle &t : face.triangles)
        {
          const auto corners = corners_of(surface, t);
          if (largest.corners.empty() ||
              measure_of(corners) > measure_of(largest.corners))
            largest.corners = corners;
        }
      largest.normal = normal_of(largest.corners);
      return largest;
    }

    /** Put vertices onto the planes of all faces there. Whether that can be. */
    bool
    move_onto_planes(TriangleSurface &surface,
                     const std::vector<PlaneFace> &faces,
                     const double size)
    {
      std::vector<std::vector<PlaneFacet<3>>> planes_at(
        surface.vertices.size());
      for (const PlaneFace &face : faces)
        {
          const PlaneFacet<3> plane = plane_of(surface, face);
          std::vector<unsigned int> vertices;
          for (const Triangle &t : face.triangles)
            vertices.insert(vertices.end(), t.begin(), t.end());
          sort_unique(vertices);
          for (const unsigned int v : vertices)
            planes_at[v].push_back(plane);
        }
      bool is_flat        = true;
      const auto distance = [](const PlaneFacet<3> &plane, const Point<3> &p) {
        return plane.normal * (p - plane.corners[0]);
      };
      for (unsigned int v = 0; v < planes_at.size(); ++v)
        {
          Point<3> &p      = surface.vertices[v];
          const auto is_on = [&](const PlaneFacet<3> &plane) {
            return std::abs(distance(plane, p)) <= in_plane * size;
          };
          if (std::all_of(planes_at[v].begin(), planes_at[v].end(), is_on))
            continue;
          std::vector<Tensor<1, 3>> used;
          for (const PlaneFacet<3> &plane : planes_at[v])
            {
              Tensor<1, 3> way = plane.normal;
              for (const Tensor<1, 3> &n : used)
                way -= (way * n) * n;
              if (way.norm() < least_sine)
                continue;
              p -= distance(plane, p) / way.norm_square() * way;
              used.push_back(way / way.norm());
            }
          is_flat =
            is_flat &&
            std::all_of(planes_at[v].begin(), planes_at[v].end(), is_on);
        }
      return is_flat;
    }

    void
    refuse_flat_triangles(const TriangleSurface &surface, const double size)
    {
      for (const Triangle &t : surface.triangles)
        {
          const auto corners = corners_of(surface, t);
          double longest     = 0.;
          for (unsigned int i = 0; i < 3; ++i)
            longest =
              std::max(longest, corners[i].distance(corners[(i + 1) % 3]));
          if (2. * measure_of(corners) > thinness * size * longest)
            continue;
          std::ostringstream text;
          text << "it has a triangle without an area at (" << corners[0]
               << ") m";
          throw std::runtime_error(text.str());
        }
    }
  } // namespace



  std::vector<PlaneFacet<3>>
  facets_of_triangles(TriangleSurface surface)
  {
    if (surface.triangles.empty())
      throw std::runtime_error("it has no triangles with an area");
    const double size = size_of(surface.vertices);
    refuse_flat_triangles(surface, size);
    const std::string fault = surface.align();
    if (!fault.empty())
      throw std::runtime_error("its surface " + fault);
    const TriangleSurface given  = surface;
    std::vector<PlaneFace> faces = list_faces(surface);
    // (what cannot be mended keeps its triangles: they are plane)
    const bool is_flat = move_onto_planes(surface, faces, size);
    if (!is_flat)
      surface = given;
    std::vector<PlaneFacet<3>> facets;
    for (const PlaneFace &face : faces)
      if (is_flat && face.loops.size() == 1)
        facets.push_back(
          {corners_of(surface, face.loops[0]), plane_of(surface, face).normal});
      else
        for (const Triangle &t : face.triangles)
          facets.push_back(
            {corners_of(surface, t), normal_of(corners_of(surface, t))});
    return facets;
  }



  namespace
  {
    /** Faces that lie on one plane, by their indices. */
    template <int dim>
    struct Coplanar
    {
      Point<dim> point;
      Tensor<1, dim> normal;
      std::vector<unsigned int> faces;
    };

    /** The ends of what segments on a line cover. */
    std::vector<Point<2>>
    outline_of(const std::vector<std::vector<Point<2>>> &segments,
               const Tensor<1, 2> &normal)
    {
      const Tensor<1, 2> along = cross_product_2d(normal);
      std::vector<Point<2>> all;
      for (const auto &segment : segments)
        all.insert(all.end(), segment.begin(), segment.end());
      const auto ends =
        std::minmax_element(all.begin(),
                            all.end(),
                            [&along](const auto &a, const auto &b) {
                              return along * a < along * b;
                            });
      return {*ends.first, *ends.second};
    }

    /** The outer line around the largest part of faces on a plane. */
    std::vector<Point<3>>
    outline_of(const std::vector<std::vector<Point<3>>> &faces,
               const Tensor<1, 3> &)
    {
      TriangleSurface surface;
      std::vector<Point<3>> largest = faces[0];
      for (const auto &face : faces)
        for (unsigned int i = 1; i + 1 < face.size(); ++i)
          {
            const unsigned int n = surface.vertices.size();
            surface.vertices.insert(surface.vertices.end(),
                                    {face[0], face[i], face[i + 1]});
            surface.triangles.push_back({{n, n + 1, n + 2}});
          }
      surface.weld(same_point * size_of(surface.vertices));
      if (!surface.align().empty())
        return largest;
      for (const PlaneFace &face : list_faces(surface))
        if (!face.loops.empty())
          {
            const auto corners = corners_of(surface, face.loops[0]);
            if (measure_of(corners) > measure_of(largest))
              largest = corners;
          }
      return largest;
    }
  } // namespace



  template <int dim>
  std::vector<PlaneFacet<dim>>
  facets_of_faces(const std::vector<std::vector<Point<dim>>> &faces)
  {
    std::vector<Point<dim>> all;
    for (const auto &face : faces)
      all.insert(all.end(), face.begin(), face.end());
    const double size = size_of(all);
    std::vector<unsigned int> order(faces.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(),
                     order.end(),
                     [&faces](const unsigned int a, const unsigned int b) {
                       return measure_of(faces[a]) > measure_of(faces[b]);
                     });
    std::vector<Coplanar<dim>> planes;
    for (const unsigned int f : order)
      {
        if (!(measure_of(faces[f]) > 0.))
          throw std::runtime_error("it has a face without an area");
        const auto holds = [&](const Coplanar<dim> &plane) {
          return std::all_of(
            faces[f].begin(), faces[f].end(), [&](const Point<dim> &p) {
              return std::abs(plane.normal * (p - plane.point)) <=
                     in_plane * size;
            });
        };
        auto plane = std::find_if(planes.begin(), planes.end(), holds);
        if (plane == planes.end())
          plane = planes.insert(plane, {faces[f][0], normal_of(faces[f]), {}});
        plane->faces.push_back(f);
      }
    std::vector<PlaneFacet<dim>> facets;
    for (const Coplanar<dim> &plane : planes)
      {
        std::vector<std::vector<Point<dim>>> own;
        for (const unsigned int f : plane.faces)
          own.push_back(faces[f]);
        facets.push_back({outline_of(own, plane.normal), plane.normal});
      }
    return facets;
  }

  template std::vector<PlaneFacet<2>>
  facets_of_faces(const std::vector<std::vector<Point<2>>> &);
  template std::vector<PlaneFacet<3>>
  facets_of_faces(const std::vector<std::vector<Point<3>>> &);
} // namespace Keyblock
