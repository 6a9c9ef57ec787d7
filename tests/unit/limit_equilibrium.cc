// SPDX-License-Identifier: LGPL-2.1-or-later
// Modes and factors of rigid blocks against closed forms and the literature.
#include <boost/test/unit_test.hpp>

#include <keyblock/safety/limit_equilibrium.h>

#include <array>
#include <cmath>

BOOST_AUTO_TEST_SUITE(limit_equilibrium)

using namespace Keyblock;
using dealii::Tensor;

namespace
{
  constexpr double radian = 3.14159265358979323846 / 180.;
  using Mode              = LimitEquilibrium<3>::Mode;
  const Tensor<1, 3> down({0., 0., -1.});

  /** Unit normal, upwards, of a plane of that dip and dip direction [deg]. */
  Tensor<1, 3>
  upward(const double dip, const double dip_direction)
  {
    return Tensor<1, 3>(
      {std::sin(dip * radian) * std::sin(dip_direction * radian),
       std::sin(dip * radian) * std::cos(dip_direction * radian),
       std::cos(dip * radian)});
  }

  /** A face without cohesion and water under a block. */
  template <int dim>
  BlockFace<dim>
  face(const Tensor<1, dim> &inward,
       const double friction_angle,
       const std::string &name = "")
  {
    BlockFace<dim> result;
    result.inward           = inward;
    result.area             = 1.;
    result.tangent_friction = std::tan(friction_angle * radian);
    result.name             = name;
    return result;
  }

  /** A plane under a 2D block, which descends towards +x (negative: -x). */
  BlockFace<2>
  incline(const double dip, const double friction_angle)
  {
    return face(Tensor<1, 2>({std::sin(dip * radian), std::cos(dip * radian)}),
                friction_angle,
                "incline");
  }

  bool
  is_near(const double value, const double reference, const double tolerance)
  {
    BOOST_TEST_INFO(value << " instead of " << reference);
    return std::abs(value - reference) <= tolerance;
  }

  /** The wedge of Hoek and Bray in feet and pounds. */
  struct RoadWedge
  {
    std::vector<BlockFace<3>> faces;
    double volume                  = 0.;
    static constexpr double height = 130., weight = 160., water = 62.5;

    RoadWedge(const bool is_wet)
      : faces{face(upward(45., 105.), 30., "A"),
              face(upward(70., 235.), 20., "B")}
    {
      faces[0].cohesion = 500.;
      faces[1].cohesion = 1000.;
      // toe at the origin, back end of the line of intersection at the height
      const Tensor<1, 3> face_normal  = upward(65., 185.),
                         upper_normal = upward(12., 195.);
      Tensor<1, 3> back = cross_product_3d(faces[0].inward, faces[1].inward);
      back *= height / back[2];
      const double upper_offset = upper_normal * back;
      std::array<Tensor<1, 3>, 2> crest;
      for (unsigned int i = 0; i < 2; ++i)
        {
          crest[i] = cross_product_3d(faces[i].inward, face_normal);
          crest[i] *= upper_offset / (upper_normal * crest[i]);
          faces[i].area = 0.5 * cross_product_3d(back, crest[i]).norm();
          // pressure peaks along the line of intersection, none at the edges
          faces[i].water_force =
            is_wet ? 0.5 * water * height / 3. * faces[i].area : 0.;
        }
      volume = std::abs(cross_product_3d(crest[0], crest[1]) * back) / 6.;
    }

    LimitEquilibrium<3>
    solve() const
    {
      return solve_limit_equilibrium<3>(faces, weight * volume * down);
    }
  };
} // namespace

BOOST_AUTO_TEST_CASE(wedge_on_two_planes)
{
  // the sliding wedge of the 3DEC verification
  const std::vector<BlockFace<3>> faces = {face(upward(40., 130.), 30., "A"),
                                           face(upward(60., 220.), 30., "B")};
  const auto result = solve_limit_equilibrium<3>(faces, down);
  BOOST_TEST((result.mode == Mode::two_planes));
  BOOST_TEST(result.describe(faces) == "sliding on A/B");
  const Tensor<1, 3> &s = result.direction;
  BOOST_TEST(is_near(std::asin(-s[2]) / radian, 37.0583, 5e-5));
  BOOST_TEST(is_near(std::atan2(s[0], s[1]) / radian, 155.8481, 5e-5));
  BOOST_TEST(is_near(result.normal_forces[0], 0.673312, 5e-7));
  BOOST_TEST(is_near(result.normal_forces[1], 0.242106, 5e-7));
  BOOST_TEST(is_near(result.driving_force, 0.602627, 5e-7));
  BOOST_TEST(is_near(result.factor, 0.877022, 5e-7));
  const double critical = std::atan(std::tan(30. * radian) / result.factor);
  BOOST_TEST(is_near(critical / radian, 33.3572, 5e-5));
  // acceleration and distance after 1 s if it slides under 25 degrees
  const std::vector<BlockFace<3>> smooth = {face(upward(40., 130.), 25.),
                                            face(upward(60., 220.), 25.)};
  const auto moving         = solve_limit_equilibrium<3>(smooth, 9.81 * down);
  const double acceleration = moving.driving_force * (1. - moving.factor);
  BOOST_TEST(is_near(acceleration, 1.724211, 5e-7));
  BOOST_TEST(is_near(0.5 * acceleration, 0.862105, 5e-7));
}

