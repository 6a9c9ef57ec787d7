// SPDX-License-Identifier: LGPL-2.1-or-later
// How strong joints are, and that the friction law keeps to it.
#include <boost/test/unit_test.hpp>

#include <keyblock/law/friction.h>
#include <keyblock/law/joint_law.h>
#include <keyblock/safety/limit_equilibrium.h>

#include <cmath>
#include <random>

BOOST_AUTO_TEST_SUITE(joint_law)

using namespace Keyblock;
using dealii::Tensor;

namespace
{
  JointStrength
  some_joint()
  {
    JointStrength entries;
    entries.friction_angle         = 35.;
    entries.kinetic_friction_angle = 25.;
    entries.cohesion               = 2e5;
    entries.residual_cohesion      = 5e4;
    entries.tensile_strength       = 1e5;
    return entries;
  }

  JointStrength
  some_joint_without_kinetic()
  {
    JointStrength entries          = some_joint();
    entries.kinetic_friction_angle = -1.;
    return entries;
  }
} // namespace

BOOST_AUTO_TEST_CASE(joint_law_by_state)
{
  const auto law                = make_joint_law(some_joint());
  const StrengthEnvelope intact = law->envelope({true, false}),
                         slid   = law->envelope({false, false}),
                         opened = law->envelope({false, true});
  BOOST_TEST(intact.static_tangent == 0.7002075382,
             boost::test_tools::tolerance(1e-9));
  BOOST_TEST(intact.kinetic_tangent == 0.4663076582,
             boost::test_tools::tolerance(1e-9));
  BOOST_TEST(intact.cohesion == 2e5);
  BOOST_TEST(intact.tensile_strength == 1e5);
  BOOST_TEST(slid.cohesion == 5e4);
  BOOST_TEST(slid.tensile_strength == 0.);
  BOOST_TEST(opened.cohesion == 0.);
  BOOST_TEST(opened.static_tangent == slid.static_tangent);

  // half the strength of 2 m2 over 0.1 s
  const PointStrength point = intact.of_point(0.5, 2., 0.1);
  BOOST_TEST(point.cohesion == 2e4, boost::test_tools::tolerance(1e-14));
  BOOST_TEST(point.tension == 1e4, boost::test_tools::tolerance(1e-14));
  BOOST_TEST(point.static_friction == 0.5 * intact.static_tangent);
}

// residual cohesion that is not given is the peak; kinetic friction the static
BOOST_AUTO_TEST_CASE(joint_law_defaults)
{
  JointStrength entries          = some_joint();
  entries.residual_cohesion      = -1.;
  entries.kinetic_friction_angle = -1.;
  const auto law                 = make_joint_law(entries);
  BOOST_TEST(law->envelope({false, false}).cohesion == 2e5);
  BOOST_TEST(law->envelope({true, false}).kinetic_tangent ==
             law->envelope({true, false}).static_tangent);
  const auto free = make_friction_law(45.);
  BOOST_TEST(free->envelope({true, false}).static_tangent == 1.,
             boost::test_tools::tolerance(1e-15));
  BOOST_TEST(free->envelope({true, false}).cohesion == 0.);
}

// what sticks is within the strength, what slides lies on its limit
BOOST_AUTO_TEST_CASE(admissible_impulses_keep_to_the_envelope)
{
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(-1., 1.);
  const auto law = make_joint_law(some_joint());
  std::array<unsigned int, 3> n_of_status{{0, 0, 0}};
  for (unsigned int i = 0; i < 3000; ++i)
    {
      const bool is_intact = i % 3 == 0;
      const PointStrength strength =
        law->envelope({is_intact, i % 3 == 2}).of_point(1., 1., 2e-6);
      Vector<3> normal, stick;
      for (int d = 0; d < 3; ++d)
        {
          normal[d] = number(random);
          stick[d]  = number(random);
        }
      normal              = add<3>({}, 1. / norm<3>(normal), normal);
      const auto result   = admissible_impulse<3>(stick, normal, strength);
      const double excess = violation<3>(stick, normal, strength);
      const double r_n    = dot<3>(result.impulse, normal);
      const double r_t    = norm<3>(add<3>(result.impulse, -r_n, normal));
      ++n_of_status[static_cast<int>(result.status)];
      BOOST_TEST((excess <= 1e-12) ==
                 (result.status == ContactStatus::sticking));
      if (result.status == ContactStatus::sticking)
        BOOST_TEST(result.impulse == stick);
      if (result.status == ContactStatus::open)
        BOOST_TEST(norm<3>(result.impulse) == 0.);
      if (result.status == ContactStatus::sliding)
        BOOST_TEST(std::abs(r_t - std::max(0., strength.sliding_limit(r_n))) <
                   1e-12);
    }
  for (const unsigned int n : n_of_status)
    BOOST_TEST(n > 200);
}

