// SPDX-License-Identifier: LGPL-2.1-or-later
// Convex cells between planes: as many as planes, lines and points inside make,
// and sound where planes coincide, nearly coincide or meet in one point.
#include "random_tensor.h"

#include <boost/test/unit_test.hpp>

#include <keyblock/base/errors.h>
#include <keyblock/blocks/convex_cells.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

BOOST_AUTO_TEST_SUITE(convex_cells)

using namespace Keyblock;

namespace
{
  /** A disc (in 2D a segment) with a plane; without a radius the whole plane.
   */
  template <int dim>
  struct Disc
  {
    Point<dim> center; ///< in units
    double radius;

    bool
    reaches(const ExactPlane<dim> &plane, const int side) const
    {
      return radius == 0. || side * plane.distance(center) >= -radius;
    }
    bool
    enters(const unsigned int) const
    {
      return true;
    }
    bool
    overlaps(const std::vector<Point<dim>> &) const
    {
      return true;
    }
  };

  /** Length of a segment or area of a polygon, in units. */
  template <int dim>
  double
  area_of(const typename ConvexCells<dim>::Polygon &polygon)
  {
    if constexpr (dim == 2)
      return polygon[0].vertex.x.distance(polygon[1].vertex.x);
    else
      {
        Tensor<1, dim> sum;
        for (unsigned int i = 2; i < polygon.size(); ++i)
          sum += cross_product_3d(polygon[i - 1].vertex.x - polygon[0].vertex.x,
                                  polygon[i].vertex.x - polygon[0].vertex.x);
        return 0.5 * sum.norm();
      }
  }

  /** Cells are convex without error, have the topology of a ball, and fill the
   * domain; facets of a cut are all shared. */
  template <int dim>
  void
  check(const ConvexCells<dim> &cells, const double volume)
  {
    std::vector<ExactPlane<dim>> planes;
    for (unsigned int p = 0; p < cells.n_planes(); ++p)
      planes.push_back(cells.plane(p));
    double sum = 0.;
    for (unsigned int c = 0; c < cells.n_cells(); ++c)
      {
        const auto &cell = cells.cell(c);
        if (dim == 2)
          {
            BOOST_TEST_REQUIRE(cell.vertices.size() == cell.facets.size());
            for (const auto &facet : cell.facets)
              BOOST_TEST_REQUIRE(facet.size == 2u);
          }
        else
          BOOST_TEST_REQUIRE(cell.vertices.size() + cell.facets.size() ==
                             cell.loops.size() / 2 + 2);
        for (const auto &facet : cell.facets)
          {
            for (const auto &vertex : cell.vertices)
              BOOST_TEST_REQUIRE(
                side_of(planes, vertex, facet.plane) * facet.side >= 0);
            for (unsigned int i = facet.begin; i < facet.begin + facet.size;
                 ++i)
              BOOST_TEST_REQUIRE(side_of(planes,
                                         cell.vertices[cell.loops[i].vertex],
                                         facet.plane) == 0);
          }
        sum += cells.measures(c).volume;
      }
    BOOST_TEST_REQUIRE(std::abs(sum - volume) <= 1e-14 * volume);
    // areas of contacts and of facets on each side of the planes
    std::map<unsigned int, std::array<double, 3>> areas;
    for (unsigned int c = 0; c < cells.n_cells(); ++c)
      for (const auto &facet : cells.cell(c).facets)
        if (facet.node != cells.nothing)
          areas[facet.plane][facet.side > 0] +=
            area_of<dim>(cells.polygon_of(cells.cell(c), facet));
    cells.for_each_contact([&](const auto &contact) {
      areas[contact.plane][2] += area_of<dim>(contact.polygon);
      const auto on_side = [&](const unsigned int cell, const int side) {
        const auto &facets = cells.cell(cell).facets;
        return std::any_of(facets.begin(), facets.end(), [&](const auto &f) {
          return f.plane == contact.plane && f.side == side;
        });
      };
      BOOST_TEST_REQUIRE(on_side(contact.minus, -1));
      BOOST_TEST_REQUIRE(on_side(contact.plus, +1));
    });
    for (const auto &[plane, area] : areas)
      for (const double other : {area[1], area[2]})
        BOOST_TEST_REQUIRE(std::abs(other - area[0]) <=
                           1e-13 * std::max(1., area[0]));
  }

