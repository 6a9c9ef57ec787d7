// SPDX-License-Identifier: LGPL-2.1-or-later
// Excavations from files: outlines of drawings, triangles and what is inside,
// solids with curved surfaces, and names of physical groups in a mesh file.
#include "world.h"

#include <boost/test/unit_test.hpp>

#include <gmsh.h>
#include <keyblock/base/errors.h>
#include <keyblock/base/gmsh_session.h>
#include <keyblock/blocks/block_geometry.h>
#include <keyblock/blocks/mesh_fidelity.h>
#include <keyblock/mesh/excavation_region.h>
#include <keyblock/mesh/mesh.h>
#include <keyblock/mesh/polyhedron.h>
#include <keyblock/scene/dxf.h>
#include <keyblock/scene/plane_faces.h>
#include <keyblock/scene/plane_facets.h>
#include <keyblock/scene/shape_files.h>
#include <keyblock/scene/solid_file.h>

#include <boost/algorithm/string/case_conv.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <random>
#include <sstream>
#include <stdexcept>

BOOST_AUTO_TEST_SUITE(shape_files)

using namespace Keyblock;

namespace
{
  constexpr double pi = dealii::numbers::PI;

  /** Names of files that no other number of ranks has. */
  std::string
  own(const std::string &name)
  {
    return "shapes_" + std::to_string(world.size()) + "_" + name;
  }

  /** A drawing of these pairs of code and value, separated by blanks. */
  std::string
  drawing(const std::string &pairs)
  {
    std::istringstream in("0 SECTION 2 ENTITIES " + pairs + " 0 ENDSEC 0 EOF");
    std::string text;
    for (std::string word; in >> word;)
      text += word + "\r\n";
    return text;
  }

  double
  area_of(const std::vector<Point<2>> &corners)
  {
    double sum = 0.;
    for (unsigned int i = 0; i < corners.size(); ++i)
      {
        const Point<2> &a = corners[i], &b = corners[(i + 1) % corners.size()];
        sum += 0.5 * (a[0] * b[1] - a[1] * b[0]);
      }
    return std::abs(sum);
  }

  std::string
  fault_of_drawing(const std::string &text)
  {
    return reason_of_failure([&]() { read_dxf_outline(text, 24); });
  }

  /** Two triangles for a rectangle. */
  void
  add_rectangle(std::vector<std::array<Point<3>, 3>> &list,
                const Point<3> &a,
                const Tensor<1, 3> &u,
                const Tensor<1, 3> &v)
  {
    list.push_back({{a, a + u, a + u + v}});
    list.push_back({{a, a + u + v, a + v}});
  }

  /** The surface of an L of two cubes side by side and one on the first, of
   * unit edges, with the faces between rectangles cut, turned at random. */
  std::vector<std::array<Point<3>, 3>>
  make_angle()
  {
    std::vector<std::array<Point<3>, 3>> list;
    const std::array<Point<3>, 3> cubes = {
      {Point<3>(0, 0, 0), Point<3>(1, 0, 0), Point<3>(0, 0, 1)}};
    const auto is_filled = [&](const Point<3> &center) {
      for (const Point<3> &cube : cubes)
        if (center.distance(cube + Point<3>(0.5, 0.5, 0.5)) < 0.1)
          return true;
      return false;
    };
    for (const Point<3> &cube : cubes)
      for (unsigned int d = 0; d < 3; ++d)
        for (const double side : {0., 1.})
          {
            Tensor<1, 3> normal, u, v;
            normal[d]      = 1.;
            u[(d + 1) % 3] = 1.;
            v[(d + 2) % 3] = 1.;
            const Point<3> middle(cube + Point<3>(0.5, 0.5, 0.5) +
                                  (2. * side - 1.) * normal);
            if (!is_filled(middle))
              add_rectangle(list, cube + side * normal, u, v);
          }
    std::mt19937 random(3);
    for (auto &triangle : list)
      if (random() % 2 == 0)
        std::swap(triangle[0], triangle[1]);
    return list;
  }

