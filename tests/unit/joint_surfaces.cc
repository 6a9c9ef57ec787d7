// SPDX-License-Identifier: LGPL-2.1-or-later
// Bent joints: facets of lines and triangles; sides, distances and crossings of
// sheets against a search over all facets.
#include "world.h"

#include <boost/test/unit_test.hpp>

#include <keyblock/mesh/joint_sheet.h>
#include <keyblock/scene/dxf.h>
#include <keyblock/scene/joint_facets.h>
#include <keyblock/scene/plane_facets.h>

#include <cmath>
#include <random>
#include <stdexcept>

BOOST_AUTO_TEST_SUITE(joint_surfaces)

using namespace Keyblock;

namespace
{
  /** A grid of 2 n^2 triangles over [0, n]^2 whose heights are @p height. */
  template <typename Height>
  TriangleSurface
  grid(const unsigned int n, const Height &height)
  {
    TriangleSurface surface;
    for (unsigned int j = 0; j <= n; ++j)
      for (unsigned int i = 0; i <= n; ++i)
        surface.vertices.emplace_back(i, j, height(i, j));
    for (unsigned int j = 0; j < n; ++j)
      for (unsigned int i = 0; i < n; ++i)
        {
          const unsigned int v = j * (n + 1) + i;
          // (every second one turned: files do not care)
          surface.triangles.push_back({{v, v + 1, v + n + 2}});
          surface.triangles.push_back({{v + n + 2, v, v + n + 1}});
          if ((i + j) % 2 == 0)
            std::swap(surface.triangles.back()[0], surface.triangles.back()[1]);
        }
    return surface;
  }

  template <int dim>
  void
  put(Scene<dim> &scene, const std::vector<PlaneFacet<dim>> &facets)
  {
    for (const PlaneFacet<dim> &facet : facets)
      {
        scene.joints.push_back(std::make_unique<Joint<dim>>());
        Joint<dim> &joint = *scene.joints.back();
        joint.extent      = JointShape::polygon;
        joint.vertices    = facet.corners;
        joint.surface     = "fault";
        if (dim == 3)
          joint.normal_entry.assign(facet.normal.begin_raw(),
                                    facet.normal.end_raw());
      }
  }
} // namespace



BOOST_AUTO_TEST_CASE(straight_parts_of_lines)
{
  const auto facets = facets_of_paths(
    {{Point<2>(0, 0), Point<2>(1, 0), Point<2>(1, 0), Point<2>(3, 0)},
     {Point<2>(3, 1e-12), Point<2>(4, 2)}});
  BOOST_REQUIRE_EQUAL(facets.size(), 2);
  BOOST_TEST(facets[0].corners[1] == Point<2>(3, 0));
  BOOST_TEST(facets[1].corners[0] == Point<2>(3, 0));
  BOOST_CHECK_THROW(facets_of_paths({{Point<2>(1, 1), Point<2>(1, 1)}}),
                    std::runtime_error);
  BOOST_CHECK_THROW(
    facets_of_paths(
      {{Point<2>(0, 0), Point<2>(2, 0), Point<2>(2, 1), Point<2>(1, -1)}}),
    std::runtime_error);
}



// Lines in a drawing: what two of them meet in goes on, a fork does not.
BOOST_AUTO_TEST_CASE(pieces_of_a_drawing)
{
  const Point<2> a(0, 0), b(2, 1), c(4, 0), d(3, 3), e(1, 5);
  const auto pieces = pieces_of_paths(
    {{a, b}, {Point<2>(0, 1), Point<2>(4, 1)}, {c, Point<2>(2, 1 + 1e-12)}});
  BOOST_REQUIRE_EQUAL(pieces.size(), 2);
  BOOST_TEST(pieces[0].size() == 2);
  BOOST_TEST(pieces[0][1][0] == c);
  BOOST_TEST(pieces[1].size() == 1);
  BOOST_TEST(pieces_of_paths({{a, b}, {b, c}, {b, d}}).size() == 3);
  BOOST_TEST(pieces_of_paths({{a, d, e}, {e, c}, {c, a}}).size() == 1);
  BOOST_TEST(pieces_of_paths({{a, d, e, a}}).size() == 1);
}



BOOST_AUTO_TEST_CASE(plane_parts_of_triangles)
{
  // a fold along x = 2, in the precision of an STL file
  const auto fold = [](const double x, const double y) {
    return double(float(0.3 * y + (x > 2. ? 0.7 * (x - 2.) : -0.1 * (x - 2.))));
  };
  const auto facets = facets_of_triangles(grid(4, fold));
  BOOST_REQUIRE_EQUAL(facets.size(), 2);
  for (const auto &facet : facets)
    {
      BOOST_TEST(facet.corners.size() == 4);
      for (const Point<3> &p : facet.corners)
        BOOST_TEST(std::abs(facet.normal * (p - facet.corners[0])) < 1e-8);
    }
  unsigned int n_shared = 0;
  for (const Point<3> &p : facets[0].corners)
    for (const Point<3> &q : facets[1].corners)
      n_shared += p == q;
  BOOST_TEST(n_shared == 2);

  // a hole: its triangles remain
  TriangleSurface plate = grid(3, [](double, double) { return 0.; });
  plate.triangles.erase(plate.triangles.begin() + 8,
                        plate.triangles.begin() + 10);
  BOOST_TEST(facets_of_triangles(plate).size() == 16);
  plate.triangles.push_back({{0, 1, 2}});
  BOOST_CHECK_THROW(facets_of_triangles(plate), std::runtime_error);
}