BOOST_AUTO_TEST_CASE(wedge_with_cohesion_and_water)
{
  const auto wet = RoadWedge(true).solve(), dry = RoadWedge(false).solve();
  BOOST_TEST((wet.mode == Mode::two_planes));
  BOOST_TEST(is_near(wet.factor, 1.34597, 5e-6));
  BOOST_TEST(is_near(dry.factor, 1.9732, 5e-5));
  // the dimensionless numbers of the published formula
  const RoadWedge wedge(false);
  const double scale = wedge.weight * wedge.height / (3. * dry.driving_force);
  BOOST_TEST(is_near(scale * wedge.faces[0].area, 3.40163, 5e-6));
  BOOST_TEST(is_near(scale * wedge.faces[1].area, 3.42803, 5e-6));
  for (unsigned int i = 0; i < 2; ++i)
    BOOST_TEST(is_near(dry.normal_forces[i] / dry.driving_force,
                       i == 0 ? 1.54034 : 0.94567,
                       5e-6));
}

BOOST_AUTO_TEST_CASE(joint_pyramids_of_four_sets)
{
  const std::array<Tensor<1, 3>, 4> normal = {{upward(71., 163.),
                                               upward(68., 243.),
                                               upward(45., 280.),
                                               upward(13., 343.)}};
  struct Case
  {
    const char *code, *mode;
    double factor;
  };
  for (const Case &c : {Case{"1011", "sliding on 2", 0.23326},
                        {"1101", "sliding on 2/3", 1.41479},
                        {"0010", "stable", 0.},
                        {"0100", "stable", 0.},
                        {"1100", "sliding on 4", 2.50078},
                        {"1110", "sliding on 3/4", 2.95671},
                        {"0001", "sliding on 1/3", 1.07713},
                        {"0011", "sliding on 1/2", 0.35339}})
    {
      std::vector<BlockFace<3>> faces;
      for (unsigned int i = 0; i < 4; ++i)
        faces.push_back(face((c.code[i] == '0' ? 1. : -1.) * normal[i],
                             30.,
                             std::to_string(i + 1)));
      const auto result = solve_limit_equilibrium<3>(faces, down);
      BOOST_TEST(result.describe(faces) == c.mode);
      if (result.mode == Mode::stable)
        BOOST_TEST(std::isinf(result.factor));
      else
        BOOST_TEST(is_near(result.factor, c.factor, 5e-6));
    }
}

BOOST_AUTO_TEST_CASE(roof_wedge_falls_or_is_lifted)
{
  // three joints of 60 degrees that meet above it
  std::vector<BlockFace<3>> faces = {face(-upward(60., 30.), 30., "1"),
                                     face(-upward(60., 150.), 30., "2"),
                                     face(-upward(60., 270.), 30., "3")};
  auto result                     = solve_limit_equilibrium<3>(faces, down);
  BOOST_TEST((result.mode == Mode::falling));
  BOOST_TEST(result.factor == 0.);
  BOOST_TEST(is_near(result.driving_force, 1., 1e-15));
  BOOST_TEST(is_near(result.direction * down, 1., 1e-15));
  // upside down it rests until water of uniform pressure carries it
  for (auto &one : faces)
    one.inward *= -1.;
  result = solve_limit_equilibrium<3>(faces, down);
  BOOST_TEST((result.mode == Mode::stable));
  for (const double uplift : {0.99, 1.01})
    {
      for (auto &one : faces)
        one.water_force = uplift / (3. * std::cos(60. * radian));
      result = solve_limit_equilibrium<3>(faces, down);
      BOOST_TEST((result.mode == Mode::lifting) == (uplift > 1.));
    }
  BOOST_TEST(result.factor == 0.);
  BOOST_TEST(is_near(result.driving_force, 0.01, 1e-14));
}

