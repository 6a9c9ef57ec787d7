// SPDX-License-Identifier: LGPL-2.1-or-later
// What limit equilibrium sees of a scene, against hand calculations, and that
// it sums water and tractions as the step does.
#include "world.h"

#include <boost/test/unit_test.hpp>

#include <keyblock/blocks/block_geometry.h>
#include <keyblock/safety/block_statics.h>
#include <keyblock/safety/stress_ratio.h>
#include <keyblock/step/conditions.h>

#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <numeric>

using namespace Keyblock;

namespace
{
  constexpr double radian = dealii::numbers::PI / 180.;

  /** Everything up to the split mesh: no run is set up. */
  template <int dim>
  struct Site
  {
    Site(const std::string &text)
    {
      const std::string file =
        "block_statics_" + std::to_string(world.size()) + ".prm";
      MPI_Barrier(world);
      if (world.is_root())
        std::ofstream(file) << "set Dimension = " << dim << '\n' << text;
      MPI_Barrier(world);
      scene.read(world, file, {});
      BlockGeometry<dim> made = make_block_geometry(world, scene, silent);
      blocks                  = std::move(made.blocks);
      split                   = std::move(made.split);
    }

    BlockStatics<dim>
    judge(const unsigned int block = 0, const unsigned int stage = 2) const
    {
      const Ground<dim> ground{scene, split.rigid(), stage, nullptr};
      return judge_block(ground, FreeFaces<dim>(ground), blocks, block, 0.);
    }

    /** What the step puts on the nodes of a block [N]. */
    Tensor<1, dim>
    load_of_step(const unsigned int block) const
    {
      const Numbering<dim> numbering(world, scene, split);
      CellArrays<dim> cells;
      Fields<dim> fields;
      Conditions<dim> conditions(scene, split, numbering, cells, fields);
      conditions.excavate(2);
      conditions.set_load(0.);
      std::vector<bool> is_of_block(split.mesh.vertices.size(), false);
      for (unsigned int c = 0; c < split.mesh.n_cells(); ++c)
        if (split.block_of_cell[c] == block)
          for (const unsigned int v : split.mesh.cells[c])
            is_of_block[v] = true;
      Tensor<1, dim> sum;
      for (unsigned int node = 0; node < numbering.n_owned(); ++node)
        if (is_of_block[numbering.vertex_of_node[node]])
          for (unsigned int d = 0; d < dim; ++d)
            sum[d] += fields.load[dim * node + d];
      for (unsigned int d = 0; d < dim; ++d)
        sum[d] = world.sum(sum[d]);
      return sum;
    }

    Scene<dim> scene;
    Blocks<dim> blocks;
    SplitMesh<dim> split;
  };

  const std::string stage =
    "subsection Stages\n set Names = rest\n subsection rest\n set Duration = "
    "1\n end\nend\n";

  /** A block of 0.5 m and @p height between x = -0.25 and 0.25 on level rock,
   * with gravity of 10 m/s2 turned by @p dip; 2000 kg/m3, friction angle 30
   * degrees. */
  std::string
  incline(const double dip,
          const double height,
          const std::string &joint,
          const std::string &more)
  {
    const auto number = [](const double value) {
      std::ostringstream out;
      out.precision(17);
      out << value;
      return out.str();
    };
    const std::string side =
      "\n  set Shape = box\n  set Size = 0.25, " + number(height) + "\n";
    return "subsection Domain\n set Corner = -0.5, -0.1\n set Size = 1, " +
           number(0.1 + height) +
           "\n set Truncated boundaries = bottom, left, right\nend\nsubsection "
           "Mesh\n set Cells = 8, " +
           std::to_string(std::lround((0.1 + height) / 0.1)) +
           "\nend\nsubsection Excavations\n set Names = uphill, "
           "downhill\n subsection uphill" +
           side + "  set Corner = -0.5, 0\n end\n subsection downhill" + side +
           "  set Corner = 0.25, 0\n end\nend\nsubsection Joints\n set Names = "
           "base\n subsection base\n  set Point = 0, 0\n  set Dip = 0\n  set "
           "Friction angle = 30\n" +
           joint +
           " end\nend\nsubsection Materials\n set Names = rock\n subsection "
           "rock\n  set Density = 2000\n end\nend\nsubsection Initial state\n "
           "set Gravity = " +
           number(10. * std::sin(dip * radian)) + "; " +
           number(-10. * std::cos(dip * radian)) + "\nend\n" + stage + more;
  }

  std::string
  traction(const std::string &boundary, const std::string &value)
  {
    return "subsection Tractions\n set Names = push\n subsection push\n  set "
           "Boundaries = " +
           boundary + "\n  set Traction = " + value + "\n end\nend\n";
  }

