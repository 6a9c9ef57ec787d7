// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/safety/block_rotation.h>

#include <boost/geometry.hpp>
#include <boost/geometry/geometries/multi_point.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>

#include <algorithm>
#include <cmath>

namespace Keyblock
{
  namespace
  {
    /** Lengths over the size of the base that count as zero [-]. */
    constexpr double tolerance = 1e-6;

    /** The base of a block: its vertices and its plane. */
    template <int dim>
    struct Base
    {
      std::vector<Point<dim>> vertices;
      Tensor<1, dim> inward;
      double size = 0.; ///< largest distance from the first vertex [m]

      Base(const std::vector<BlockFace<dim>> &faces,
           const LimitEquilibrium<dim> &limit)
        : inward(faces[limit.faces[0]].inward)
      {
        for (unsigned int i = 0; i < limit.n_pressed; ++i)
          {
            const auto &more = faces[limit.faces[i]].vertices;
            vertices.insert(vertices.end(), more.begin(), more.end());
          }
        for (const Point<dim> &v : vertices)
          size = std::max(size, v.distance(vertices[0]));
      }

      /** Whether all vertices lie on one plane; a bent or stepped base is not
       * judged. */
      bool
      is_plane() const
      {
        return !vertices.empty() &&
               std::all_of(vertices.begin(),
                           vertices.end(),
                           [&](const Point<dim> &v) {
                             return std::abs(inward * (v - vertices[0])) <=
                                    tolerance * size;
                           });
      }
    };

    double
    cross(const Tensor<1, 2> &a, const Tensor<1, 2> &b)
    {
      return a[0] * b[1] - a[1] * b[0];
    }

    /** Why a turn about @p end with the sense @p sign (counter-clockwise: 1) is
     * not free; empty: it is. */
    std::string
    find_obstacle(const std::vector<BlockFace<2>> &faces,
                  const LimitEquilibrium<2> &limit,
                  const Point<2> &end,
                  const double sign)
    {
      for (unsigned int i = 0; i < limit.n_pressed; ++i)
        if (faces[limit.faces[i]].tensile_strength > 0.)
          return "tensile strength of " + faces[limit.faces[i]].name;
      if (limit.faces.size() > limit.n_pressed)
        return "cohesion of " + faces[limit.faces[limit.n_pressed]].name;
      const auto is_pressed = [&](const BlockFace<2> &face) {
        for (unsigned int i = 0; i < limit.n_pressed; ++i)
          if (&face == &faces[limit.faces[i]])
            return true;
        return false;
      };
      for (const BlockFace<2> &face : faces)
        if (!is_pressed(face))
          for (const Point<2> &v : face.vertices)
            {
              const Tensor<1, 2> arm = v - end;
              const Tensor<1, 2> way({-sign * arm[1], sign * arm[0]});
              if (way * face.inward < -tolerance * arm.norm())
                return face.name;
            }
      return "";
    }

    Rotation
    judge(const std::vector<BlockFace<2>> &faces,
          const std::vector<PointForce<2>> &forces,
          const Base<2> &base,
          LimitEquilibrium<2> &limit)
    {
      Rotation rotation;
      const Tensor<1, 2> along = limit.direction;
      const Point<2> &origin   = base.vertices[0];
      Tensor<1, 2> resultant;
      double moment = 0.;
      for (const PointForce<2> &f : forces)
        {
          resultant += f.force;
          moment += cross(f.place - origin, f.force);
        }
      const double place = moment / cross(along, resultant);
      std::array<Point<2>, 2> ends{{origin, origin}};
      for (const Point<2> &v : base.vertices)
        {
          if (along * (v - ends[0]) < 0.)
            ends[0] = v;
          if (along * (v - ends[1]) > 0.)
            ends[1] = v;
        }
      const double before = along * (ends[0] - origin) - place,
                   beyond = place - along * (ends[1] - origin);
      rotation.is_judged  = true;
      rotation.outside    = std::max({0., before, beyond});
      if (rotation.outside <= tolerance * base.size)
        {
          rotation.outside = 0.;
          return rotation;
        }
      // the resultant presses, so it turns the block about the end as it would
      // turn the way to its own place
      const Point<2> &end = ends[beyond > 0.];
      const double sign =
        cross(beyond > 0. ? along : -along, resultant) > 0. ? 1. : -1.;
      rotation.obstacle = find_obstacle(faces, limit, end, sign);
      if (rotation.obstacle.empty())
        {
          limit.mode   = LimitEquilibrium<2>::Mode::rotating;
          limit.factor = 0.;
        }
      return rotation;
    }

    Rotation
    judge(const std::vector<BlockFace<3>> &,
          const std::vector<PointForce<3>> &forces,
          const Base<3> &base,
          const LimitEquilibrium<3> &limit)
    {
      namespace bg = boost::geometry;
      using Flat   = bg::model::d2::point_xy<double>;
      Rotation rotation;
      const Point<3> &origin = base.vertices[0];
      Tensor<1, 3> resultant, moment;
      for (const PointForce<3> &f : forces)
        {
          resultant += f.force;
          moment += cross_product_3d(f.place - origin, f.force);
        }
      const Tensor<1, 3> place =
        cross_product_3d(base.inward, moment) / (base.inward * resultant);
      const Tensor<1, 3> side = cross_product_3d(base.inward, limit.direction);
      const auto flat         = [&](const Tensor<1, 3> &x) {
        return Flat(x * limit.direction, x * side);
      };
      bg::model::multi_point<Flat> points;
      for (const Point<3> &v : base.vertices)
        bg::append(points, flat(v - origin));
      bg::model::polygon<Flat> hull;
      bg::convex_hull(points, hull);
      rotation.is_judged = true;
      rotation.outside   = bg::distance(flat(place), hull);
      if (rotation.outside <= tolerance * base.size)
        rotation.outside = 0.;
      return rotation;
    }
  } // namespace



  template <int dim>
  Rotation
  judge_rotation(const std::vector<BlockFace<dim>> &faces,
                 const std::vector<PointForce<dim>> &forces,
                 LimitEquilibrium<dim> &limit)
  {
    if (limit.mode != LimitEquilibrium<dim>::Mode::one_plane)
      return {};
    const Base<dim> base(faces, limit);
    if (!base.is_plane())
      return {};
    return judge(faces, forces, base, limit);
  }

  template Rotation judge_rotation(const std::vector<BlockFace<2>> &,
                                   const std::vector<PointForce<2>> &,
                                   LimitEquilibrium<2> &);
  template Rotation judge_rotation(const std::vector<BlockFace<3>> &,
                                   const std::vector<PointForce<3>> &,
                                   LimitEquilibrium<3> &);
} // namespace Keyblock