BOOST_AUTO_TEST_CASE(one_plane_with_cohesion_water_and_earthquake)
{
  BlockFace<3> base        = face(upward(35., 120.), 30., "base");
  base.area                = 2.;
  base.cohesion            = 0.1;
  base.water_force         = 0.2;
  const double coefficient = 0.15;
  const Tensor<1, 3> load  = down + coefficient * upward(90., 120.);
  const double sine = std::sin(35. * radian), cosine = std::cos(35. * radian);
  const auto result = solve_limit_equilibrium<3>({base}, load);
  BOOST_TEST((result.mode == Mode::one_plane));
  const double normal = cosine - coefficient * sine - 0.2;
  const double shear  = sine + coefficient * cosine;
  BOOST_TEST(is_near(result.normal_forces[0], normal, 1e-14));
  BOOST_TEST(is_near(result.driving_force, shear, 1e-14));
  BOOST_TEST(is_near(result.factor,
                     (0.2 + normal * std::tan(30. * radian)) / shear,
                     1e-14));
}

BOOST_AUTO_TEST_CASE(cohesion_on_faces_along_the_motion)
{
  // sides along the direction of sliding, neither pressed nor opened; the joint
  // behind opens
  std::vector<BlockFace<3>> faces = {face(upward(35., 90.), 30., "base"),
                                     face(upward(90., 0.), 30., "side"),
                                     face(-upward(90., 0.), 30., "side"),
                                     face(upward(90., 90.), 30., "back")};
  for (unsigned int i = 1; i < 4; ++i)
    faces[i].cohesion = 0.05;
  const auto result = solve_limit_equilibrium<3>(faces, down);
  BOOST_TEST((result.mode == Mode::one_plane));
  BOOST_TEST(result.faces.size() == 3);
  BOOST_TEST(result.describe(faces) == "sliding on base");
  BOOST_TEST(is_near(result.factor,
                     std::tan(30. * radian) / std::tan(35. * radian) +
                       0.1 / std::sin(35. * radian),
                     1e-14));
  // a prism between vertical joints hangs by their cohesion
  faces.erase(faces.begin());
  const auto prism = solve_limit_equilibrium<3>(faces, down);
  BOOST_TEST((prism.mode == Mode::falling));
  BOOST_TEST(is_near(prism.factor, 0.15, 1e-14));
}

BOOST_AUTO_TEST_CASE(pieces_of_one_plane_share_its_force)
{
  // a base of two joints of 1 and 3 m2 besides one that stands across
  std::vector<BlockFace<3>> faces = {face(upward(35., 90.), 20., "weak"),
                                     face(upward(90., 90.), 30., "back"),
                                     face(upward(35., 90.), 40., "strong")};
  faces[2].area                   = 3.;
  faces[0].cohesion               = 0.1;
  const auto result               = solve_limit_equilibrium<3>(faces, down);
  BOOST_TEST(result.describe(faces) == "sliding on weak/strong");
  BOOST_TEST(result.n_pressed == 2);
  const double normal = std::cos(35. * radian);
  BOOST_TEST(is_near(result.normal_forces[0], 0.25 * normal, 1e-14));
  BOOST_TEST(is_near(result.factor,
                     (0.1 + normal * (0.25 * std::tan(20. * radian) +
                                      0.75 * std::tan(40. * radian))) /
                       std::sin(35. * radian),
                     1e-14));
}

BOOST_AUTO_TEST_CASE(pinned_blocks_are_stable)
{
  // the wedge between two planes with a joint across its way
  const std::vector<BlockFace<3>> faces = {face(upward(40., 130.), 0.),
                                           face(upward(60., 220.), 0.),
                                           face(-upward(90., 155.8481), 0.)};
  const auto result = solve_limit_equilibrium<3>(faces, down);
  BOOST_TEST((result.mode == Mode::stable));
  BOOST_TEST(std::isinf(result.factor));
  BOOST_TEST(result.describe(faces) == "stable");
  // weight straight onto a plane, and no load at all
  const std::vector<BlockFace<3>> floor = {face(-down, 0.)};
  BOOST_TEST(std::isinf(solve_limit_equilibrium<3>(floor, down).factor));
  BOOST_TEST(
    std::isinf(solve_limit_equilibrium<3>(floor, Tensor<1, 3>()).factor));
}