  bool
  is_near(const double value, const double reference, const double tolerance)
  {
    BOOST_TEST_INFO(value << " instead of " << reference);
    return std::abs(value - reference) <= tolerance * std::abs(reference);
  }

  /** Steeper than the friction of the other side: cube of 1 m on a plane along
   * y = 0 in 3D, gravity turned by 40 degrees towards +x. */
  std::string
  cube(const std::string &joint, const std::string &more)
  {
    const std::string box = "\n  set Shape = box\n  set Size = 1, 1, 1\n";
    return "subsection Domain\n set Corner = -1.5, -0.5, -1\n set Size = 3, 1, "
           "2\n set Truncated boundaries = bottom\nend\nsubsection Mesh\n set "
           "Cells = 12, 4, 8\nend\nsubsection Excavations\n set Names = "
           "uphill, downhill\n subsection uphill" +
           box + "  set Corner = -1.5, -0.5, 0\n end\n subsection downhill" +
           box +
           "  set Corner = 0.5, -0.5, 0\n end\nend\nsubsection Joints\n set "
           "Names = base\n subsection base\n  set Point = 0, 0, 0\n  set Dip "
           "= 0\n  set Friction angle = 30\n" +
           joint +
           " end\nend\nsubsection Materials\n set Names = rock\n subsection "
           "rock\n  set Density = 2000\n end\nend\nsubsection Initial state\n "
           "set Gravity = 10*sin(40*pi/180); 0; -10*cos(40*pi/180)\nend\n" +
           stage + more;
  }

  const double sine = std::sin(40. * radian), cosine = std::cos(40. * radian),
               friction = std::tan(30. * radian);

  bool
  has_remark(const std::string &remark, const std::string &part)
  {
    BOOST_TEST_INFO("'" << part << "' in '" << remark << "'");
    return remark.find(part) != std::string::npos;
  }
} // namespace

BOOST_AUTO_TEST_SUITE(block_statics)

BOOST_AUTO_TEST_CASE(traction_on_the_exposed_face)
{
  // weight 1000 N: without traction, pressed on the top, and pushed along
  const auto free = Site<2>(incline(40., 0.1, "", "")).judge();
  BOOST_TEST(free.mode() == "sliding on base");
  BOOST_TEST(is_near(free.limit.factor, friction * cosine / sine, 1e-12));
  BOOST_TEST(free.remark() == "");
  const Site<2> pressed(incline(40., 0.1, "", traction("top", "0; -3000")));
  const auto more     = pressed.judge();
  const double normal = 1000. * cosine + 3000. * 0.5;
  BOOST_TEST(is_near(more.limit.normal_forces[0], normal, 1e-12));
  BOOST_TEST(
    is_near(more.limit.factor, friction * normal / (1000. * sine), 1e-12));
  BOOST_TEST(
    (pressed.load_of_step(0) - more.around.loads.without_water()).norm() <
    1e-9);
  const auto pushed =
    Site<2>(
      incline(40., 0.1, "  set Cohesion = 500\n", traction("top", "800; 200")))
      .judge();
  BOOST_TEST(
    is_near(pushed.limit.factor,
            (friction * (1000. * cosine - 100.) + 250.) / (1000. * sine + 400.),
            1e-12));
  // a pull that lifts it, and pressure that holds it upside down
  BOOST_TEST(
    Site<2>(incline(40., 0.1, "", traction("top", "0; 3000"))).judge().mode() ==
    "lifting");
  // it begins with a later stage
  const Site<2> later(incline(
    40.,
    0.1,
    "",
    "subsection Stages\n set Names = rest, then\n subsection then\n set "
    "Duration = 1\n end\nend\nsubsection Tractions\n set Names = push\n "
    "subsection push\n  set Region = (y - 0.0999)*(0.26 - abs(x))\n  set "
    "Traction = 0; -3000\n  set Stage = then\n end\nend\n"));
  BOOST_TEST(is_near(later.judge(0, 2).limit.factor, free.limit.factor, 1e-12));
  BOOST_TEST(is_near(later.judge(0, 3).limit.factor, more.limit.factor, 1e-12));
}

BOOST_AUTO_TEST_CASE(a_region_of_a_traction_does_not_reach_into_joints)
{
  // the region covers the base, too, where there is no free face
  const auto statics =
    Site<2>(incline(40.,
                    0.1,
                    "",
                    "subsection Tractions\n set Names = push\n subsection "
                    "push\n  set Region = 0.26 - abs(x)\n  set Traction = 0; "
                    "-100\n end\nend\n"))
      .judge();
  // on the top and on both sides
  BOOST_TEST(
    is_near(sum_of(statics.around.loads.tractions)[1], -100. * 0.7, 1e-12));
}

