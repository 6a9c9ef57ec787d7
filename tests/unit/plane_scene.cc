// SPDX-License-Identifier: LGPL-2.1-or-later
// The planes of scenes: blocks that are known by hand, in domains and
// excavations of every shape.
#include "world.h"

#include <boost/test/unit_test.hpp>

#include <keyblock/blocks/plane_scene.h>
#include <keyblock/blocks/solid_parts.h>
#include <keyblock/scene/polygon.h>
#include <keyblock/scene/solid.h>

#include <cmath>
#include <fstream>
#include <iomanip>
#include <random>

BOOST_AUTO_TEST_SUITE(plane_scene)

using namespace Keyblock;

namespace
{
  constexpr double radian = dealii::numbers::PI / 180.;

  template <int dim>
  std::variant<PlaneScene<dim>, std::string>
  planes_of(const std::string &text)
  {
    const std::string file =
      "plane_scene_" + std::to_string(world.size()) + ".prm";
    MPI_Barrier(world);
    if (world.is_root())
      std::ofstream(file) << "set Dimension = " << dim << '\n'
                          << text
                          << (text.find("subsection Mesh") == text.npos
                                ? "subsection Mesh\n set Generator = gmsh\n "
                                  "set Size = 4\nend\n"
                                : "")
                          << "subsection Materials\n set Names = rock\n "
                             "subsection rock\n end\nend\n";
    MPI_Barrier(world);
    Scene<dim> scene;
    scene.read(world, file, {});
    return list_planes(scene);
  }

  template <int dim>
  PlaneBlocks<dim>
  blocks_of(const std::string &text)
  {
    const auto planes = std::get<PlaneScene<dim>>(planes_of<dim>(text));
    return find_plane_blocks(planes, plane_block_options(planes));
  }

  template <int dim>
  std::string
  reason_of(const std::string &text)
  {
    return std::get<std::string>(planes_of<dim>(text));
  }

  template <int dim>
  std::vector<double>
  finite_volumes(const PlaneBlocks<dim> &found)
  {
    std::vector<double> volumes;
    for (const auto &block : found.blocks)
      if (!block.is_infinite)
        volumes.push_back(block.volume);
    return volumes;
  }

  template <int dim>
  double
  volume_of_rock(const PlaneBlocks<dim> &found)
  {
    double volume = 0.;
    for (const auto &block : found.blocks)
      volume += block.volume;
    return volume;
  }

  double
  area_of(const std::vector<Point<2>> &corners)
  {
    double area = 0.;
    for (unsigned int i = 0; i < corners.size(); ++i)
      {
        const Point<2> &a = corners[i], &b = corners[(i + 1) % corners.size()];
        area += 0.5 * (a[0] * b[1] - a[1] * b[0]);
      }
    return area;
  }

  const std::string box    = "subsection Domain\n set Corner = -10, -10\n set "
                             "Size = 20, 20\nend\n",
                    box_3d = "subsection Domain\n set Corner = -10, -10, "
                             "-10\n set Size = 20, 20, 20\nend\n";

  std::string
  excavation(const std::string &entries)
  {
    return "subsection Excavations\n set Names = hole\n subsection hole\n" +
           entries + " end\nend\n";
  }
} // namespace

BOOST_AUTO_TEST_CASE(convex_parts_fill_the_polygon)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0.2, 1.);
  for (unsigned int trial = 0; trial < 200; ++trial)
    {
      // a star, with corners in straight edges, either way around
      std::vector<Point<2>> corners;
      const unsigned int n = 4 + trial % 17;
      for (unsigned int i = 0; i < n; ++i)
        {
          const double angle = 2. * dealii::numbers::PI * i / n;
          const double r     = uniform(random);
          const Point<2> corner(3. + r * std::cos(angle), r * std::sin(angle));
          if (i > 0 && trial % 3 == 0)
            corners.push_back(corners.back() +
                              0.25 * (corner - corners.back()));
          corners.push_back(corner);
        }
      if (trial % 2 == 1)
        std::reverse(corners.begin(), corners.end());
      double sum = 0.;
      for (const auto &part : convex_parts(corners))
        {
          std::vector<Point<2>> piece;
          for (const unsigned int i : part)
            piece.push_back(corners[i]);
          sum += area_of(piece);
          for (unsigned int i = 0; i < piece.size(); ++i)
            BOOST_TEST(area_of({piece[i],
                                piece[(i + 1) % piece.size()],
                                piece[(i + 2) % piece.size()]}) > -1e-12);
        }
      BOOST_TEST(std::abs(sum - std::abs(area_of(corners))) < 1e-12);
    }
}