BOOST_AUTO_TEST_CASE(blocks_in_the_plane)
{
  using Mode2 = LimitEquilibrium<2>::Mode;
  const Tensor<1, 2> weight({0., -1.});
  for (const auto &[friction_angle, factor] :
       {std::array<double, 2>{{25., 0.555724}},
        {{30., 0.688059}},
        {{35., 0.834475}}})
    {
      const std::vector<BlockFace<2>> faces = {incline(40., friction_angle)};
      const auto result = solve_limit_equilibrium<2>(faces, weight);
      BOOST_TEST((result.mode == Mode2::one_plane));
      BOOST_TEST(result.describe(faces) == "sliding on incline");
      BOOST_TEST(is_near(result.factor, factor, 5e-7));
      BOOST_TEST(is_near(result.direction[0], std::cos(40. * radian), 1e-14));
    }
  // in a trough, in a roof, and in a roof on one steep side
  const BlockFace<2> left = incline(50., 30.), right = incline(-70., 30.);
  BOOST_TEST(
    std::isinf(solve_limit_equilibrium<2>({left, right}, weight).factor));
  BlockFace<2> left_roof = left, right_roof = right;
  left_roof.inward *= -1.;
  right_roof.inward *= -1.;
  const auto fall = solve_limit_equilibrium<2>({left_roof, right_roof}, weight);
  BOOST_TEST((fall.mode == Mode2::falling));
  BOOST_TEST(fall.factor == 0.);
  // the same scene, turned: the weight tells down
  for (const double angle : {90., 137., 180.})
    {
      const double s = std::sin(angle * radian), c = std::cos(angle * radian);
      const auto turned = [s, c](const Tensor<1, 2> &v) {
        return Tensor<1, 2>({c * v[0] - s * v[1], s * v[0] + c * v[1]});
      };
      BlockFace<2> first = left_roof, second = right_roof;
      first.inward  = turned(left_roof.inward);
      second.inward = turned(right_roof.inward);
      for (const bool is_pushed : {false, true})
        {
          // or thrown up by more than its weight
          const Tensor<1, 2> load = turned(is_pushed ? -2. * weight : weight);
          if (is_pushed)
            {
              first.inward *= -1.;
              second.inward *= -1.;
            }
          auto motion = solve_limit_equilibrium<2>({first, second}, load);
          motion.orient(turned(weight));
          BOOST_TEST(
            (motion.mode == (is_pushed ? Mode2::lifting : Mode2::falling)));
        }
    }
  const auto slide = solve_limit_equilibrium<2>({right_roof, left}, weight);
  BOOST_TEST((slide.mode == Mode2::one_plane));
  BOOST_TEST(slide.faces[0] == 1);
  BOOST_TEST(is_near(slide.factor,
                     std::tan(30. * radian) / std::tan(50. * radian),
                     1e-14));
}

BOOST_AUTO_TEST_CASE(factors_divide_the_strength_of_reduced_faces_alone)
{
  // a trough between two planes at 50 degrees about its line, with friction and
  // cohesion of their own; what drives along the line is 3, what presses 4
  const double steep              = 50. * radian;
  std::vector<BlockFace<3>> faces = {
    face(Tensor<1, 3>({std::sin(steep), 0., std::cos(steep)}), 30., "A"),
    face(Tensor<1, 3>({-std::sin(steep), 0., std::cos(steep)}), 20., "B")};
  faces[0].cohesion = 0.5;
  faces[1].cohesion = 0.2;
  const Tensor<1, 3> load({0., 3., -4.});
  const double normal     = 4. / (2. * std::cos(steep));
  const double resists[2] = {0.5 + normal * std::tan(30. * radian),
                             0.2 + normal * std::tan(20. * radian)};
  for (const unsigned int fixed : {0, 1})
    {
      faces[fixed].is_reduced     = false;
      faces[1 - fixed].is_reduced = true;
      const auto result           = solve_limit_equilibrium<3>(faces, load);
      BOOST_TEST((result.mode == Mode::two_planes));
      BOOST_TEST(is_near(result.factor,
                         resists[1 - fixed] / (3. - resists[fixed]),
                         1e-12));
    }
  // one that bears all
  faces[1].cohesion = 2.;
  const auto held   = solve_limit_equilibrium<3>(faces, load);
  BOOST_TEST((held.mode == Mode::two_planes));
  BOOST_TEST(held.is_held_by_fixed());
  BOOST_TEST(std::isinf(held.factor));

  // a slab on a plane beside a wall that it moves along
  std::vector<BlockFace<3>> slab = {
    face(Tensor<1, 3>({0., 0., 1.}), 30., "base"),
    face(Tensor<1, 3>({1., 0., 0.}), 0., "wall")};
  slab[1].cohesion   = 1.;
  slab[1].is_reduced = false;
  const double base  = 4. * std::tan(30. * radian);
  BOOST_TEST(is_near(solve_limit_equilibrium<3>(slab, load).factor,
                     base / (3. - 1.),
                     1e-12));
  std::swap(slab[0].is_reduced, slab[1].is_reduced);
  BOOST_TEST(is_near(solve_limit_equilibrium<3>(slab, load).factor,
                     1. / (3. - base),
                     1e-12));
}

BOOST_AUTO_TEST_SUITE_END()