BOOST_AUTO_TEST_CASE(traction_water_and_earthquake_in_space)
{
  // weight 20 kN; 5 kPa on the top, water of 2000 (x + 0.5)^2 Pa beneath
  const Site<3> site(cube("  set Water pressure = 2000*(x + 0.5)^2\n",
                          traction("top", "0; 0; -5000") +
                            "subsection Safety factor\n set Seismic "
                            "coefficient = 0.1, 0, -0.05\nend\n"));
  const auto statics = site.judge();
  const double water = 2000. / 3., seismic = 2000. * 9.81;
  BOOST_TEST(is_near(statics.around.faces[0].water_force, water, 1e-12));
  const double normal  = 20e3 * cosine + 5000. + 0.05 * seismic - water;
  const double driving = 20e3 * sine + 0.1 * seismic;
  BOOST_TEST(statics.mode() == "sliding on base");
  BOOST_TEST(is_near(statics.limit.normal_forces[0], normal, 1e-12));
  BOOST_TEST(is_near(statics.limit.driving_force, driving, 1e-12));
  BOOST_TEST(is_near(statics.limit.factor, friction * normal / driving, 1e-12));
  BOOST_TEST(has_remark(statics.remark(),
                        "with the seismic coefficient 0.1, 0, -0.05, which "
                        "runs and trials do not see"));
  const auto &loads = statics.around.loads;
  BOOST_TEST((site.load_of_step(0) + loads.seismic - loads.without_water() -
              sum_of(loads.water))
               .norm() < 1e-8);
}

BOOST_AUTO_TEST_CASE(water_is_summed_as_the_step_does)
{
  // on a mesh of unlike quadrilaterals and hexahedra, with water in all joints;
  // its table crosses faces, which are halved ten times in 2D and five in 3D
  const auto compare = [](const auto &site, const double tolerance) {
    for (unsigned int b = 0; b < site.blocks.blocks.size(); ++b)
      if (!site.blocks.blocks[b].is_infinite)
        {
          const auto &loads = site.judge(b).around.loads;
          const auto sum =
            loads.without_water() - loads.water_along + sum_of(loads.water);
          BOOST_TEST(loads.water.size() > 0u);
          BOOST_TEST((site.load_of_step(b) - sum).norm() <
                     tolerance * loads.weight.norm());
        }
  };
  const std::string rest =
    "subsection Materials\n set Names = rock\n subsection rock\n  set Density "
    "= 2000\n end\nend\n" +
    stage;
  compare(
    Site<2>(
      "subsection Domain\n set Size = 4, 4\n set Truncated boundaries = "
      "bottom\nend\nsubsection Mesh\n set Generator = gmsh\n set Size = "
      "0.6\n set Snap = 0\nend\nsubsection Joints\n set Names = a, b\n "
      "subsection a\n  set "
      "Point = 2, 1.5\n  set Dip = 35\n  set Water pressure = max(0, 9000*(2.1 "
      "- "
      "y))\n end\n subsection b\n  set Point = 2, 1.5\n  set Dip = 70\n  set "
      "Dip "
      "direction = 270\n  set Water pressure = 3000*x^2\n end\nend\nsubsection "
      "Initial state\n set Gravity = 0; -9.81\nend\n" +
      rest),
    1e-7);
  compare(
    Site<3>(
      "subsection Domain\n set Size = 4, 4, 4\n set Truncated boundaries = "
      "bottom\nend\nsubsection Mesh\n set Generator = gmsh\n set Size = "
      "1.5\n set Snap = 0\nend\nsubsection Joints\n set Names = a, b\n "
      "subsection a\n  set "
      "Point = 2, 2, 2\n  set Dip = 45\n  set Dip direction = 105\n  set Water "
      "pressure = max(0, 9000*(2.1 - z))\n end\n subsection b\n  set Point = "
      "2, "
      "2, 2\n  set Dip = 70\n  set Dip direction = 235\n  set Water pressure = "
      "3000*x*y\n end\nend\nsubsection Initial state\n set Gravity = 0; 0; "
      "-9.81\nend\n" +
      rest),
    1e-5);
}