  std::string
  ascii_stl(const std::vector<std::array<Point<3>, 3>> &triangles)
  {
    std::ostringstream out;
    out << "solid angle\n";
    for (const auto &triangle : triangles)
      {
        out << "facet normal 0 0 0\nouter loop\n";
        for (const Point<3> &p : triangle)
          out << "vertex " << p << '\n';
        out << "endloop\nendfacet\n";
      }
    out << "endsolid angle\n";
    return out.str();
  }

  std::string
  binary_stl(const std::vector<std::array<Point<3>, 3>> &triangles)
  {
    std::string text(80, ' ');
    const std::uint32_t n = triangles.size();
    text.append(reinterpret_cast<const char *>(&n), 4);
    for (const auto &triangle : triangles)
      {
        float numbers[12] = {};
        for (unsigned int i = 0; i < 9; ++i)
          numbers[3 + i] = triangle[i / 3][i % 3];
        text.append(reinterpret_cast<const char *>(numbers), sizeof numbers);
        text.append(2, '\0');
      }
    return text;
  }

  /** Depth in the angle of make_angle(), from the boxes around it. */
  double
  depth_in_angle(const Point<3> &p)
  {
    double distance      = 1e300;
    bool is_inside       = false;
    const auto triangles = make_angle();
    for (const auto &t : triangles)
      for (unsigned int i = 0; i <= 40; ++i)
        for (unsigned int j = 0; j + i <= 40; ++j)
          distance = std::min(distance,
                              p.distance(t[0] + i / 40. * (t[1] - t[0]) +
                                         j / 40. * (t[2] - t[0])));
    is_inside = p[1] > 0. && p[1] < 1. && p[0] > 0. && p[2] > 0. &&
                ((p[0] < 2. && p[2] < 1.) || (p[0] < 1. && p[2] < 2.));
    return is_inside ? distance : -distance;
  }

  double
  mass_of_volume(const int tag)
  {
    double mass = 0.;
    gmsh::model::occ::getMass(3, tag, mass);
    return mass;
  }

  /** Volume of the cells that the first excavation takes. */
  template <int dim>
  double
  excavated_volume(const Mesh<dim> &mesh)
  {
    double sum = 0.;
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      if (mesh.excavation_stage[c] > 0)
        sum += mesh.cell_volume(c);
    return sum;
  }

  std::unique_ptr<Scene<3>>
  read_scene(const std::string &text, const std::vector<std::string> &overrides)
  {
    const std::string name = own("scene.prm");
    MPI_Barrier(world);
    if (world.is_root())
      std::ofstream(name) << text;
    MPI_Barrier(world);
    auto scene = std::make_unique<Scene<3>>();
    scene->read(world, name, overrides);
    return scene;
  }

  const std::string scene_of_cylinder =
    "set Dimension = 3\nsubsection Domain\n set Corner = -10, -10, -10\n set "
    "Size = 20, 20, 20\nend\nsubsection Mesh\n set Generator = gmsh\n set Size "
    "= 4\n set Size at excavation = 1.2\nend\nsubsection Excavations\n set "
    "Names = tunnel\n subsection tunnel\n  set Shape = file\n end\nend\n"
    "subsection Materials\n set Names = rock\nend\n";
} // namespace



