// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/blocks/bolt_pattern.h>

#include <keyblock/base/errors.h>
#include <keyblock/base/expression.h>
#include <keyblock/blocks/excavation_parts.h>
#include <keyblock/blocks/liner_layout.h>
#include <keyblock/blocks/section_outline.h>
#include <keyblock/scene/gravity.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Keyblock
{
  namespace
  {
    /** Distances around a closed row are larger than the spacing by no more
     * than this, so that chords of a circle count as the circle [-]. */
    constexpr double spacing_tolerance = 1e-3;

    /** Share of the area of an excavation's faces by which fewer have to face
     * one axis than another for it to be theirs [-]. */
    constexpr double equal_areas = 0.02;

    /** Where the plane of a ring cuts a face: nothing, or a piece. */
    void
    add_cut(const Mesh<3> &mesh,
            const CellFace &face,
            const Tensor<1, 3> &axis,
            const double place,
            Outline<3> &pieces)
    {
      const Tensor<1, 3> area = mesh.face_area_vector(face.cell, face.face);
      const auto vertices     = mesh.face_vertices(face.cell, face.face);
      // around the face, not in the order of its vertices
      const std::array<unsigned int, 4> around = {{0, 1, 3, 2}};
      std::vector<Point<3>> points;
      for (unsigned int i = 0; i < 4; ++i)
        {
          const Point<3> &a = mesh.vertices[vertices[around[i]]],
                         &b = mesh.vertices[vertices[around[(i + 1) % 4]]];
          const double u = a * axis - place, v = b * axis - place;
          if ((u > 0.) != (v > 0.))
            points.push_back(a + u / (u - v) * (b - a));
        }
      if (points.size() != 2 || points[0].distance(points[1]) == 0.)
        return;
      Tensor<1, 3> inward = -area / area.norm();
      inward -= (inward * axis) * axis;
      if (inward.norm() > 0.1) // not the end of a cavern
        pieces.push_back({points[0], points[1], inward / inward.norm(), {}});
    }

    /** Across the outline and up in its plane, that of @p axis: unit vectors,
     * as upward() is @p upward. Around a shaft the direction of y is up. */
    template <int dim>
    std::array<Tensor<1, dim>, 2>
    across_and_up(const Tensor<1, dim> &axis, const Tensor<1, dim> &upward)
    {
      Tensor<1, dim> across, up = upward;
      if constexpr (dim == 2)
        across = cross_product_2d(up);
      else
        {
          up -= (up * axis) * axis;
          if (up.norm() < 0.1)
            {
              up    = Tensor<1, dim>();
              up[1] = 1.;
              up -= (up * axis) * axis;
            }
          up /= up.norm();
          across = cross_product_3d(axis, up);
        }
      return {{across, up}};
    }

    /** Where the top of a closed row is, that above the middle between its
     * sides: distance along it [m]. */
    template <int dim>
    double
    place_of_crown(const Outline<dim> &row,
                   const Tensor<1, dim> &axis,
                   const Tensor<1, dim> &upward)
    {
      const auto [across, up] = across_and_up<dim>(axis, upward);
      double left             = std::numeric_limits<double>::max(),
             right            = std::numeric_limits<double>::lowest();
      for (const OutlinePiece<dim> &piece : row)
        {
          left  = std::min(left, piece.begin * across);
          right = std::max(right, piece.begin * across);
        }
      const double middle = 0.5 * (left + right);
      double place = 0., passed = 0.,
             highest = std::numeric_limits<double>::lowest();
      for (const OutlinePiece<dim> &piece : row)
        {
          const double here = piece.length(), a = piece.begin * across - middle,
                       b = piece.end * across - middle;
          if ((a > 0.) != (b > 0.))
            {
              const double share = a / (a - b);
              const double height =
                (piece.begin + share * (piece.end - piece.begin)) * up;
              if (height > highest)
                {
                  highest = height;
                  place   = passed + share * here;
                }
            }
          passed += here;
        }
      return place;
    }

    /**
     * Where the bolts of a row are: distances along it [m]. In a closed one
     * they are equally far from each other, no more than the @p spacing, from
     * the crown on; in an open one at the spacing, the first and the last as
     * far from its ends.
     */
    template <int dim>
    std::vector<double>
    places_along(const Outline<dim> &row,
                 const double spacing,
                 const Tensor<1, dim> &axis,
                 const Tensor<1, dim> &upward)
    {
      const double length  = length_of(row);
      const bool is_around = is_closed(row);
      std::vector<double> places(
        std::max(1.,
                 is_around
                   ? std::ceil((1. - spacing_tolerance) * length / spacing)
                   : std::floor(length / spacing + 1e-9)));
      const unsigned int n  = places.size();
      const double distance = is_around ? length / n : spacing,
                   first    = is_around ? place_of_crown<dim>(row, axis, upward)
                                        : 0.5 * (length - (n - 1) * spacing);
      for (unsigned int k = 0; k < n; ++k)
        {
          places[k] = first + k * distance;
          if (is_around && places[k] >= length)
            places[k] -= length;
        }
      return places;
    }

    /** The bolt of a set, @p index in Scene::bolts, with its head at a place.
     */
    template <int dim>
    Bolt<dim>
    bolt_at(const OutlinePlace<dim> &place,
            const BoltSet<dim> &set,
            const unsigned int index,
            const Tensor<1, dim> &axis)
    {
      const double angle = set.inclination * dealii::numbers::PI / 180.;
      Tensor<1, dim> across;
      if (dim == 2)
        {
          across[0] = -place.inward[1];
          across[1] = place.inward[0];
        }
      else
        across = axis;
      Tensor<1, dim> way =
        std::cos(angle) * place.inward + std::sin(angle) * across;
      if (set.direction.norm() > 0.)
        way = set.direction / set.direction.norm();
      return {index, place.point, place.point + set.length * way};
    }

    /** Direction along which faces lie, as those of a tunnel, cavern or shaft:
     * the one of the axes that fewest of them face; of several the longest
     * side, and one that is not upright. */
    template <int dim>
    Tensor<1, dim>
    axis_of(const BoltSet<dim> &set,
            const Mesh<dim> &mesh,
            const std::vector<CellFace> &faces,
            const Tensor<1, dim> &up)
    {
      if (set.axis.norm() > 0.)
        return set.axis / set.axis.norm();
      Point<dim> low  = mesh.face_center(faces[0].cell, faces[0].face),
                 high = low;
      Tensor<1, dim> facing; // area by the axis that it faces
      double area = 0.;
      for (const CellFace &f : faces)
        {
          const Tensor<1, dim> normal = mesh.face_area_vector(f.cell, f.face);
          area += normal.norm();
          for (unsigned int d = 0; d < dim; ++d)
            {
              const double x = mesh.face_center(f.cell, f.face)[d];
              low[d]         = std::min(low[d], x);
              high[d]        = std::max(high[d], x);
              facing[d] += std::abs(normal[d]);
            }
        }
      const double least =
        *std::min_element(facing.begin_raw(), facing.end_raw());
      unsigned int axis    = dim;
      const auto is_better = [&](const unsigned int d) {
        if (axis == dim)
          return true;
        const bool is_upright  = std::abs(up[d]) > 0.5,
                   was_upright = std::abs(up[axis]) > 0.5;
        return is_upright == was_upright
                 ? high[d] - low[d] > high[axis] - low[axis]
                 : was_upright;
      };
      for (unsigned int d = 0; d < dim; ++d)
        if (facing[d] <= least + equal_areas * area && is_better(d))
          axis = d;
      Tensor<1, dim> direction;
      direction[axis] = 1.;
      return direction;
    }

    template <int dim>
    std::vector<Outline<dim>>
    list_rings(const BoltSet<dim> &set,
               const Mesh<dim> &mesh,
               const std::vector<CellFace> &faces,
               const Tensor<1, dim> &axis)
    {
      std::vector<Outline<dim>> rings;
      if constexpr (dim == 2)
        {
          (void)axis;
          (void)set;
          rings.emplace_back();
          for (const CellFace &f : faces)
            {
              const auto v              = mesh.face_vertices(f.cell, f.face);
              const Tensor<1, dim> area = mesh.face_area_vector(f.cell, f.face);
              rings[0].push_back({mesh.vertices[v[0]],
                                  mesh.vertices[v[1]],
                                  -area / area.norm(),
                                  {}});
            }
        }
      else
        {
          double low = 1e300, high = -1e300;
          for (const CellFace &f : faces)
            for (const unsigned int v : mesh.face_vertices(f.cell, f.face))
              {
                low  = std::min(low, mesh.vertices[v] * axis);
                high = std::max(high, mesh.vertices[v] * axis);
              }
          const unsigned int n =
            std::max(1., std::floor((high - low) / set.spacing[1] + 1e-9));
          const double first =
            low + 0.5 * (high - low - (n - 1) * set.spacing[1]);
          for (unsigned int k = 0; k < n; ++k)
            {
              rings.emplace_back();
              for (const CellFace &f : faces)
                add_cut(
                  mesh, f, axis, first + k * set.spacing[1], rings.back());
            }
        }
      return rings;
    }

  } // namespace



  template <int dim>
  std::vector<Bolt<dim>>
  set_out_pattern(const BoltSet<dim> &set,
                  const unsigned int index,
                  const Ground<dim> &ground)
  {
    const std::vector<CellFace> faces =
      list_excavation_faces(ground, set.excavations);
    std::vector<Bolt<dim>> pattern;
    if (!faces.empty())
      {
        const Mesh<dim> &mesh     = ground.split.mesh;
        const Tensor<1, dim> up   = upward(ground.scene);
        const Tensor<1, dim> axis = axis_of(set, mesh, faces, up);
        for (const Outline<dim> &ring : list_rings(set, mesh, faces, axis))
          for (const Outline<dim> &row : select_from_rows(
                 put_in_rows(ring, axis), [&](const OutlinePiece<dim> &piece) {
                   return is_of_parts<dim>(piece.inward, up, set.parts);
                 }))
            for (const double place :
                 places_along<dim>(row, set.spacing[0], axis, up))
              pattern.push_back(
                bolt_at(place_on(row, place), set, index, axis));
      }
    if (!set.region.empty())
      {
        const Expression<dim> inside(set.region,
                                     1,
                                     "Bolts/" + set.name + "/Region");
        pattern.erase(std::remove_if(pattern.begin(),
                                     pattern.end(),
                                     [&](const Bolt<dim> &bolt) {
                                       return inside.value(bolt.head, 0., 0) <=
                                              0.;
                                     }),
                      pattern.end());
      }
    AssertThrow(!pattern.empty(),
                InputError("The bolts 'Bolts/" + set.name +
                           "' have no place: after stage '" + set.stage +
                           "' there is no free face of their excavations, "
                           "'Parts' and 'Region'; correct these, or their "
                           "'Stage'."));
    return pattern;
  }


  template std::vector<Bolt<2>>
  set_out_pattern(const BoltSet<2> &, const unsigned int, const Ground<2> &);
  template std::vector<Bolt<3>>
  set_out_pattern(const BoltSet<3> &, const unsigned int, const Ground<3> &);
} // namespace Keyblock
