// SPDX-License-Identifier: LGPL-2.1-or-later
// Joint pyramids, and which of them are removable where.
#include <boost/test/unit_test.hpp>

#include <keyblock/safety/block_theory.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <map>
#include <random>
#include <sstream>

BOOST_AUTO_TEST_SUITE(block_theory)

using namespace Keyblock;

namespace
{
  const double infinity = std::numeric_limits<double>::infinity();

  using Orientations = std::vector<std::pair<double, double>>;

  /** Add infinite joints of these dips and dip directions [deg] through the
   * origin, called by their number, friction 30 degrees. */
  template <int dim>
  void
  add_joints(Scene<dim> &scene, const Orientations &orientations)
  {
    for (const auto &[dip, dip_direction] : orientations)
      {
        scene.joints.push_back(std::make_unique<Joint<dim>>());
        Joint<dim> &joint   = *scene.joints.back();
        joint.name          = std::to_string(scene.joints.size());
        joint.dip           = dip;
        joint.dip_direction = dip_direction;
      }
  }

  template <int dim>
  BlockTheory<dim>
  theory_of(const Orientations &orientations,
            const BlockTheorySettings &settings = BlockTheorySettings())
  {
    Scene<dim> scene;
    add_joints(scene, orientations);
    return find_block_theory(scene, settings);
  }

  const Orientations four_sets = {{71., 163.},
                                  {68., 243.},
                                  {45., 280.},
                                  {13., 343.}};

  template <int dim>
  const FreeFace<dim> &
  face_called(const BlockTheory<dim> &theory, const std::string &name)
  {
    for (const FreeFace<dim> &face : theory.faces)
      if (face.name == name)
        return face;
    throw std::runtime_error("no face called " + name);
  }

  /** Mode and factor by code. */
  using Removable = std::map<std::string, std::pair<std::string, double>>;

  template <int dim>
  void
  check_face(const BlockTheory<dim> &theory,
             const std::string &name,
             const Removable &expected)
  {
    const FreeFace<dim> &face = face_called(theory, name);
    BOOST_TEST_CONTEXT(name)
    {
      BOOST_TEST(face.removable.size() == expected.size());
      double previous = 0.;
      for (const unsigned int p : face.removable)
        {
          const JointPyramid &pyramid = theory.pyramids[p];
          BOOST_TEST(expected.count(pyramid.code) == 1);
          if (expected.count(pyramid.code) == 0)
            continue;
          const auto &[mode, factor] = expected.at(pyramid.code);
          BOOST_TEST(pyramid.mode == mode);
          BOOST_TEST((pyramid.factor == factor ||
                      std::abs(pyramid.factor - factor) <= 5e-6));
          BOOST_TEST(pyramid.factor >= previous);
          previous = pyramid.factor;
        }
    }
  }
} // namespace

BOOST_AUTO_TEST_CASE(four_sets_around_an_opening)
{
  const auto theory = theory_of<3>(four_sets);
  BOOST_TEST(theory.remark == "");
  BOOST_TEST(theory.pyramids.size() == 16);
  for (const JointPyramid &pyramid : theory.pyramids)
    BOOST_TEST(pyramid.is_empty ==
               (pyramid.code == "0101" || pyramid.code == "1010"));
  check_face(theory,
             "roof",
             {{"1011", {"sliding on 2", 0.23326}},
              {"1101", {"sliding on 2/3", 1.41479}}});
  check_face(theory,
             "floor",
             {{"0010", {"stable", infinity}}, {"0100", {"stable", infinity}}});
  check_face(theory,
             "wall facing 0",
             {{"1100", {"sliding on 4", 2.50078}},
              {"1101", {"sliding on 2/3", 1.41479}},
              {"1110", {"sliding on 3/4", 2.95671}}});
  check_face(theory,
             "wall facing 180",
             {{"0001", {"sliding on 1/3", 1.07713}},
              {"0010", {"stable", infinity}},
              {"0011", {"sliding on 1/2", 0.35339}}});
}