BOOST_AUTO_TEST_CASE(outlines_of_drawings)
{
  // lines from either end, out of order
  const auto square =
    read_dxf_outline(drawing(
                       "0 LINE 10 0 20 0 11 4 21 0 0 LINE 10 0 20 3 11 4 21 3 "
                       "0 LINE 10 4 20 0 11 4 21 3 0 LINE 10 0 20 3 11 0 21 0 "
                       "0 POINT 10 9 20 9"),
                     24);
  BOOST_TEST(square.size() == 4u);
  BOOST_TEST(std::abs(area_of(square) - 12.) < 1e-12);

  // half a circle as bulge, as arc and in an old polyline: n chords each
  const unsigned int n = 16;
  const double half    = 0.5 * n * std::sin(pi / n); // of radius 1
  for (const std::string text :
       {"0 LWPOLYLINE 90 2 70 1 10 -1 20 0 10 1 20 0 42 1",
        "0 LWPOLYLINE 90 2 70 1 10 -1 20 0 42 -1 10 1 20 0",
        "0 ARC 10 0 20 0 40 1 50 0 51 180 0 LINE 10 -1 20 0 11 1 21 0",
        "0 ARC 10 0 20 0 40 1 50 270 51 90 0 LINE 10 0 20 -1 11 0 21 1",
        "0 POLYLINE 66 1 70 1 0 VERTEX 10 -1 20 0 42 0 0 VERTEX 10 1 20 0 "
        "42 1 0 SEQEND"})
    {
      const auto found = read_dxf_outline(drawing(text), n);
      BOOST_TEST(found.size() == n + 1);
      BOOST_TEST(std::abs(area_of(found) - half) < 1e-9);
    }
  const auto circle = read_dxf_outline(drawing("0 CIRCLE 10 5 20 6 40 2"), n);
  BOOST_TEST(circle.size() == 2 * n);
  // arcs that end where they begin
  for (const std::string angles :
       {"50 0 51 360", "50 90 51 450", "50 360 51 0"})
    {
      const auto whole =
        read_dxf_outline(drawing("0 ARC 10 5 20 6 40 2 " + angles), n);
      BOOST_TEST(whole.size() == 2 * n);
      BOOST_TEST(std::abs(area_of(whole) - area_of(circle)) < 1e-9);
    }
  // behind a byte order mark, beside a frame and a spline on paper
  const std::string paper =
    "0 LINE 67 1 10 0 20 0 11 9 21 0 0 SPLINE 67 1 70 11 0 POLYLINE 67 1 66 1 "
    "70 1 0 VERTEX 67 1 10 0 20 0 0 VERTEX 67 1 10 4 20 0 0 SEQEND 67 1 ";
  const auto marked = read_dxf_outline(
    "\xEF\xBB\xBF" + drawing(paper + "0 CIRCLE 67 0 10 5 20 6 40 2"), n);
  BOOST_TEST(marked.size() == 2 * n);
  BOOST_TEST(area_of(marked) == area_of(circle));
  // drawn on the back of the plane
  const auto mirrored = read_dxf_outline(
    drawing("0 LWPOLYLINE 70 1 230 -1 10 1 20 0 10 2 20 0 10 1 20 1"), n);
  BOOST_TEST(mirrored[1][0] == -2.);

  // the frame of a spline is not drawn
  const std::string fitted =
    "0 POLYLINE 66 1 70 4 0 VERTEX 10 3 20 1 70 8 0 VERTEX 10 6 20 3 70 8 0 "
    "VERTEX 10 9 20 5 70 8 0 VERTEX 10 9 20 5 70 16 0 VERTEX 10 6 20 9 70 16 0 "
    "VERTEX 10 3 20 1 70 16 0 SEQEND";
  const auto curve = read_dxf_paths(drawing(fitted), n);
  BOOST_TEST(curve.size() == 1u);
  BOOST_TEST(curve[0].size() == 3u);
  BOOST_TEST(curve[0][2][1] == 5.);
  const auto closed = read_dxf_outline(
    drawing("0 POLYLINE 66 1 70 5 0 VERTEX 10 0 20 0 70 8 0 VERTEX 10 4 20 0 "
            "70 8 0 VERTEX 10 0 20 3 70 8 0 VERTEX 10 9 20 9 70 16 0 SEQEND"),
    n);
  BOOST_TEST(area_of(closed) == 6.);
}