  /** Part of the line p + t u, t in [from, to], within the box [-1, 1]; empty
   * if from >= to. */
  template <int dim>
  void
  clip_to_box(const Point<dim> &p,
              const Tensor<1, dim> &u,
              double &from,
              double &to)
  {
    for (unsigned int d = 0; d < dim; ++d)
      {
        const double a = (-1. - p[d]) / u[d], b = (1. - p[d]) / u[d];
        from = std::max(from, std::min(a, b));
        to   = std::min(to, std::max(a, b));
      }
  }

  /** Regions into which planes divide the box [-1, 1]: one, and one more for
   * each plane, line of two planes and point of three within it. */
  template <int dim>
  unsigned int
  n_regions(const std::vector<ExactPlane<dim>> &planes)
  {
    unsigned int n       = 1;
    const auto is_inside = [](const Point<dim> &p) {
      for (unsigned int d = 0; d < dim; ++d)
        if (std::abs(p[d]) >= 1.)
          return false;
      return true;
    };
    for (unsigned int i = 0; i < planes.size(); ++i)
      {
        n += planes[i].meets_box();
        for (unsigned int j = 0; j < i; ++j)
          if constexpr (dim == 2)
            n += is_inside(intersect<dim>(planes, {{i, j}}).x);
          else
            {
              const Tensor<1, dim> u =
                cross_product_3d(planes[i].normal, planes[j].normal);
              const Point<dim> p(
                cross_product_3d(planes[j].offset * planes[i].normal -
                                   planes[i].offset * planes[j].normal,
                                 u) /
                u.norm_square());
              double from = -1e9, to = 1e9;
              clip_to_box<dim>(p, u, from, to);
              n += from < to;
              for (unsigned int k = 0; k < j; ++k)
                n += is_inside(intersect<dim>(planes, {{i, j, k}}).x);
            }
      }
    return n;
  }

  /** The box [-1, 1]. */
  template <int dim>
  BoundingBox<dim>
  unit_box()
  {
    Point<dim> corner;
    for (unsigned int d = 0; d < dim; ++d)
      corner[d] = 1.;
    return BoundingBox<dim>({-corner, corner});
  }

  template <int dim>
  void
  compare_region_counts(const unsigned int n_sets, const unsigned int n_planes)
  {
    std::mt19937 random(7 * dim);
    unsigned int largest = 0;
    for (unsigned int set = 0; set < n_sets; ++set)
      {
        ConvexCells<dim> cells(unit_box<dim>());
        std::vector<ExactPlane<dim>> planes;
        const unsigned int n = 3 + random() % n_planes;
        for (unsigned int i = 0; i < n; ++i)
          {
            const auto plane =
              cells.add_plane(Point<dim>(random_tensor<dim>(random)),
                              random_tensor<dim>(random));
            planes.push_back(cells.plane(plane.plane));
            cells.cut(plane.plane, Disc<dim>{{}, 0.});
          }
        BOOST_TEST(cells.n_cells() == n_regions(planes));
        largest = std::max(largest, cells.n_cells());
        check(cells, std::pow(2., dim));
      }
    BOOST_TEST_MESSAGE(dim << "D: up to " << largest << " regions");
  }