BOOST_AUTO_TEST_CASE(slender_blocks_rotate)
{
  // 0.5 m wide and 1 m high: over its edge from atan(0.5) = 26.565 degrees on
  const auto stands = Site<2>(incline(26., 1., "", "")).judge();
  BOOST_TEST(stands.mode() == "sliding on base");
  const auto turns = Site<2>(incline(28., 1., "", "")).judge();
  BOOST_TEST(turns.mode() == "rotating on base");
  BOOST_TEST(turns.limit.factor == 0.);
  std::ostringstream outside;
  outside.precision(4);
  outside << "the resultant passes " << 0.5 * std::tan(28. * radian) - 0.25
          << " m outside the base, which no friction prevents; sliding alone "
          << friction / std::tan(28. * radian);
  BOOST_TEST(has_remark(turns.remark(), outside.str()));
  // the other way round, and by a push near the top
  BOOST_TEST(Site<2>(incline(-28., 1., "", "")).judge().mode() ==
             "rotating on base");
  BOOST_TEST(
    Site<2>(incline(20., 1., "", traction("top", "8000; 0"))).judge().mode() ==
    "rotating on base");
  // water on one half of the base, and tension that holds it
  BOOST_TEST(
    Site<2>(incline(25., 1., "  set Water pressure = 4000*(x < 0)\n", ""))
      .judge()
      .mode() == "rotating on base");
  const auto tied =
    Site<2>(incline(28.,
                    1.,
                    "  set Cohesion = 2e3\n  set Tensile strength = 1e3\n",
                    ""))
      .judge();
  BOOST_TEST(tied.mode() == "sliding on base");
  BOOST_TEST(has_remark(tied.remark(), "tensile strength of base keeps it"));
  BOOST_TEST(has_remark(tied.remark(), "tensile strength of base left out"));
  // 3D: half of 1 m times tan(40 degrees) is within the base, 50 degrees not
  const auto rests = Site<3>(cube("", "")).judge();
  BOOST_TEST(!has_remark(rests.remark() + ".", "outside"));
  const auto tips    = Site<3>(cube("", traction("top", "4000; 0; 0"))).judge();
  const double place = (0.5 * 20e3 * sine + 4000.) / (20e3 * cosine) - 0.5;
  std::ostringstream text;
  text.precision(4);
  text << "the resultant passes " << place << " m outside the base";
  BOOST_TEST(has_remark(tips.remark(), text.str()));
  BOOST_TEST(has_remark(tips.remark(), "its faces, however strong, cannot"));
  BOOST_TEST(tips.mode() == "rotating on base");
  BOOST_TEST(tips.limit.factor == 0.);
}

BOOST_AUTO_TEST_CASE(another_face_keeps_a_wedge_from_rotating)
{
  // corners (0, 0), (2, 0) in the roof and (-1, 1): on the steep joint from the
  // first to the last, weight at x = 1/3 outside the base from -1 to 0
  BlockFace<2> base, back;
  const Point<2> a(0., 0.), b(2., 0.), c(-1., 1.);
  base.name             = "base";
  base.inward           = Tensor<1, 2>({1., 1.}) / std::sqrt(2.);
  base.tangent_friction = friction;
  base.vertices         = {a, c};
  back.name             = "back";
  back.inward           = Tensor<1, 2>({-1., -3.}) / std::sqrt(10.);
  back.vertices         = {b, c};
  const Tensor<1, 2> weight({0., -1.});
  const std::vector<PointForce<2>> forces = {
    {Point<2>(1. / 3., 1. / 3.), weight}};
  auto limit = solve_limit_equilibrium<2>({base, back}, weight);
  BOOST_TEST(limit.describe({base, back}) == "sliding on base");
  auto rotation = judge_rotation<2>({base, back}, forces, limit);
  BOOST_TEST(rotation.is_judged);
  BOOST_TEST(is_near(rotation.outside, std::sqrt(2.) / 3., 1e-12));
  BOOST_TEST(rotation.obstacle == "back");
  BOOST_TEST(is_near(limit.factor, friction, 1e-12));
  // alone it turns; with its weight on the base it slides
  rotation = judge_rotation<2>({base}, forces, limit);
  BOOST_TEST(limit.describe({base}) == "rotating on base");
  limit    = solve_limit_equilibrium<2>({base}, weight);
  rotation = judge_rotation<2>({base}, {{Point<2>(-0.1, 2.), weight}}, limit);
  BOOST_TEST(rotation.outside == 0.);
  BOOST_TEST(limit.describe({base}) == "sliding on base");
}