BOOST_AUTO_TEST_CASE(bad_drawings)
{
  const auto check = [](const std::string &text, const std::string &part) {
    const std::string fault = fault_of_drawing(text);
    BOOST_TEST(fault.find(part) != std::string::npos, fault);
  };
  check(drawing("0 LINE 10 0 20 0 11 4 21 0 0 LINE 10 4 20 0.5 11 0 21 0"),
        "is open: it ends at (4, 0), and the next end is 0.5 units away");
  check(drawing("0 CIRCLE 10 5 20 6 40 2 0 CIRCLE 10 5 20 6 40 1"),
        "more than one outline");
  check(drawing("0 SPLINE 70 11"), "has a SPLINE");
  for (const char *flags : {"16", "64"})
    check(drawing(std::string("0 POLYLINE 66 1 70 ") + flags +
                  " 0 VERTEX 10 0 20 0 0 VERTEX 10 4 20 0 0 VERTEX 10 0 20 3 0 "
                  "SEQEND"),
          "a POLYLINE that is a mesh");
  check(drawing("0 POLYLINE 66 1 70 4 0 VERTEX 10 0 20 0 70 16 0 VERTEX 10 4 "
                "20 0 70 16 0 SEQEND"),
        "but no points of its curve");
  check(drawing("0 LINE 10 0 20 zero 11 4 21 0"), "'zero'");
  check(drawing("0 LINE 10 0 20 0 11 4"), "no value of code 21");
  check(drawing("0 POINT 10 0 20 0"), "no polyline");
  check(drawing("0 CIRCLE 67 1 10 5 20 6 40 2"), "circle in model space");
  check("AutoCAD Binary DXF\r\n", "binary");
  check("zero\nSECTION\n", "where the code of a value is expected");
}



BOOST_AUTO_TEST_CASE(files_that_are_cut_off)
{
  const std::string text = ascii_stl(make_angle()),
                    line =
                      drawing("0 LINE 10 0 20 0 11 4 21 0 0 CIRCLE 10 5 20 6 "
                              "40 2");
  // (the name of the last solid may be cut, and the end of the last line)
  for (std::size_t n = 0; n < text.rfind("endsolid") + 8; ++n)
    BOOST_TEST(reason_of_failure([&]() { read_stl(text.substr(0, n)); }) != "");
  for (std::size_t n = 0; n < line.rfind("EOF") + 3; ++n)
    BOOST_TEST(reason_of_failure(
                 [&]() { read_dxf_paths(line.substr(0, n), 24); }) != "");
  BOOST_TEST(read_dxf_paths(line + "\r\n\r\n\x1a", 24).size() == 2u);
  const std::string binary = binary_stl(make_angle());
  for (std::size_t n = 0; n < binary.size(); ++n)
    BOOST_TEST(reason_of_failure([&]() { read_stl(binary.substr(0, n)); }) !=
               "");
  const auto fault = [](const std::string &part) {
    return reason_of_failure([&]() { read_stl(part); });
  };
  BOOST_TEST(fault(text.substr(0, text.rfind("facet"))).find("'endsolid'") !=
             std::string::npos);
  // a name that is not told, capital letters, blank lines, several solids
  const std::string facets =
    text.substr(text.find('\n'), text.rfind("endsolid") - text.find('\n'));
  for (const std::string &whole :
       {"solid" + facets + "endsolid",
        boost::to_upper_copy(text) + "\n\n",
        "\nsolid a" + facets + "endsolid a\nsolid b\nendsolid b\n"})
    BOOST_TEST(read_stl(whole).triangles.size() == make_angle().size());
  BOOST_TEST(fault(text + "solid b" + facets) != "");
}