BOOST_AUTO_TEST_CASE(level_edge_makes_a_block_infinite)
{
  // sets 1 and 4 strike alike: their line is level and lies in roof and floor
  Orientations turned = four_sets;
  const auto level    = theory_of<3>(turned);
  turned[0].second += 0.01;
  const auto inclined = theory_of<3>(turned);
  for (const char *const face : {"roof", "floor"})
    {
      BOOST_TEST(face_called(level, face).removable.size() == 2);
      BOOST_TEST(face_called(inclined, face).removable.size() == 3);
    }
}

BOOST_AUTO_TEST_CASE(number_of_joint_pyramids)
{
  std::mt19937 random(4);
  std::uniform_real_distribution<double> cosine(0., 1.), azimuth(0., 360.);
  for (unsigned int n = 1; n <= 8; ++n)
    for (unsigned int trial = 0; trial < 5; ++trial)
      {
        Orientations orientations, lines;
        for (unsigned int i = 0; i < n; ++i)
          {
            orientations.push_back(
              {std::acos(cosine(random)) * 180. / dealii::numbers::PI,
               azimuth(random)});
            lines.push_back({90. * cosine(random), i % 2 ? 90. : 270.});
          }
        BlockTheorySettings settings;
        settings.walls   = {azimuth(random)};
        const auto space = theory_of<3>(orientations, settings);
        BOOST_TEST(space.pyramids.size() - space.n_empty() == n * n - n + 2);
        // a plane cuts 2 n of the pyramids; half of the others are on its side
        for (const FreeFace<3> &face : space.faces)
          BOOST_TEST(face.removable.size() == (n - 1) * (n - 2) / 2);
        const auto plane = theory_of<2>(lines);
        BOOST_TEST(plane.pyramids.size() - plane.n_empty() == 2 * n);
        for (const FreeFace<2> &face : plane.faces)
          BOOST_TEST(face.removable.size() == n - 1);
      }
}

// the cone of two opposite half-spaces and others that meet in a ray is no
// block
BOOST_AUTO_TEST_CASE(pyramids_of_planes_through_one_line)
{
  BlockTheorySettings settings;
  settings.roof_span   = 4.;
  const Orientations e = {
    {60., 0.}, {60., 120.}, {60., 240.}, {90., 30.}, {0., 0.}};
  const auto theory = theory_of<3>(e, settings);
  for (const FreeFace<3> &face : theory.faces)
    for (const unsigned int p : face.removable)
      {
        // what moves off moves off all of them
        const auto inward =
          inward_normals(theory.sets, theory.pyramids[p].code);
        double best = -1.;
        for (int i = -60; i <= 60; ++i)
          for (int j = 0; j < 360; ++j)
            {
              const double z = i / 60.5, r = std::sqrt(1. - z * z),
                           turn = j * dealii::numbers::PI / 180.;
              const Tensor<1, 3> d({r * std::cos(turn), r * std::sin(turn), z});
              double least = 1.;
              for (const Tensor<1, 3> &n : inward)
                least = std::min(least, n * d);
              best = std::max(best, least);
            }
        BOOST_TEST_INFO(face.name << ' ' << theory.pyramids[p].code);
        BOOST_TEST(best > 0.05);
        if (face.name == "roof")
          {
            const RoofWedge wedge =
              find_largest_roof_wedge(theory.sets,
                                      theory.pyramids[p].code,
                                      settings);
            BOOST_TEST(wedge.height < 100.);
            BOOST_TEST(wedge.volume > 0.01);
          }
      }
}

BOOST_AUTO_TEST_CASE(two_lines_over_a_tunnel)
{
  const auto theory    = theory_of<2>({{70., 90.}, {50., 270.}});
  const double tangent = std::tan(30. * dealii::numbers::PI / 180.);
  check_face(theory, "roof", {{"11", {"falling", 0.}}});
  check_face(theory, "floor", {{"00", {"stable", infinity}}});
  const auto slope = [&](const double dip) {
    return tangent / std::tan(dip * dealii::numbers::PI / 180.);
  };
  check_face(theory, "wall facing 90", {{"01", {"sliding on 1", slope(70.)}}});
  check_face(theory, "wall facing 270", {{"10", {"sliding on 2", slope(50.)}}});
  BOOST_TEST(theory.faces.size() == 4);
}