BOOST_AUTO_TEST_CASE(wedge_in_a_slope)
{
  // a slope of 60 degrees from (0, 0) to (x, 10), a joint of 30 degrees through
  // its toe: the wedge daylights in the flat top
  const double crest = 10. / std::tan(60. * radian),
               back  = 10. / std::tan(30. * radian);
  std::ostringstream text;
  text.precision(17);
  text
    << "subsection Domain\n set Shape = polygon\n set Polygon = -20, -20; "
       "40, -20; 40, 10; "
    << crest
    << ", 10; 0, 0; -20, 0\n set Truncated boundaries = id 1, id 2, left\nend\n"
       "subsection Joints\n set Names = plane\n subsection plane\n  set "
       "Point = 0, 0\n  set Dip = 30\n  set Dip direction = 270\n end\nend\n";
  const auto found = blocks_of<2>(text.str());
  const auto areas = finite_volumes(found);
  BOOST_TEST_REQUIRE(areas.size() == 1u);
  BOOST_TEST(std::abs(areas[0] - 5. * (back - crest)) < 1e-9);
  BOOST_TEST(found.blocks[0].exposed_stage == 0u);
  BOOST_TEST(std::abs(volume_of_rock(found) -
                      (60. * 20. + 10. * (40. - crest) + 5. * crest)) < 1e-9);
  // where rock goes on beyond the pocket over the toe, the wedge is infinite
  std::string truncated = text.str();
  truncated.replace(truncated.find("id 1, id 2, left"), 16, "all");
  BOOST_TEST(finite_volumes(blocks_of<2>(truncated)).empty());
  // not so the edge from the crest alone
  truncated.replace(truncated.find("= all"), 5, "= id 4");
  BOOST_TEST(reason_of<2>(truncated) ==
             "edges of the domain where it is not convex are truncated and "
             "free");
}

BOOST_AUTO_TEST_CASE(bodies_that_are_not_convex)
{
  // a box of 4 by 3 by 2 m less one of 2 by 1 by 2 at a corner, and turned
  for (const double turn : {0., 0.3, 1.1})
    {
      const std::vector<Point<2>> outline = {Point<2>(0., 0.),
                                             Point<2>(4., 0.),
                                             Point<2>(4., 2.),
                                             Point<2>(2., 2.),
                                             Point<2>(2., 3.),
                                             Point<2>(0., 3.)};
      const unsigned int n                = outline.size();
      TriangleSurface surface;
      for (const double z : {0., 2.})
        for (const Point<2> &p : outline)
          surface.vertices.emplace_back(std::cos(turn) * p[0] -
                                          std::sin(turn) * p[1],
                                        std::sin(turn) * p[0] +
                                          std::cos(turn) * p[1],
                                        z + 0.1 * p[0]);
      for (const auto &t : std::vector<std::array<unsigned int, 3>>{
             {{0, 1, 2}}, {{0, 2, 3}}, {{0, 3, 5}}, {{3, 4, 5}}})
        {
          surface.triangles.push_back({{t[0], t[2], t[1]}});
          surface.triangles.push_back({{n + t[0], n + t[1], n + t[2]}});
        }
      for (unsigned int i = 0; i < n; ++i)
        {
          const unsigned int j = (i + 1) % n;
          surface.triangles.push_back({{i, j, n + j}});
          surface.triangles.push_back({{i, n + j, n + i}});
        }
      BOOST_TEST_REQUIRE(surface.orient() == "");
      const Solid solid(surface);
      const auto parts = convex_parts(solid);
      BOOST_TEST(parts.size() > 1u);
      PlaneScene<3> scene;
      scene.box =
        BoundingBox<3>({Point<3>(-9., -9., -9.), Point<3>(9., 9., 9.)});
      scene.is_truncated.assign(6, true);
      for (const auto &part : parts)
        scene.excavations.push_back({0, 1, part});
      const auto found = find_plane_blocks(scene, plane_block_options(scene));
      BOOST_TEST(found.blocks.size() == 1u);
      BOOST_TEST(std::abs(volume_of_rock(found) - (18. * 18. * 18. - 20.)) <
                 1e-9);
    }
}