BOOST_AUTO_TEST_CASE(triangles_bound_a_body)
{
  for (const std::string &text :
       {ascii_stl(make_angle()), binary_stl(make_angle())})
    {
      TriangleSurface surface = read_stl(text);
      BOOST_TEST(surface.vertices.size() == 16u);
      BOOST_TEST(surface.orient() == "");
      BOOST_TEST(std::abs(surface.volume() - 3.) < 1e-12);
      BOOST_TEST(surface.components().size() == 1u);

      const Solid solid(surface);
      std::mt19937 random(7);
      std::uniform_real_distribution<double> coordinate(-0.5, 2.5);
      for (unsigned int i = 0; i < 60; ++i)
        {
          const Point<3> p(coordinate(random),
                           coordinate(random),
                           coordinate(random));
          BOOST_TEST(std::abs(solid.depth_inside(p) - depth_in_angle(p)) <
                     0.03);
        }
      // nearest to the notch, and to the corner opposite to it
      BOOST_TEST(
        std::abs(solid.depth_inside(Point<3>(0.7, 0.5, 0.6)) - 0.3 > -1e-12));
      BOOST_TEST(std::abs(solid.depth_inside(Point<3>(-1., -1., -1.)) +
                          std::sqrt(3.)) < 1e-12);

      // coplanar triangles are one face, points within edges are none
      const auto faces = list_faces(surface);
      BOOST_TEST(faces.size() == 8u);
      unsigned int n_corners = 0;
      for (const PlaneFace &face : faces)
        {
          BOOST_TEST(face.loops.size() == 1u);
          n_corners += face.loops[0].size();
        }
      BOOST_TEST(n_corners == 2u * 6 + 6 * 4);
      const GmshSession session;
      BOOST_TEST(std::abs(mass_of_volume(add_polyhedron(surface)) - 3.) < 1e-9);
    }
  auto open = make_angle();
  open.pop_back();
  TriangleSurface surface = read_stl(ascii_stl(open));
  BOOST_TEST(surface.orient().rfind("is open at the edge from (", 0) == 0u);
}



BOOST_AUTO_TEST_CASE(faces_with_holes)
{
  // a frame: a square ring along z
  std::vector<std::array<Point<3>, 3>> list;
  const std::array<Point<2>, 4> corners = {
    {Point<2>(-1, -1), Point<2>(1, -1), Point<2>(1, 1), Point<2>(-1, 1)}};
  for (unsigned int i = 0; i < 4; ++i)
    {
      const Point<2> &a = corners[i], &b = corners[(i + 1) % 4];
      for (const double s : {1., 3.})
        add_rectangle(list,
                      Point<3>(s * a[0], s * a[1], 0.),
                      Point<3>(s * (b[0] - a[0]), s * (b[1] - a[1]), 0.),
                      Point<3>(0., 0., 2.));
      for (const double z : {0., 2.})
        {
          const Point<3> p(a[0], a[1], z), q(b[0], b[1], z),
            r(3 * b[0], 3 * b[1], z), t(3 * a[0], 3 * a[1], z);
          list.push_back({{p, q, r}});
          list.push_back({{p, r, t}});
        }
    }
  TriangleSurface surface = read_stl(ascii_stl(list));
  BOOST_TEST(surface.orient() == "");
  const auto faces = list_faces(surface);
  BOOST_TEST(faces.size() == 10u);
  const GmshSession session;
  BOOST_TEST(std::abs(mass_of_volume(add_polyhedron(surface)) - 64.) < 1e-9);
}



