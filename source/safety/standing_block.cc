// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/safety/block_statics.h>
#include <keyblock/safety/standing_block.h>

#include <boost/geometry.hpp>
#include <boost/geometry/geometries/multi_point.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>

#include <algorithm>

namespace Keyblock
{
  namespace
  {
    /** Factor from which on a block stands by itself, whatever the mesh does to
     * it [-]. */
    constexpr double clear_factor = 1.1;

    /** A resultant is taken to be so much further off the middle of the seat
     * than it is [-]. */
    constexpr double clear_seat = 1.1;

    /** The point of the line of the resultant that is nearest to the origin. */
    Point<2>
    foot_of_line(const Tensor<1, 2> &resultant,
                 const std::vector<PointForce<2>> &forces)
    {
      double moment = 0.;
      for (const PointForce<2> &f : forces)
        moment += f.place[0] * f.force[1] - f.place[1] * f.force[0];
      return moment / resultant.norm_square() *
             Point<2>(resultant[1], -resultant[0]);
    }

    Point<3>
    foot_of_line(const Tensor<1, 3> &resultant,
                 const std::vector<PointForce<3>> &forces)
    {
      Tensor<1, 3> moment;
      for (const PointForce<3> &f : forces)
        moment += cross_product_3d(f.place, f.force);
      return Point<3>(cross_product_3d(resultant, moment) /
                      resultant.norm_square());
    }

    /** Whether @p x lies between @p points, seen along @p line. */
    bool
    is_between(const std::vector<Point<2>> &points,
               const Point<2> &x,
               const Tensor<1, 2> &line)
    {
      const Tensor<1, 2> across({-line[1], line[0]});
      const auto is_beside = [&](const double sign) {
        return std::any_of(points.begin(), points.end(), [&](const auto &p) {
          return sign * (across * (p - x)) >= 0.;
        });
      };
      return is_beside(1.) && is_beside(-1.);
    }

    bool
    is_between(const std::vector<Point<3>> &points,
               const Point<3> &x,
               const Tensor<1, 3> &line)
    {
      namespace bg          = boost::geometry;
      using Flat            = bg::model::d2::point_xy<double>;
      unsigned int furthest = 0; // axis from the line
      for (unsigned int d = 1; d < 3; ++d)
        if (std::abs(line[d]) < std::abs(line[furthest]))
          furthest = d;
      Tensor<1, 3> axis;
      axis[furthest]          = 1.;
      const Tensor<1, 3> side = cross_product_3d(line, axis);
      const Tensor<1, 3> up   = cross_product_3d(line, side);
      bg::model::multi_point<Flat> seen;
      for (const Point<3> &p : points)
        bg::append(seen, Flat(side * (p - x), up * (p - x)));
      bg::model::polygon<Flat> hull;
      bg::convex_hull(seen, hull);
      return bg::covered_by(Flat(0., 0.), hull);
    }
  } // namespace



  template <int dim>
  bool
  is_seated(const std::vector<BlockFace<dim>> &faces,
            const std::set<unsigned int> &pressed,
            const std::vector<PointForce<dim>> &forces)
  {
    std::vector<Point<dim>> seat;
    for (const unsigned int i : pressed)
      seat.insert(seat.end(),
                  faces[i].vertices.begin(),
                  faces[i].vertices.end());
    const Tensor<1, dim> resultant = sum_of(forces);
    if (seat.empty() || resultant.norm() == 0.)
      return false;
    Tensor<1, dim> middle;
    for (const Point<dim> &v : seat)
      middle += v / static_cast<double>(seat.size());
    const Tensor<1, dim> off = foot_of_line(resultant, forces) - middle;
    return is_between(seat,
                      Point<dim>(middle + clear_seat * off),
                      resultant / resultant.norm());
  }



  template <int dim>
  bool
  stands_alone(const Ground<dim> &ground,
               const FreeFaces<dim> &free,
               const Blocks<dim> &blocks,
               const unsigned int block,
               const double time,
               const BrokenSegments &broken)
  {
    const BlockStatics<dim> statics =
      judge_block(ground, free, blocks, block, time, broken);
    const BlockSurroundings<dim> &around = statics.around;
    return statics.limit.factor >= clear_factor &&
           (statics.support.holds() ||
            is_seated(around.faces,
                      statics.limit.pressed_faces(around.faces,
                                                  around.loads.without_water()),
                      around.loads.all()));
  }

#define INSTANTIATE(dim)                                                       \
  template bool is_seated(const std::vector<BlockFace<dim>> &,                 \
                          const std::set<unsigned int> &,                      \
                          const std::vector<PointForce<dim>> &);               \
  template bool stands_alone(const Ground<dim> &,                              \
                             const FreeFaces<dim> &,                           \
                             const Blocks<dim> &,                              \
                             const unsigned int,                               \
                             const double,                                     \
                             const BrokenSegments &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock
