// SPDX-License-Identifier: LGPL-2.1-or-later
// Forces and moments on the faces of rigid blocks.
#include <boost/test/unit_test.hpp>

#include <keyblock/safety/moment_balance.h>

#include <cmath>

BOOST_AUTO_TEST_SUITE(moment_balance)

using namespace Keyblock;

namespace
{
  BlockFace<2>
  face_between(const Point<2> &a, const Point<2> &b, const double friction)
  {
    BlockFace<2> face;
    const Tensor<1, 2> along = (b - a) / (b - a).norm();
    face.inward              = Tensor<1, 2>({-along[1], along[0]});
    face.area                = (b - a).norm();
    face.tangent_friction    = friction;
    face.vertices            = {a, b, a + 0.3 * (b - a)};
    return face;
  }

  /** A square base with a unit normal, sides of 1 m and corners that are not
   * the outermost of its vertices alone. */
  BlockFace<3>
  base(const double friction)
  {
    BlockFace<3> face;
    face.inward           = Tensor<1, 3>({0., 0., 1.});
    face.area             = 1.;
    face.tangent_friction = friction;
    face.vertices         = {Point<3>(0., 0., 0.),
                             Point<3>(1., 0., 0.),
                             Point<3>(0.5, 0.5, 0.),
                             Point<3>(1., 1., 0.),
                             Point<3>(0., 1., 0.)};
    return face;
  }
} // namespace



BOOST_AUTO_TEST_CASE(wedge_in_a_roof)
{
  // corners (-0.5, 0), (0.5, 0), (0.3, 0.8), 8 kN/m, 25 degrees; what its
  // base asks for by all combinations of the cones' sides at the corners
  const Point<2> a(-0.5, 0.), b(0.5, 0.), apex(0.3, 0.8);
  const double friction = std::tan(25. * dealii::numbers::PI / 180.);
  const auto holds_with = [&](const double force, const double factor) {
    return can_balance<2>({face_between(apex, a, friction),
                           face_between(b, apex, friction)},
                          {{Point<2>(0.1, 0.8 / 3.), Tensor<1, 2>({0., -8.})},
                           {Point<2>(0., 0.), Tensor<1, 2>({0., force})}},
                          {},
                          Tensor<1, 2>(),
                          factor);
  };
  for (const auto &[factor, force] :
       {std::pair<double, double>{1., 8.130945823},
        std::pair<double, double>{1.5, 8.347636220},
        std::pair<double, double>{3., 8.577754222}})
    {
      BOOST_TEST(holds_with(1.0001 * force, factor));
      BOOST_TEST(!holds_with(0.9999 * force, factor));
    }
}

BOOST_AUTO_TEST_CASE(block_on_a_plane)
{
  // a load of 1 under the friction angle's tangent of 0.5, at a height
  const auto rests = [](const double aside,
                        const double height,
                        const double factor,
                        const double angle) {
    return can_balance<3>(
      {base(0.5)},
      {{Point<3>(0.5, 0.5, height),
        Tensor<1, 3>({aside * std::cos(angle), aside * std::sin(angle), -1.})}},
      {},
      Tensor<1, 3>(),
      factor);
  };
  for (const double angle : {0., 0.3, 1.1})
    {
      BOOST_TEST(rests(0.4999, 0.1, 1., angle));
      BOOST_TEST(!rests(0.5002, 0.1, 1., angle));
      BOOST_TEST(rests(0.2499, 0.1, 2., angle));
      BOOST_TEST(!rests(0.2502, 0.1, 2., angle));
    }
  // the resultant meets the base, or misses it
  BOOST_TEST(rests(0.4, 1.249, 1., 0.));
  BOOST_TEST(!rests(0.4, 1.251, 1., 0.));
}

BOOST_AUTO_TEST_CASE(cohesion_and_bolts)
{
  // sheared along one face by up to cA = 3, with the line of the load in it
  BlockFace<2> face = face_between(Point<2>(0., 0.), Point<2>(1., 0.), 0.);
  face.cohesion     = 3.;
  const auto bears  = [&](const double force, const double factor) {
    return can_balance<2>({face},
                          {{Point<2>(0.5, 0.), Tensor<1, 2>({force, 0.})}},
                          {},
                          Tensor<1, 2>(),
                          factor);
  };
  BOOST_TEST(bears(2.999, 1.));
  BOOST_TEST(!bears(3.001, 1.));
  BOOST_TEST(!bears(1.501, 2.));
  face.is_reduced = false;
  BOOST_TEST(bears(2.999, 2.));
  // two bolts of up to 4 beside a weight between them
  const auto hangs = [](const double weight, const double place) {
    return can_balance<2>({},
                          {{Point<2>(place, 0.), Tensor<1, 2>({0., -weight})}},
                          {{Point<2>(0., 0.), Tensor<1, 2>({0., 4.})},
                           {Point<2>(1., 0.), Tensor<1, 2>({0., 4.})}},
                          Tensor<1, 2>(),
                          1.);
  };
  BOOST_TEST(hangs(7.99, 0.5));
  BOOST_TEST(!hangs(8.01, 0.5));
  BOOST_TEST(hangs(5.3, 0.25));
  BOOST_TEST(!hangs(5.4, 0.25));
  BOOST_TEST(!hangs(1., 1.1));
}

BOOST_AUTO_TEST_SUITE_END()