BOOST_AUTO_TEST_CASE(faces_that_are_no_joint)
{
  // two squares with vertices of their own, the upper one of unlike cells:
  // nothing but free faces with the default friction angle between them
  std::ostringstream vertices, cells;
  unsigned int n_vertices = 0, n_cells = 0;
  for (const unsigned int n : {2u, 3u})
    {
      const unsigned int part = n - 2;
      for (unsigned int j = 0; j <= n; ++j)
        for (unsigned int i = 0; i <= n; ++i)
          vertices << n_vertices + 1 + j * (n + 1) + i << ' ' << double(i) / n
                   << ' ' << part + double(j) / n << " 0\n";
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int i = 0; i < n; ++i)
          {
            const unsigned int v = n_vertices + 1 + j * (n + 1) + i;
            cells << ++n_cells << " 0 quad " << v << ' ' << v + 1 << ' '
                  << v + n + 2 << ' ' << v + n + 1 << '\n';
          }
      n_vertices += (n + 1) * (n + 1);
    }
  const std::string file =
    "block_statics_" + std::to_string(world.size()) + ".ucd";
  if (world.is_root())
    std::ofstream(file) << n_vertices << ' ' << n_cells << " 0 0 0\n"
                        << vertices.str() << cells.str();
  const Site<2> site(
    "subsection Domain\n set Shape = file\n set File = " + file +
    "\n set Truncated boundaries = none\nend\nsubsection Mesh\n set Generator "
    "= file\nend\nsubsection Contact\n set Default friction angle = "
    "35\nend\nsubsection Materials\n set Names = rock\n subsection rock\n  set "
    "Density = 2000\n end\nend\nsubsection Initial state\n set Gravity = "
    "10*sin(40*pi/180); -10*cos(40*pi/180)\nend\n" +
    stage);
  const unsigned int upper = site.blocks.blocks[0].centroid[1] > 1. ? 0 : 1;
  const auto statics       = site.judge(upper);
  BOOST_TEST(statics.mode() == "sliding on a free face");
  BOOST_TEST(is_near(statics.around.faces[0].area, 1., 1e-12));
  BOOST_TEST(is_near(statics.limit.factor,
                     std::tan(35. * radian) / std::tan(40. * radian),
                     1e-12));
  BOOST_TEST(has_remark(statics.remark(), "default friction angle"));
  BOOST_TEST(has_remark(statics.remark(),
                        "rests on block " + std::to_string(2 - upper) +
                          ", taken as fixed"));
}

BOOST_AUTO_TEST_CASE(what_it_meets_on_its_way)
{
  // a slot of 0.1 m between two blocks
  const std::string slot =
    "subsection Excavations\n set Names = uphill, downhill, slot\n subsection "
    "slot\n  set Shape = box\n  set Corner = -0.05, 0\n  set Size = 0.1, "
    "0.1\n end\nend\nsubsection Mesh\n set Cells = 20, 2\nend\n";
  const Site<2> site(incline(40., 0.1, "", slot));
  const unsigned int uphill = site.blocks.blocks[0].centroid[0] < 0. ? 0 : 1;
  BOOST_TEST(
    has_remark(site.judge(uphill).remark(),
               "meets block " + std::to_string(2 - uphill) + " after 0.1 m"));
  BOOST_TEST(site.judge(1 - uphill).remark() == "");
}

BOOST_AUTO_TEST_CASE(corners_meet_first)
{
  // the lower side of a roof block, from 2.75 m at x = -1 down to 2.25 m at
  // x = 1, above a floor at 1.5 m, flat or with a step of 0.3 m below the other
  // end, whose corner is 0.56875 m below the roof
  for (const auto &[floor, way] :
       {std::make_pair("-2, 1.5; 2, 1.5", 0.75),
        std::make_pair("-2, 1.9; 0.125, 1.9; 0.125, 1.5; 2, 1.5", 0.56875)})
    {
      const Site<2> site(
        "subsection Domain\n set Corner = -5, -1\n set Size = 10, 8\nend\n"
        "subsection Mesh\n set Generator = gmsh\n set Size = 0.5\nend\n"
        "subsection Excavations\n set Names = room\n subsection room\n  set "
        "Vertices = " +
        std::string(floor) +
        "; 2, 2; -2, 3\n end\nend\nsubsection Joints\n set Names = left, "
        "right, top\n subsection left\n  set Vertices = -1, 2; -1, 4\n end\n "
        "subsection right\n  set Vertices = 1, 2; 1, 4\n end\n subsection "
        "top\n  set Vertices = -1, 4; 1, 4\n end\nend\nsubsection Materials\n "
        "set Names = rock\nend\nsubsection Initial state\n set Gravity = 0; "
        "-9.81\nend\n" +
        stage);
      const std::string remark = site.judge(0).remark();
      const auto place         = remark.find("meets the rock after ");
      BOOST_REQUIRE(place != std::string::npos);
      BOOST_TEST(is_near(std::stod(remark.substr(place + 21)), way, 5e-3));
    }
}