BOOST_AUTO_TEST_CASE(excavations_that_are_not_convex)
{
  // an L, and a joint at 45 degrees over its inner corner
  const std::string scene =
    box +
    excavation("  set Vertices = -4, -4; 4, -4; 4, 0; 0, 0; 0, 4; -4, 4\n") +
    "subsection Joints\n set Names = j\n subsection j\n  set Point = 1, 1\n  "
    "set Dip = 45\n end\nend\n";
  const auto found = blocks_of<2>(scene);
  const auto areas = finite_volumes(found);
  BOOST_TEST_REQUIRE(areas.size() == 1u);
  BOOST_TEST(std::abs(areas[0] - 2.) < 1e-12);
  double free = 0.;
  for (const auto &face : found.free_faces[0])
    free += face.area;
  BOOST_TEST(std::abs(free - 4.) < 1e-12);
  BOOST_TEST(std::abs(volume_of_rock(found) - (400. - 48.)) < 1e-9);
}

BOOST_AUTO_TEST_CASE(joints_along_outlines)
{
  // a wedge on a plane of 60 degrees against a wall; the side of the notch at
  // its toe lies on the plane but for rounding
  const auto found = blocks_of<2>(
    "subsection Domain\n set Corner = -8, -2\n set Size = 22, 12\n set "
    "Truncated boundaries = left, right, bottom\nend\n" +
    excavation("  set Vertices = 0, 0; 0, 1; -0.57735026919, 1\n") +
    "subsection Joints\n set Names = plane, wall\n subsection plane\n  set "
    "Vertices = -5.7735026919, 10; 0, 0\n end\n subsection wall\n  set "
    "Vertices = 0, 0; 0, 10\n end\nend\n");
  const auto areas = finite_volumes(found);
  BOOST_TEST_REQUIRE(areas.size() == 1u);
  const double tangent = std::tan(60. * radian);
  BOOST_TEST(std::abs(areas[0] - 99. / 2. / tangent) < 1e-8);
  const auto &block = found.blocks[0];
  BOOST_TEST(std::abs(block.joint_area.at(0) - 9. / std::sin(60. * radian)) <
             1e-8);
  BOOST_TEST(std::abs(block.joint_area.at(1) - 9.) < 1e-8);
}

// A block between two joints, with a chamber at both ends whose floor and roof
// are on them, turned by any angle: rounding leaves slivers between them, of
// which the block gets nothing.
BOOST_AUTO_TEST_CASE(turned_outlines_on_joints)
{
  for (unsigned int turn = 1; turn < 90; ++turn)
    {
      const double c = std::cos(turn * radian), s = std::sin(turn * radian);
      const auto at = [&](const double x, const double y) {
        std::ostringstream out;
        out << std::setprecision(16) << c * x - s * y << ", " << s * x + c * y;
        return out.str();
      };
      const auto chamber = [&](const double from, const double to) {
        return "  set Vertices = " + at(from, -0.1) + "; " + at(to, -0.1) +
               "; " + at(to, 0.1) + "; " + at(from, 0.1) + "\n end\n";
      };
      const auto joint = [&](const double y) {
        return "  set Point = " + at(0., y) + "\n  set Normal = " + at(0., 1.) +
               "\n end\n";
      };
      const auto blocks = blocks_of<2>(
        "subsection Domain\n set Shape = parallelepiped\n set Corner = " +
        at(-0.5, -0.2) + "\n set Edges = " + at(1., 0.) + "; " + at(0., 0.4) +
        "\n set Truncated boundaries = all\nend\n"
        "subsection Excavations\n set Names = a, b\n subsection a\n" +
        chamber(-0.5, -0.25) + " subsection b\n" + chamber(0.25, 0.5) +
        "end\nsubsection Joints\n set Names = base, top\n subsection base\n" +
        joint(-0.1) + " subsection top\n" + joint(0.1) + "end\n");
      BOOST_TEST_REQUIRE(blocks.blocks.size() == 3);
      const Block<2> &block = blocks.blocks[0];
      BOOST_TEST(!block.is_infinite);
      BOOST_TEST(std::abs(block.volume - 0.1) < 1e-9);
      double on_joints = 0., free = 0.;
      for (const auto &face : blocks.faces[0])
        on_joints += face.area;
      for (const auto &face : blocks.free_faces[0])
        free += face.area;
      BOOST_TEST(std::abs(on_joints - 1.) < 1e-6);
      BOOST_TEST(std::abs(free - 0.4) < 1e-6);
    }
}