BOOST_AUTO_TEST_CASE(cylinder_from_step)
{
  constexpr double radius = 4., length = 20.;
  const std::string shapes = KEYBLOCK_TEST_SHAPES;
  const auto scene =
    read_scene(scene_of_cylinder,
               {"Excavations/tunnel/File=" + shapes + "/cylinder.step"});
  const Excavation<3> &tunnel = *scene->excavations[0];
  BOOST_REQUIRE(tunnel.solids.size() == 1u);
  // depths are those of chords
  const double sagitta = radius * (1. - std::cos(pi / 90));
  for (const double x : {0.3, 2.5, 3.9, 4.1, 6.})
    BOOST_TEST(
      std::abs(depth_inside(tunnel, Point<3>(0.6 * x, 1., 3 + 0.8 * x)) -
               (radius - x)) < 2. * sagitta);
  BOOST_TEST(narrowest_side(tunnel) > 8. - 2. * sagitta);

  // twelve chords in a circle are said
  scene->meshing.size_at_excavation = 1.2;
  const BlockGeometry<3> made = make_block_geometry(world, *scene, silent);
  const std::vector<std::string> warnings =
    warnings_of_coarse_mesh(*scene, made.split, made.blocks);
  BOOST_REQUIRE(warnings.size() == 1u);
  BOOST_TEST(warnings[0].find("leave the surface of tunnel") !=
             std::string::npos);

  // chords of edges of tetrahedra, three times as long as cells at most: their
  // part of the volume falls with the square of the size
  std::vector<double> lost;
  for (const double size : {1.6, 0.8})
    {
      scene->meshing.size_at_excavation = size;
      const double volume               = pi * radius * radius * length;
      lost.push_back(1. - excavated_volume(make_mesh(world, *scene, silent)) /
                            volume);
      BOOST_TEST_MESSAGE("cells of " << size << " m lose " << lost.back());
      const double angle = 3. * size / radius;
      BOOST_TEST(lost.back() > 0.);
      BOOST_TEST(lost.back() < 1. - std::sin(angle) / angle);
    }
  BOOST_TEST(lost[1] < lost[0] / 3.);
}



// flat faces lose nothing, whatever joints pass close to them
BOOST_AUTO_TEST_CASE(joint_beside_a_solid_is_no_chord)
{
  if (world.is_root())
    std::ofstream("angle.stl") << ascii_stl(make_angle());
  for (const std::string normal : {"0.3, 0.2, 1", "1, 0.4, 0.2", "0.5, 1, 0.4"})
    {
      const auto scene            = read_scene(scene_of_cylinder,
                                    {"Excavations/tunnel/File=angle.stl",
                                                "Excavations/tunnel/Scale=4",
                                                "Joints/Names=near",
                                                "Joints/near/Point=4.2, 4.2, 8.3",
                                                "Joints/near/Normal=" + normal});
      const BlockGeometry<3> made = make_block_geometry(world, *scene, silent);
      for (const std::string &warning :
           warnings_of_coarse_mesh(*scene, made.split, made.blocks))
        BOOST_TEST(warning.find("leave the surface") == std::string::npos,
                   warning);
    }
}



// a closed surface inside another is told of, one beside it is none
BOOST_AUTO_TEST_CASE(nested_solids_are_named)
{
  for (const double shift : {0.5, 5.})
    {
      auto triangles         = make_angle();
      const unsigned int one = triangles.size();
      for (unsigned int t = 0; t < one; ++t)
        {
          auto small = triangles[t];
          for (Point<3> &p : small)
            p = Point<3>(0.2 * p + shift * Point<3>(1., 0.8, 0.8));
          triangles.push_back(small);
        }
      const std::string name = own("nested.stl");
      if (world.is_root())
        std::ofstream(name) << ascii_stl(triangles);
      const auto scene =
        read_scene(scene_of_cylinder, {"Excavations/tunnel/File=" + name});
      BOOST_TEST(scene->excavations[0]->solids.size() == 2u);
      const auto sentences = warnings_of_nested_solids(*scene);
      BOOST_TEST(sentences.size() == (shift < 1. ? 1u : 0u));
      for (const std::string &sentence : sentences)
        BOOST_TEST(sentence.find("inside another") != std::string::npos);
    }
}



