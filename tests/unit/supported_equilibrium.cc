// SPDX-License-Identifier: LGPL-2.1-or-later
// Limit equilibrium of a block that bolts and shotcrete hold, passive.
#include <boost/test/unit_test.hpp>

#include <keyblock/safety/block_support.h>

#include <algorithm>
#include <cmath>

BOOST_AUTO_TEST_SUITE(supported_equilibrium)

using namespace Keyblock;

namespace
{
  /** Four planes of 60 degrees that meet above a block in a roof. */
  std::vector<BlockFace<3>>
  roof_faces()
  {
    std::vector<BlockFace<3>> faces(4);
    const double s = std::sqrt(0.75), c = 0.5;
    faces[0].inward = Tensor<1, 3>({s, 0., -c});
    faces[1].inward = Tensor<1, 3>({-s, 0., -c});
    faces[2].inward = Tensor<1, 3>({0., s, -c});
    faces[3].inward = Tensor<1, 3>({0., -s, -c});
    for (auto &face : faces)
      {
        face.area             = 1.;
        face.tangent_friction = 0.5;
      }
    return faces;
  }

  BlockSupport<3>::Section
  section(const Tensor<1, 3> &across, const double strength)
  {
    BlockSupport<3>::Section result;
    result.trace.across = across;
    result.strength     = strength;
    return result;
  }

  BlockSupport<3>::Pull
  bolt(const Tensor<1, 3> &along, const double force, const double dowel)
  {
    BlockSupport<3>::Pull result;
    result.along          = along / along.norm();
    result.force          = force;
    result.dowel_strength = dowel;
    return result;
  }
} // namespace



// Sections across the way's tilt bear its vertical part only, what is across
// the way is load: however little the seismic load, they count.
BOOST_AUTO_TEST_CASE(shotcrete_under_a_block_that_falls_aside)
{
  const double weight = 418.5, strength = 34.;
  BlockSupport<3> support;
  for (const double sign : {-1., 1.})
    {
      support.sections.push_back(
        section(Tensor<1, 3>({sign, 0., 0.}), strength));
      support.sections.push_back(
        section(Tensor<1, 3>({0., sign, 0.}), strength));
    }
  support.shotcrete_strength = 4. * strength;
  for (const double coefficient : {0., 1e-3, 0.01, 0.1, 0.3})
    {
      std::vector<BlockFace<3>> faces = roof_faces();
      const auto limit =
        solve_with_support<3>(faces,
                              Tensor<1, 3>({coefficient * weight, 0., -weight}),
                              support,
                              true);
      const double tilt  = std::atan(coefficient),
                   aside = 2. * strength * std::sin(tilt),
                   load  = weight / std::cos(tilt);
      BOOST_TEST(limit.factor == 2. * strength * (1. + std::cos(tilt)) /
                                   std::sqrt(load * load + aside * aside),
                 boost::test_tools::tolerance(1e-9));
    }
}



// No order of the bolts and the sections is better than another.
BOOST_AUTO_TEST_CASE(order_of_support)
{
  BlockSupport<3> support;
  support.pulls              = {bolt(Tensor<1, 3>({0.3, 0.1, 1.}), 40., 25.),
                                bolt(Tensor<1, 3>({-0.5, 0.2, 1.}), 30., 60.),
                                bolt(Tensor<1, 3>({0.1, -0.6, 1.}), 20., 45.)};
  support.sections           = {section(Tensor<1, 3>({1., 0., 0.}), 20.),
                                section(Tensor<1, 3>({0.6, 0.8, 0.}), 35.),
                                section(Tensor<1, 3>({0., 1., 0.}), 10.)};
  support.shotcrete_strength = 65.;
  const Tensor<1, 3> load({20.9, 8.4, -418.5});
  std::vector<BlockFace<3>> faces = roof_faces();
  const double factor =
    solve_with_support<3>(faces, load, support, true).factor;
  BOOST_TEST(factor > 0.3);
  for (unsigned int turn = 0; turn < 3; ++turn)
    {
      std::rotate(support.pulls.begin(),
                  support.pulls.begin() + 1,
                  support.pulls.end());
      std::rotate(support.sections.begin(),
                  support.sections.begin() + 2,
                  support.sections.end());
      std::swap(support.pulls[0], support.pulls[1]);
      BOOST_TEST(solve_with_support<3>(faces, load, support, true).factor ==
                   factor,
                 boost::test_tools::tolerance(1e-7));
    }
}

BOOST_AUTO_TEST_SUITE_END()