BOOST_AUTO_TEST_CASE(faces_in_one_plane)
{
  const std::vector<std::vector<Point<2>>> faces = {
    {Point<2>(0, 0), Point<2>(1, 0)},
    {Point<2>(2, 0), Point<2>(1, 0)},
    {Point<2>(2, 0), Point<2>(3, 4)}};
  const auto facets = facets_of_faces(faces);
  BOOST_REQUIRE_EQUAL(facets.size(), 2);
  BOOST_TEST(facets[1].corners[0].distance(facets[1].corners[1]) == 2.);
}



BOOST_AUTO_TEST_CASE(faces_of_drawings)
{
  const std::string head   = "0\nSECTION\n2\nENTITIES\n0\n3DFACE\n",
                    first  = "10\n0\n20\n0\n30\n0\n11\n2\n21\n0\n31\n0\n",
                    third  = "12\n2\n22\n2\n32\n1\n",
                    fourth = "13\n0\n23\n2\n33\n1\n",
                    end    = "0\nENDSEC\n0\nEOF\n";
  const auto surface = read_dxf_faces(head + first + third + fourth + end);
  BOOST_TEST(surface.triangles.size() == 2);
  BOOST_TEST(surface.vertices.size() == 4);
  BOOST_TEST(read_dxf_faces(head + first + third + end).triangles.size() == 1);
  BOOST_CHECK_THROW(read_dxf_faces(head + first + end), std::runtime_error);
}



BOOST_AUTO_TEST_CASE(sides_of_a_kinked_line)
{
  // the roof of a house, which passes the vertical at its left end
  const std::vector<Point<2>> line = {Point<2>(-2, -1),
                                      Point<2>(-3, 1),
                                      Point<2>(0, 3),
                                      Point<2>(4, 1)};
  Scene<2> scene;
  put(scene, facets_of_paths({line}));
  const JointSheet<2> sheet(scene, joints_by_surface(scene).at(0));
  BOOST_REQUIRE_EQUAL(sheet.facets.size(), 3);
  const double outside = sheet.distance(Point<2>(0, 5));
  BOOST_TEST(std::abs(outside) == 2.);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> number(0., 1.);
  unsigned int n_inside = 0;
  for (unsigned int i = 0; i < 2000; ++i)
    {
      const Point<2> p(-3.5 + 8. * number(random), -0.5 + 5. * number(random));
      double least = 1e300;
      for (unsigned int k = 0; k < 3; ++k)
        {
          const Tensor<1, 2> way = line[k + 1] - line[k];
          const double s =
            std::clamp(way * (p - line[k]) / way.norm_square(), 0., 1.);
          least = std::min(least, p.distance(line[k] + s * way));
        }
      // below all three lines, to the right of the first
      const bool is_inside = 2. * (p[0] + 2.) + (p[1] + 1.) > 0. &&
                             p[1] < 1. + 2. / 3. * (p[0] + 3.) &&
                             p[1] < 3. - 0.5 * p[0];
      if (p[1] > 0.4 + p[0]) // (not beyond the right end)
        {
          BOOST_TEST(std::abs(std::abs(sheet.distance(p)) - least) < 1e-12);
          BOOST_TEST((sheet.distance(p) * outside < 0.) == is_inside);
          n_inside += is_inside;
        }
    }
  BOOST_TEST(n_inside > 100);
  const Point<2> below(0, 1), above(0.5, 4);
  const double part =
    sheet.crossing(below, above, sheet.distance(below), sheet.distance(above));
  const Point<2> place = below + part * (above - below);
  BOOST_TEST(std::abs(sheet.distance(place)) < 1e-12);
  BOOST_TEST(sheet.depth_inside(Point<2>(1, 2.5)) > 0.);
  BOOST_TEST(sheet.depth_inside(Point<2>(6, 0)) < 0.);
}



BOOST_AUTO_TEST_CASE(sides_of_a_rough_surface)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> number(0., 1.);
  TriangleSurface surface =
    grid(6, [&](double, double) { return number(random); });
  Scene<3> scene;
  put(scene, facets_of_triangles(surface));
  const JointSheet<3> sheet(scene, joints_by_surface(scene).at(0));
  BOOST_REQUIRE_EQUAL(sheet.facets.size(), 72);
  const double up = sheet.distance(Point<3>(3, 3, 9)) > 0. ? 1. : -1.;
  for (unsigned int i = 0; i < 2000; ++i)
    {
      const double x = 6. * number(random), y = 6. * number(random),
                   z = -1. + 3. * number(random);
      // the height of the surface there
      const unsigned int a = std::min(5., x), b = std::min(5., y),
                         v = 7 * b + a;
      const double u = x - a, w = y - b;
      const auto h = [&](const unsigned int n) {
        return surface.vertices[n][2];
      };
      const double height =
        u > w ? h(v) + u * (h(v + 1) - h(v)) + w * (h(v + 8) - h(v + 1))
              : h(v) + w * (h(v + 7) - h(v)) + u * (h(v + 8) - h(v + 7));
      if (std::abs(z - height) < 1e-6)
        continue;
      const double distance = sheet.distance(Point<3>(x, y, z));
      BOOST_TEST((up * distance > 0.) == (z > height));
      BOOST_TEST(std::abs(distance) <= std::abs(z - height) + 1e-12);
    }
  BOOST_TEST(std::abs(sheet.depth_inside(Point<3>(3, 3, 0.5)) - 3.) < 0.6);
  BOOST_TEST(sheet.depth_inside(Point<3>(8, 3, 0.5)) < -1.);
}

BOOST_AUTO_TEST_SUITE_END()