BOOST_AUTO_TEST_CASE(solids_of_brep)
{
  const std::string name =
    own(std::to_string(world.rank()) + "_two.brep"); // each rank reads its own
  {
    const GmshSession session;
    gmsh::model::occ::addBox(0, 0, 0, 1, 2, 3);
    gmsh::model::occ::addBox(5, 0, 0, 1, 1, 1);
    gmsh::model::occ::synchronize();
    gmsh::write(name);
  }
  std::vector<TriangleSurface> surfaces =
    triangulate_solids(name, 2., Point<3>(1., 0., 0.));
  BOOST_REQUIRE(surfaces.size() == 2u);
  std::vector<double> volumes;
  for (TriangleSurface &surface : surfaces)
    {
      BOOST_TEST(surface.orient() == "");
      volumes.push_back(surface.volume());
    }
  std::sort(volumes.begin(), volumes.end());
  BOOST_TEST(std::abs(volumes[0] - 8.) < 1e-9);
  BOOST_TEST(std::abs(volumes[1] - 48.) < 1e-9);
  const Solid first(surfaces[0]), second(surfaces[1]);
  BOOST_TEST(std::abs(std::min(first.low[0], second.low[0]) + 1.) < 1e-9);
  BOOST_TEST(std::abs(std::max(first.high[0], second.high[0]) - 11.) < 1e-9);

  std::ofstream(name) << "no shape";
  BOOST_CHECK_THROW(triangulate_solids(name, 1., Point<3>()),
                    std::runtime_error);
}



// a joint: curved faces as facets with so many chords, lengths in metres
BOOST_AUTO_TEST_CASE(faces_of_step)
{
  constexpr double radius = 4., length = 40.;
  const std::string shapes = KEYBLOCK_TEST_SHAPES;
  std::vector<double> missing;
  for (const unsigned int chords : {24, 48})
    {
      TriangleSurface surface =
        triangulate_faces(shapes + "/cylinder.step", chords, 0.);
      BOOST_TEST(surface.orient() == "");
      missing.push_back(1. -
                        surface.volume() / (pi * radius * radius * length));
      const double angle = 2. * pi / chords;
      BOOST_TEST(missing.back() > 0.);
      BOOST_TEST(missing.back() < 1. - std::sin(angle) / angle);
    }
  BOOST_TEST(missing[1] < missing[0] / 3.5);

  // edges that are not wanted shorter
  const auto coarse = triangulate_faces(shapes + "/cylinder.step", 48, 2.);
  double sum        = 0.;
  for (const auto &t : coarse.triangles)
    for (unsigned int i = 0; i < 3; ++i)
      sum += coarse.vertices[t[i]].distance(coarse.vertices[t[(i + 1) % 3]]);
  BOOST_TEST(sum / (3 * coarse.triangles.size()) > 1.5);

  const std::string name = own(std::to_string(world.rank()) + "_faces.brep");
  {
    // two faces that touch along an edge without sharing it, and a body
    const GmshSession session;
    gmsh::model::occ::addRectangle(0, 0, 1, 2, 3);
    gmsh::model::occ::addRectangle(2, 0, 1, 1, 3);
    gmsh::model::occ::addBox(10, 0, 0, 1, 1, 1);
    gmsh::model::occ::synchronize();
    gmsh::write(name);
  }
  TriangleSurface surface = triangulate_faces(name, 48, 0.);
  BOOST_TEST(surface.components().size() == 2u);
  const auto facets = facets_of_triangles(surface);
  BOOST_REQUIRE(facets.size() == 1u + 6u);
  double longest = 0.;
  for (const Point<3> &p : facets[0].corners)
    longest = std::max(longest, p.distance(facets[0].corners[0]));
  BOOST_TEST(std::abs(longest - std::sqrt(18.)) < 1e-12);
  std::ofstream(name) << "no shape";
  BOOST_CHECK_THROW(triangulate_faces(name, 48, 0.), std::runtime_error);
}