  /** A network in a box of 10 m: planes and discs, many of them the same as one
   * before but for a shift or a turn, or through one point, or on a side. */
  template <int dim>
  void
  cut_spoilt_network(std::mt19937 &random)
  {
    const Point<dim> low(5. * random_tensor<dim>(random));
    Point<dim> high = low;
    for (unsigned int d = 0; d < dim; ++d)
      high[d] += 10.;
    ConvexCells<dim> cells(BoundingBox<dim>({low, high}));
    const Point<dim> middle = low + 0.5 * (high - low),
                     common = middle + 2. * random_tensor<dim>(random);
    std::vector<std::pair<Point<dim>, Tensor<1, dim>>> old;
    const auto place = [&]() {
      return middle + 5. * random_tensor<dim>(random);
    };
    for (unsigned int i = 0; i < 12; ++i)
      {
        std::pair<Point<dim>, Tensor<1, dim>> plane(place(),
                                                    random_tensor<dim>(random));
        const double small     = std::pow(10., -6. - double(random() % 11));
        const unsigned int how = random() % 8;
        if (how == 0)
          plane.first = common;
        else if (how == 1) // a side of the domain, or parallel to it
          {
            plane.second = Point<dim>::unit_vector(random() % dim);
            if (random() % 2 == 0)
              plane.first = random() % 2 == 0 ? low : high;
          }
        else if (how < 6 && !old.empty())
          {
            plane = old[random() % old.size()];
            if (how == 2)
              plane.first += small * random_tensor<dim>(random);
            else if (how == 3)
              plane.second += 1e3 * small * random_tensor<dim>(random);
            else if (how == 4)
              plane.second = -3. * plane.second;
            else if (old.size() > 1) // through the line of two others
              plane.second += old[random() % old.size()].second;
          }
        old.push_back(plane);
        const auto index = cells.add_plane(plane.first, plane.second);
        if (index.plane == cells.nothing)
          continue;
        const double radius =
          random() % 3 == 0 ? 0. : 0.2 + 0.1 * (random() % 8);
        cells.cut(index.plane, Disc<dim>{cells.to_unit(plane.first), radius});
      }
    check(cells, std::pow(10., dim));
    // its centroid is inside a cell, if it is not thinner than rounding
    for (unsigned int c = 0; c < cells.n_cells(); ++c)
      if (cells.measures(c).volume > 1e-3)
        BOOST_TEST_REQUIRE(cells.cell_at(cells.measures(c).centroid) == c);
  }
} // namespace

BOOST_AUTO_TEST_CASE(as_many_as_planes_lines_and_points)
{
  compare_region_counts<2>(20, 20);
  compare_region_counts<3>(12, 10);
}

BOOST_AUTO_TEST_CASE(spoilt_networks)
{
  std::mt19937 random(5);
  for (unsigned int i = 0; i < 40; ++i)
    {
      cut_spoilt_network<2>(random);
      cut_spoilt_network<3>(random);
    }
}

// Planes that meet in one point and in common lines without error, and others
// parallel to the sides: cuts go through vertices of polygons.
BOOST_AUTO_TEST_CASE(planes_through_one_point)
{
  std::mt19937 random(3);
  const auto step = [&](const int most) {
    return double(int(random() % (2 * most + 1)) - most);
  };
  unsigned int n_touched = 0;
  for (unsigned int i = 0; i < 25; ++i)
    {
      ConvexCells<3> cells(unit_box<3>());
      for (unsigned int j = 0; j < 16; ++j)
        {
          Point<3> normal(step(1), step(1), step(1)), point;
          if (normal.norm() == 0.)
            continue;
          if (std::abs(normal[0]) + std::abs(normal[1]) + std::abs(normal[2]) ==
              1.)
            point = 0.25 * step(2) * normal;
          const auto plane = cells.add_plane(point, normal).plane;
          const Point<3> at(0.25 * Point<3>(step(4), step(4), step(4)));
          cells.cut(plane, Disc<3>{at, 0.5});
        }
      check(cells, 8.);
      std::vector<ExactPlane<3>> planes;
      for (unsigned int p = 0; p < cells.n_planes(); ++p)
        planes.push_back(cells.plane(p));
      for (unsigned int c = 0; c < cells.n_cells(); ++c)
        for (const auto &vertex : cells.cell(c).vertices)
          for (unsigned int p = 0; p < planes.size(); ++p)
            n_touched += side_by_integers(planes, vertex, p) == 0;
    }
  BOOST_TEST(n_touched > 1000u);
}