BOOST_AUTO_TEST_CASE(circles_have_their_area)
{
  const auto found = blocks_of<2>(
    box + excavation("  set Shape = circle\n  set Center = 1, 2\n  set Radius "
                     "= 3\n"));
  BOOST_TEST(
    std::abs(volume_of_rock(found) - (400. - 9. * dealii::numbers::PI)) < 1e-9);
}

BOOST_AUTO_TEST_CASE(turned_sections_cut_out_their_volume)
{
  for (const std::string axis :
       {"", "  set Trend = 30\n", "  set Trend = 250\n  set Plunge = 20\n"})
    {
      const auto found = blocks_of<3>(
        box_3d + excavation("  set Shape = extruded polygon\n  set Vertices = "
                            "-2, -2; 2, -2; 2, 0; 0, 0; 0, 2; -2, 2\n  set "
                            "From = -3\n  set To = 4\n" +
                            axis));
      BOOST_TEST(std::abs(volume_of_rock(found) - (8000. - 12. * 7.)) < 1e-8);
    }
}

BOOST_AUTO_TEST_CASE(sides_of_a_parallelepiped)
{
  // joints parallel to its sides cut a block at the lower front left corner,
  // where rock does not go on
  const std::string scene =
    "subsection Domain\n set Shape = parallelepiped\n set Corner = 1, 2, 3\n "
    "set Edges = 10, 0, 0; 2, 10, 0; 1, 3, 10\n set Truncated boundaries = "
    "right, back, top\nend\nsubsection Joints\n set Names = a, b, c\n "
    "subsection a\n  set Normal = 1, -0.2, -0.04\n  set Point = 4, 2, 3\n "
    "end\n subsection b\n  set Normal = 0, 1, -0.3\n  set Point = 1.8, 6, 3\n "
    "end\n subsection c\n  set Normal = 0, 0, 1\n  set Point = 1.5, 3.5, 8\n "
    "end\nend\n";
  const auto volumes = finite_volumes(blocks_of<3>(scene));
  BOOST_TEST_REQUIRE(volumes.size() == 1u);
  BOOST_TEST(std::abs(volumes[0] - 1000. * 0.3 * 0.4 * 0.5) < 1e-9);
}

BOOST_AUTO_TEST_CASE(joints_of_polygons_that_are_not_convex)
{
  // a roof over an L, 1 m above a hall, that walls along its outline reach
  const std::string hall = box_3d + excavation("  set Shape = box\n  set "
                                               "Corner = -8, -8, -8\n  set "
                                               "Size = 16, 16, 8\n");
  const std::vector<Point<2>> corners = {Point<2>(-2., -2.),
                                         Point<2>(3., -2.),
                                         Point<2>(3., 0.),
                                         Point<2>(1., 0.),
                                         Point<2>(1., 2.),
                                         Point<2>(-2., 2.)};
  std::ostringstream joints, roof;
  std::string names = "roof";
  for (unsigned int i = 0; i < corners.size(); ++i)
    {
      const Point<2> &a = corners[i], &b = corners[(i + 1) % corners.size()];
      const auto at = [](const Point<2> &p, const double z) {
        std::ostringstream text;
        text << p[0] << ", " << p[1] << ", " << z;
        return text.str();
      };
      names += ", w" + std::to_string(i);
      joints << " subsection w" << i << "\n  set Extent = polygon\n  set "
             << "Vertices = " << at(a, -1.) << "; " << at(b, -1.) << "; "
             << at(b, 1.) << "; " << at(a, 1.) << "\n end\n";
      roof << (i ? "; " : "") << at(a, 1.);
    }
  const std::string scene = hall + "subsection Joints\n set Names = " + names +
                            "\n subsection roof\n  set Extent = polygon\n  "
                            "set Vertices = " +
                            roof.str() + "\n end\n" + joints.str() + "end\n";
  const auto found   = blocks_of<3>(scene);
  const auto volumes = finite_volumes(found);
  BOOST_TEST_REQUIRE(volumes.size() == 1u);
  BOOST_TEST(std::abs(volumes[0] - 16.) < 1e-9);
  BOOST_TEST(std::abs(found.blocks[0].joint_area.at(0) - 16.) < 1e-9);
}

BOOST_AUTO_TEST_CASE(scenes_without_planes)
{
  BOOST_TEST(reason_of<2>(box +
                          excavation("  set Shape = formula\n  set "
                                     "Formula = 1 - x^2 - y^2\n") +
                          "subsection Mesh\n set Cells = 20, 20\nend\n") ==
             "the excavation 'hole' is a formula");
}

BOOST_AUTO_TEST_SUITE_END()