BOOST_AUTO_TEST_CASE(sheared_support_never_drives)
{
  // a dowel along the plane's normal on a block of 5000 N: as it gets stronger,
  // the factor rises, and then there is none
  const auto dowelled = [&](const double strength, const std::string &more) {
    std::ostringstream text;
    text.precision(17);
    text << "subsection Bolts\n set Names = b\n subsection b\n  set Stage = "
            "rest\n  set Heads = 0, 0.5\n  set Ends = 0, -0.05\n  set Spacing "
            "= 1, 1\n  set Area = 1e-4\n  set Young modulus = 200e9\n  set "
            "Yield force = 1e-6\n  set Bond stiffness = 1e9\n  set Bond "
            "strength = 1e7\n  set Plate strength = 1e6\n  set Dowel stiffness "
            "= 1e6\n  set Dowel strength = "
         << strength << "\n end\nend\n"
         << more;
    return Site<2>(incline(40., 0.5, "", text.str())).judge();
  };
  const std::string passive =
    "subsection Safety factor\n set Bolt convention = passive\nend\n";
  const double driving = 5000. * sine, resisting = 5000. * cosine * friction;
  for (const double share : {0.1, 0.5, 0.95, 0.999})
    {
      const double dowel = share * driving;
      BOOST_TEST(is_near(dowelled(dowel, "").limit.factor,
                         resisting / (driving - dowel),
                         1e-6));
      BOOST_TEST(is_near(dowelled(dowel, passive).limit.factor,
                         (resisting + dowel) / driving,
                         1e-6));
    }
  for (const double share : {1.001, 2., 100.})
    {
      const auto borne = dowelled(share * driving, "");
      BOOST_TEST(borne.mode() == "stable");
      BOOST_TEST(std::isinf(borne.limit.factor));
      BOOST_TEST(has_remark(borne.remark(), "which bears all that drives it"));
      BOOST_TEST(is_near(dowelled(share * driving, passive).limit.factor,
                         (resisting + share * driving) / driving,
                         1e-6));
    }
}

BOOST_AUTO_TEST_CASE(passive_bolt_across_the_way)
{
  // 20 kN on 40 degrees; 5 kN through its centre, a part of it along the
  // strike, which turns the way
  const auto statics =
    Site<3>(cube("",
                 "subsection Bolts\n set Names = b\n subsection b\n  set Stage "
                 "= rest\n  set Heads = 0, 0.08333333333, 0.7\n  set Ends = 0, "
                 "-0.41666666667, -0.5\n  set Area = 1e-4\n  set Young modulus "
                 "= 200e9\n  set "
                 "Yield force = 5e3\n  set Bond stiffness = 1e9\n  set Bond "
                 "strength = 1e7\n  set Plate strength = 1e6\n end\nend\n"
                 "subsection Safety factor\n set Bolt convention = passive\n"
                 "end\n"))
      .judge();
  const double across  = 5e3 * 0.5 / 1.3,
               normal  = 20e3 * cosine + 5e3 * 1.2 / 1.3,
               driving = std::hypot(20e3 * sine, across);
  BOOST_TEST(is_near(statics.limit.driving_force, driving, 1e-9));
  BOOST_TEST(is_near(statics.limit.factor, friction * normal / driving, 1e-9));
}

BOOST_AUTO_TEST_CASE(demand_of_a_block_that_turns)
{
  // 0.5 m wide, 1.6 m high, 16 kN: sliding alone has tan 40 / tan 24 = 1.885.
  // The pressure on its top that turns it back: moments about the lower edge
  const std::string wanted =
    "subsection Safety factor\n set Wanted = 1.3\nend\n";
  const std::string angle = "  set Friction angle = 40\n";
  const auto turns        = Site<2>(incline(24., 1.6, angle, wanted)).judge();
  BOOST_TEST(turns.mode() == "rotating on base");
  BOOST_TEST(is_near(turns.demand.force,
                     16e3 * (1.6 * std::sin(24. * radian) / 0.5 -
                             std::cos(24. * radian)),
                     1e-4));
  BOOST_TEST(is_near(turns.demand.pressure, turns.demand.force / 0.5, 1e-12));
  BOOST_TEST(has_remark(turns.remark(), "a factor of 1.3 asks for"));
  // with that pressure it stands
  const auto push = [](const double pressure) {
    std::ostringstream text;
    text.precision(17);
    text << "0; " << -pressure;
    return traction("top", text.str());
  };
  BOOST_TEST(
    Site<2>(incline(24., 1.6, angle, push(1.001 * turns.demand.pressure)))
      .judge()
      .mode() == "sliding on base");
  BOOST_TEST(
    Site<2>(incline(24., 1.6, angle, push(0.999 * turns.demand.pressure)))
      .judge()
      .mode() == "rotating on base");
  // where sliding asks for more, that counts
  const auto slides =
    Site<2>(incline(24.,
                    1.6,
                    angle,
                    "subsection Safety factor\n set Wanted = 3\nend\n"))
      .judge();
  BOOST_TEST(
    is_near(slides.demand.force,
            16e3 * (3. * std::sin(24. * radian) / std::tan(40. * radian) -
                    std::cos(24. * radian)),
            1e-6));
}