BOOST_AUTO_TEST_CASE(one_plane_twice)
{
  ConvexCells<3> cells(BoundingBox<3>({{1., 2., 3.}, {4., 4., 4.}}));
  const auto a = cells.add_plane({2., 3., 3.}, Point<3>(1., 0., 0.)),
             b = cells.add_plane({2., 4., 3.}, Point<3>(-7., 0., 0.)),
             c = cells.add_plane({1., 4., 3.}, Point<3>(1., 0., 0.)),
             d = cells.add_plane({0., 4., 3.}, Point<3>(1., 0., 0.));
  BOOST_TEST(a.plane == b.plane);
  BOOST_TEST(a.side == 1);
  BOOST_TEST(b.side == -1);
  BOOST_TEST(c.plane != cells.nothing); // a side of the box
  BOOST_TEST(cells.cut_cell(0, a.plane) == 1u);
  BOOST_TEST(cells.cut_cell(0, a.plane) == cells.nothing);
  BOOST_TEST(cells.cut_cell(1, c.plane) == cells.nothing);
  BOOST_TEST(cells.measures(0).volume == 4.,
             boost::test_tools::tolerance(1e-14));
  BOOST_TEST(cells.measures(1).volume == 2.,
             boost::test_tools::tolerance(1e-14));
  BOOST_TEST(cells.measures(1).centroid.distance({1.5, 3., 3.5}) < 1e-14);
  BOOST_TEST(d.plane == cells.nothing); // outside
  BOOST_TEST(d.side == 1);
}

BOOST_AUTO_TEST_CASE(domain_of_half_spaces)
{
  const BoundingBox<2> box({{0., 0.}, {10., 10.}});
  const std::vector<HalfSpace<2>> triangle = {{{1., 1.}, Point<2>(0., -1.)},
                                              {{1., 1.}, Point<2>(-2., 0.)},
                                              {{4., 1.}, Point<2>(4., 3.)},
                                              {{0., 9.}, Point<2>(0., 1.)}};
  const ConvexCells<2> cells(box, triangle);
  BOOST_TEST(cells.n_cells() == 1u);
  BOOST_TEST(cells.measures(0).volume == 6.,
             boost::test_tools::tolerance(1e-14));
  BOOST_TEST(cells.measures(0).centroid.distance({2., 1. + 4. / 3.}) < 1e-14);
  BOOST_TEST(cells.cell(0).facets.size() == 3u);
  for (const auto &facet : cells.cell(0).facets)
    {
      BOOST_TEST_REQUIRE(facet.domain_side < 3u);
      const auto &side = triangle[facet.domain_side];
      for (const auto &corner : cells.polygon_of(cells.cell(0), facet))
        BOOST_TEST(std::abs(side.outward * (cells.to_metres(corner.vertex.x) -
                                            side.point)) < 1e-13);
    }
  // one side is not there; nothing is left
  auto sides = triangle;
  sides.erase(sides.begin() + 1);
  BOOST_CHECK_THROW(ConvexCells<2>(box, sides), InputError);
  sides = triangle;
  sides.push_back({{5., 0.}, Point<2>(-1., 0.)});
  BOOST_CHECK_THROW(ConvexCells<2>(box, sides), InputError);
  sides.push_back({{500., 0.}, Point<2>(-1., 0.)});
  BOOST_CHECK_THROW(ConvexCells<2>(box, sides), InputError);
}

BOOST_AUTO_TEST_SUITE_END()