namespace
{
  JointStrength
  with(JointStrength entries,
       const std::string &law,
       const std::vector<std::pair<std::string, double>> &values)
  {
    entries.law = law;
    for (const auto &[name, value] : values)
      for (unsigned int i = 0; i < joint_law_entries().size(); ++i)
        if (joint_law_entries()[i].name == name)
          entries.law_values[i] = value;
    return entries;
  }

  JointStrength
  rough_joint(const double wall_strength, const double residual_angle)
  {
    return with({},
                "barton-bandis",
                {{"JRC", 10.},
                 {"JCS", wall_strength},
                 {"Residual friction angle", residual_angle}});
  }

  double
  shear_strength(const JointLaw &law, const double pressure)
  {
    JointPointState state;
    state.pressure = pressure;
    return pressure * law.envelope(state).static_tangent;
  }
} // namespace

// tau = s tan(phi_r + JRC log10(JCS / s)), computed by hand
BOOST_AUTO_TEST_CASE(barton_bandis_shear_strength)
{
  const auto law = make_joint_law(rough_joint(30e6, 26.));
  const std::vector<std::pair<double, double>> strength = {{0.1e6, 0.12249e6},
                                                           {0.5e6, 0.47917e6},
                                                           {1e6, 0.86230e6},
                                                           {2e6, 1.54917e6},
                                                           {5e6, 3.34487e6}};
  for (const auto &[pressure, expected] : strength)
    BOOST_TEST(shear_strength(*law, pressure) == expected,
               boost::test_tools::tolerance(1e-4));
  // never above 70 degrees, never below the residual angle
  BOOST_TEST(shear_strength(*law, 1.) == 2.7474774194546,
             boost::test_tools::tolerance(1e-12));
  BOOST_TEST(shear_strength(*law, 1e8) == 0.48773258856586e8,
             boost::test_tools::tolerance(1e-12));
  // a joint of 1 m: JRC 10 x 10^-0.2, JCS 30 MPa x 10^-0.3
  JointStrength scaled = rough_joint(30e6, 26.);
  scaled               = with(scaled, "barton-bandis", {{"Joint length", 1.}});
  BOOST_TEST(shear_strength(*make_joint_law(scaled), 1e6) ==
               1e6 * std::tan((26. + 6.3095734448 * std::log10(15.0356170)) *
                              M_PI / 180.),
             boost::test_tools::tolerance(1e-8));
}

// the dip at which a rough slab's strength is used up: 2 m thick along the
// normal 63.305 degrees, along the vertical 68.578
BOOST_AUTO_TEST_CASE(barton_bandis_slab)
{
  const auto factor = [](const double dip, const double weight) {
    const double angle = dip * M_PI / 180.;
    BlockFace<2> face;
    face.inward = Tensor<1, 2>({std::sin(angle), std::cos(angle)});
    face.area   = 1.;
    face.name   = "J1";
    face.law    = make_joint_law(rough_joint(50e6, 30.));
    face.tangent_friction =
      face.law->envelope(JointPointState()).static_tangent;
    std::vector<BlockFace<2>> faces = {face};
    return solve_with_laws<2>(faces, Tensor<1, 2>({0., -weight})).factor;
  };
  BOOST_TEST(factor(63.305, 26e3 * 2.) == 1.,
             boost::test_tools::tolerance(1e-4));
  BOOST_TEST(factor(68.578, 26e3 * 2. * std::cos(68.578 * M_PI / 180.)) == 1.,
             boost::test_tools::tolerance(1e-4));
}

BOOST_AUTO_TEST_CASE(slip_weakening_by_slip)
{
  const auto law = make_joint_law(
    with(some_joint_without_kinetic(),
         "slip weakening",
         {{"Slip distance", 0.2}, {"Residual friction angle", 15.}}));
  const double peak = std::tan(35. * M_PI / 180.),
               rest = std::tan(15. * M_PI / 180.);
  JointPointState state;
  BOOST_TEST(law->envelope(state).cohesion == 2e5);
  BOOST_TEST(law->envelope(state).tensile_strength == 1e5);
  state.is_intact = false;
  state.history   = law->advance(law->advance({}, 0.03, 1e6), 0.02, 1e6);
  BOOST_TEST(state.history.slip == 0.05, boost::test_tools::tolerance(1e-14));
  BOOST_TEST(law->envelope(state).static_tangent == peak + 0.25 * (rest - peak),
             boost::test_tools::tolerance(1e-14));
  BOOST_TEST(law->envelope(state).cohesion == 2e5 - 0.25 * 1.5e5,
             boost::test_tools::tolerance(1e-14));
  BOOST_TEST(law->envelope(state).tensile_strength == 0.);
  state.history.slip = 1.;
  BOOST_TEST(law->envelope(state).kinetic_tangent == rest,
             boost::test_tools::tolerance(1e-14));
  state.has_opened = true;
  BOOST_TEST(law->envelope(state).cohesion == 0.);
}

BOOST_AUTO_TEST_SUITE_END()