BOOST_AUTO_TEST_CASE(largest_wedge_in_a_roof)
{
  BlockTheorySettings settings;
  settings.roof_span = 5.;
  const auto theory =
    theory_of<3>({{60., 30.}, {60., 150.}, {60., 270.}}, settings);
  check_face(theory, "roof", {{"111", {"falling", 0.}}});
  const RoofWedge wedge =
    find_largest_roof_wedge(theory.sets, "111", theory.settings);
  BOOST_TEST(std::abs(wedge.volume - 13.888889) <= 5e-7);
  BOOST_TEST(std::abs(wedge.height - 2.886751) <= 5e-7);
  const double side = std::sqrt(wedge.area * 4. / std::sqrt(3.));
  BOOST_TEST(std::abs(side - 5.773503) <= 5e-7);
  // along an axis E-W a side of the triangle fills the width
  settings.roof_axis = 90.;
  const double turned =
    find_largest_roof_wedge(theory.sets, "111", settings).volume;
  BOOST_TEST(std::abs(turned / 13.888889 - std::pow(0.75, 1.5)) <= 1e-6);
}

BOOST_AUTO_TEST_CASE(sets_are_those_of_the_scene)
{
  Scene<3> scene;
  add_joints(scene, four_sets);
  // a joint parallel to the first, the other way up, smoother; and a finite one
  scene.joints.push_back(std::make_unique<Joint<3>>());
  scene.joints.back()->name           = "parallel";
  const Tensor<1, 3> normal           = -scene.joints[0]->normal();
  scene.joints.back()->normal_entry   = {normal[0], normal[1], normal[2]};
  scene.joints.back()->friction_angle = 20.;
  scene.joints.push_back(std::make_unique<Joint<3>>());
  scene.joints.back()->extent = JointShape::disc;
  auto theory                 = find_block_theory(scene, BlockTheorySettings());
  BOOST_TEST(theory.sets.size() == 4);
  BOOST_TEST(theory.sets[0].friction_angle == 20.);
  BOOST_TEST(theory.sets[1].friction_angle == 30.);
  // gravity upwards turns roof into floor
  scene.initial_state.gravity = "0; 0; 9.81";
  theory                      = find_block_theory(scene, BlockTheorySettings());
  for (const unsigned int p : face_called(theory, "roof").removable)
    BOOST_TEST(theory.pyramids[p].mode == "stable");
  theory = theory_of<3>({{10., 0.},
                         {20., 40.},
                         {30., 80.},
                         {40., 120.},
                         {50., 160.},
                         {60., 200.},
                         {70., 240.},
                         {80., 280.},
                         {85., 320.}});
  BOOST_TEST(theory.pyramids.empty());
  BOOST_TEST(theory.remark == "The report of block theory is for at most 8 "
                              "joint sets, and the scene has 9.");
}

BOOST_AUTO_TEST_CASE(report_of_block_theory)
{
  BlockTheorySettings settings;
  settings.walls     = {0., 180.};
  settings.roof_span = 5.;
  const auto theory  = theory_of<3>(four_sets, settings);
  std::ostringstream out;
  print_block_theory(out, theory);
  for (const char *const text :
       {"14 of 16 joint pyramids are not empty; tapered: 0101 1010\n",
        "    2  2                    68.0          243.0            30.0\n",
        "  roof              1011         0.233  sliding on 2; at most ",
        "  floor             stable: 0010 0100\n",
        "  wall facing 180   0011         0.353  sliding on 1/2\n"})
    BOOST_TEST((out.str().find(text) != std::string::npos), text);
  const auto json = block_theory_as_json(theory);
  BOOST_TEST(json.at("joint_pyramids").size() == 16);
  const auto &roof = json.at("faces").front();
  BOOST_TEST(roof.at("face").get<std::string>() == "roof");
  BOOST_TEST(roof.at("removable").front().get<std::string>() == "1011");
  BOOST_TEST(roof.at("largest_volumes").size() == 2);
}

BOOST_AUTO_TEST_SUITE_END()