BOOST_AUTO_TEST_CASE(demand_of_a_block_that_water_lifts)
{
  // 1 m by 1 m in the floor, over water of 30 kPa
  const auto floor = [](const double gravity, const std::string &convention) {
    std::ostringstream text;
    text
      << "subsection Domain\n set Corner = -2, -2\n set Size = 4, 2\n set "
         "Truncated boundaries = left, right, bottom\nend\nsubsection Mesh\n "
         "set Cells = 8, 4\nend\nsubsection Joints\n set Names = left, right, "
         "base\n subsection left\n  set Extent = polygon\n  set Vertices = "
         "-0.5, 0; -0.5, -1\n end\n subsection right\n  set Extent = polygon\n "
         " set Vertices = 0.5, 0; 0.5, -1\n end\n subsection base\n  set "
         "Extent = polygon\n  set Vertices = -0.5, -1; 0.5, -1\n  set Water "
         "pressure = 30e3\n end\nend\nsubsection Materials\n set Names = "
         "rock\n subsection rock\n  set Density = 2000\n end\nend\nsubsection "
         "Initial state\n set Gravity = 0; "
      << -gravity
      << "\nend\nsubsection Safety factor\n set Wanted = 1.5\n set Bolt "
         "convention = "
      << convention << "\nend\n"
      << stage;
    return Site<2>(text.str()).judge();
  };
  BOOST_TEST(floor(10., "passive").mode() == "lifting");
  BOOST_TEST(is_near(floor(10., "passive").demand.force, 15e3, 1e-9));
  BOOST_TEST(is_near(floor(10., "active").demand.force, 10e3, 1e-6));
  BOOST_TEST(is_near(floor(0., "passive").demand.force, 45e3, 1e-9));
  BOOST_TEST(is_near(floor(0., "active").demand.force, 30e3, 1e-6));
}

BOOST_AUTO_TEST_CASE(joints_that_are_not_reduced)
{
  // 20 kN in the roof (upside down) between two joints, 10 kN of cohesion on
  // the one that is reduced
  const auto roof = [](const double right, const std::string &safety) {
    std::ostringstream text;
    text << "subsection Domain\n set Corner = -2, -2\n set Size = 4, 2\n set "
            "Truncated boundaries = left, right, bottom\nend\nsubsection "
            "Mesh\n set Cells = 8, 4\nend\nsubsection Joints\n set Names = "
            "left, right, base\n subsection left\n  set Vertices = -0.5, 0; "
            "-0.5, -1\n  set Cohesion = 10e3\n end\n subsection right\n  set "
            "Vertices = 0.5, 0; 0.5, -1\n  set Cohesion = "
         << right
         << "\n end\n subsection base\n  set Vertices = -0.5, -1; 0.5, -1\n "
            "end\nend\nsubsection Materials\n set Names = rock\n subsection "
            "rock\n  set Density = 2000\n end\nend\nsubsection Initial "
            "state\n set Gravity = 0; 10\nend\n"
         << stage << "subsection Safety factor\n"
         << safety << "end\n";
    return Site<2>(text.str()).judge();
  };
  const std::string left    = " set Joints = left\n",
                    wanted  = " set Wanted = 1.5\n",
                    passive = " set Bolt convention = passive\n";
  BOOST_TEST(is_near(roof(6e3, "").limit.factor, 16. / 20., 1e-9));
  const auto split = roof(6e3, left);
  BOOST_TEST(is_near(split.limit.factor, 10. / (20. - 6.), 1e-9));
  BOOST_TEST(has_remark(split.remark(), "strength of right not reduced"));
  BOOST_TEST(is_near(roof(6e3, left + wanted).demand.force,
                     20e3 - 6e3 - 10e3 / 1.5,
                     1e-9));
  BOOST_TEST(is_near(roof(6e3, left + wanted + passive).demand.force,
                     1.5 * (20e3 - 6e3) - 10e3,
                     1e-9));
  const auto held = roof(21e3, left);
  BOOST_TEST(std::isinf(held.limit.factor));
  BOOST_TEST(held.mode() == "falling");
  BOOST_TEST(has_remark(held.remark(), "which bears all that drives it"));
}

