// SPDX-License-Identifier: LGPL-2.1-or-later
// How strong joints are, and that the friction law keeps to it.
#include <boost/test/unit_test.hpp>

#include <keyblock/law/friction.h>
#include <keyblock/law/joint_law.h>

#include <random>

using namespace Keyblock;

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