BOOST_AUTO_TEST_CASE(changed_files_are_seen)
{
  const auto entries = [](const double height) {
    const std::string name = own("box.stl");
    std::vector<std::array<Point<3>, 3>> list;
    for (unsigned int d = 0; d < 3; ++d)
      for (const double side : {0., 1.})
        {
          Tensor<1, 3> normal, u, v;
          normal[d] = u[(d + 1) % 3] = v[(d + 2) % 3] = 2000.;
          for (Tensor<1, 3> *t : {&normal, &u, &v})
            (*t)[2] *= height;
          add_rectangle(list, Point<3>(100e3, 0., 0.) + side * normal, u, v);
        }
    MPI_Barrier(world);
    if (world.is_root())
      std::ofstream(name, std::ios::binary) << binary_stl(list);
    MPI_Barrier(world);
    const auto scene = read_scene(scene_of_cylinder,
                                  {"Excavations/tunnel/File=" + name,
                                   "Excavations/tunnel/Scale=1e-3",
                                   "Domain/Origin=100, 0, 0"});
    BOOST_TEST(std::abs(scene->excavations[0]->solids.at(0)->high[2] -
                        2. * height) < 1e-6);
    BOOST_TEST(std::abs(scene->excavations[0]->solids.at(0)->low[0]) < 1e-6);
    return scene->used_entries();
  };
  const std::string before = entries(1.);
  BOOST_TEST(entries(1.) == before);
  BOOST_TEST(entries(1.5) != before);
}



BOOST_AUTO_TEST_CASE(names_in_a_mesh_file)
{
  const std::string name = own("named.msh");
  if (world.is_root())
    {
      const GmshSession session;
      namespace occ = gmsh::model::occ;
      gmsh::vectorpair all;
      std::vector<gmsh::vectorpair> pieces;
      occ::fragment({{3, occ::addBox(0, 0, 0, 3, 1, 1)}},
                    {{3, occ::addBox(1, 0, 0, 1, 1, 1)}},
                    all,
                    pieces);
      occ::synchronize();
      std::vector<int> hall, rock, left;
      for (const auto &[d, tag] : all)
        (pieces[1][0].second == tag ? hall : rock).push_back(tag);
      gmsh::vectorpair faces;
      gmsh::model::getEntitiesInBoundingBox(
        -0.1, -0.1, -0.1, 0.1, 1.1, 1.1, faces, 2);
      for (const auto &[d, tag] : faces)
        left.push_back(tag);
      gmsh::model::setPhysicalName(3,
                                   gmsh::model::addPhysicalGroup(3, hall),
                                   "power house");
      gmsh::model::setPhysicalName(3,
                                   gmsh::model::addPhysicalGroup(3, rock),
                                   "granite");
      gmsh::model::setPhysicalName(2,
                                   gmsh::model::addPhysicalGroup(2, left),
                                   "portal");
      gmsh::option::setNumber("Mesh.MeshSizeMax", 0.7);
      gmsh::model::mesh::generate(3);
      gmsh::write(name);
    }
  MPI_Barrier(world);
  const auto scene = read_scene(
    "set Dimension = 3\nsubsection Domain\n set Shape = file\n set File = " +
      name +
      "\nend\nsubsection Mesh\n set Generator = file\n set Refinement levels = "
      "x < 1.5\nend\nsubsection Excavations\n "
      "set Names = power house\n subsection power house\n  set Shape = file\n "
      "end\nend\nsubsection Materials\n set Names = rock, fill\n subsection "
      "rock\n  set Region = id granite\n end\n subsection fill\n  set Region "
      "= id power house\n end\nend\n",
    {});
  const Mesh<3> mesh = make_mesh(world, *scene, silent);
  BOOST_TEST(std::abs(excavated_volume(mesh) - 1.) < 1e-9);
  double area = 0.;
  for (unsigned int c = 0; c < mesh.n_cells(); ++c)
    {
      const double x = mesh.cell_center(c)[0];
      BOOST_TEST(mesh.material[c] == (x > 1. && x < 2. ? 1u : 0u));
      BOOST_TEST((mesh.excavation_stage[c] > 0) == (x > 1. && x < 2.));
      for (unsigned int f = 0; f < Mesh<3>::n_cell_faces; ++f)
        if (mesh.is_on(c, f, "id portal"))
          area += mesh.face_area_vector(c, f).norm();
    }
  BOOST_TEST(std::abs(area - 1.) < 1e-9);
}

BOOST_AUTO_TEST_SUITE_END()