BOOST_AUTO_TEST_CASE(stress_ratio_of_a_block_that_leaves_its_faces)
{
  // in a roof between two sides that lean outwards by @p lean [deg] upwards,
  // with a normal and a shear force on each, under a seam with cohesion
  const double N = 50e3, T = 5e3;
  const auto ratio = [&](const double lean, const bool is_seam_open) {
    std::vector<BlockFace<2>> faces(3);
    std::vector<JointSums<2>> sums(4);
    for (unsigned int i = 0; i < 3; ++i)
      {
        faces[i].joint            = i;
        faces[i].tangent_friction = friction;
        faces[i].area             = 1.;
        if (i == 2)
          break;
        const double sign = i == 0 ? 1. : -1., s = std::sin(lean * radian),
                     c     = std::cos(lean * radian);
        faces[i].inward    = Tensor<1, 2>({sign * c, -s});
        sums[i].force      = {{sign * (N * c + T * s), T * c - N * s}};
        sums[i].n_sticking = 4;
      }
    faces[2].inward   = Tensor<1, 2>({0., -1.});
    faces[2].cohesion = 100e3;
    (is_seam_open ? sums[2].n_open : sums[2].n_sticking) = 4;
    if (!is_seam_open)
      sums[2].force = {{100., 200.}};
    const auto limit =
      solve_limit_equilibrium<2>(faces, Tensor<1, 2>({0., -10e3}));
    BOOST_TEST(limit.describe(faces) == "falling");
    return stress_ratio<2>(faces, limit, sums);
  };
  for (const double lean : {0., 10., 30.})
    for (const bool is_seam_open : {true, false})
      BOOST_TEST(is_near(ratio(lean, is_seam_open), N * friction / T, 1e-12));
}

BOOST_AUTO_TEST_CASE(free_areas_between_planes)
{
  // a wedge in a floor whose mesh is a tenth too narrow, pulled up by a
  // traction on its top, the triangle that the planes cut out of it
  const auto plane =
    [](const std::string &name, const double dip, const double dip_direction) {
      return " subsection " + name +
             "\n  set Point = 0.13, -0.21, -1\n  set Dip = " +
             std::to_string(dip) +
             "\n  set Dip direction = " + std::to_string(dip_direction) +
             "\n end\n";
    };
  Site<3> site(
    "subsection Domain\n set Corner = -3, -3, -2.5\n set Size = 6, 6, 2.5\n "
    "set Truncated boundaries = left, right, front, back, "
    "bottom\nend\nsubsection Mesh\n set Generator = gmsh\n set Size = "
    "0.8\nend\nsubsection Joints\n set Names = a, b, c\n" +
    plane("a", 64.3, 53.3) + plane("b", 69.8, 209.3) + plane("c", 58.2, 336.) +
    "end\nsubsection Materials\n set Names = rock\n subsection rock\n  set "
    "Density = 2500\n end\nend\nsubsection Initial state\n set Gravity = 0; 0; "
    "-9.81\nend\nsubsection Safety factor\n set Wanted = 1.5\nend\n" +
    traction("top", "2000; -5000; 15000") + stage);
  const auto &joints = site.scene.joints;
  std::array<Tensor<1, 3>, 3> corners; // from the tip
  for (unsigned int i = 0; i < 3; ++i)
    {
      corners[i] =
        cross_product_3d(joints[i]->normal(), joints[(i + 1) % 3]->normal());
      corners[i] /= corners[i][2];
    }
  const double area =
    0.5 *
    cross_product_3d(corners[1] - corners[0], corners[2] - corners[0]).norm();
  for (Point<3> &p : site.split.mesh.vertices)
    for (unsigned int d = 0; d < 2; ++d)
      p[d] *= 0.9;
  const auto statics = site.judge();
  BOOST_TEST(is_near(site.blocks.blocks[0].exact.volume, area / 3., 1e-9));
  const Tensor<1, 3> pulled({2000. * area, -5000. * area, 15000. * area});
  BOOST_TEST((sum_of(statics.around.loads.tractions) - pulled).norm() <
             1e-9 * pulled.norm());
  BOOST_TEST(statics.demand.force > 0.);
  BOOST_TEST(
    is_near(statics.demand.force / statics.demand.pressure, area, 1e-9));
}

BOOST_AUTO_TEST_SUITE_END()
