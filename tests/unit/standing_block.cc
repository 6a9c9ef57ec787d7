// SPDX-License-Identifier: LGPL-2.1-or-later
// Whether the resultant on a block passes within what it presses on.
#include <keyblock/safety/standing_block.h>

#include <boost/test/unit_test.hpp>

namespace
{
  using namespace Keyblock;

  template <int dim>
  bool
  is_seated_on(const std::vector<Point<dim>> &vertices,
               const std::vector<PointForce<dim>> &forces)
  {
    BlockFace<dim> base;
    base.inward[dim - 1] = 1.;
    base.vertices        = vertices;
    return is_seated<dim>({base}, {0}, forces);
  }
} // namespace

BOOST_AUTO_TEST_SUITE(standing_block)

BOOST_AUTO_TEST_CASE(seat_in_the_plane)
{
  const std::vector<Point<2>> base = {{100., 7.}, {101., 7.}};
  const auto with_push             = [&](const double share) {
    return is_seated_on<2>(base,
                           {{{100.5, 8.}, Tensor<1, 2>({0., -1.})},
                            {{100.5, 8.}, Tensor<1, 2>({share, 0.})}});
  };
  // the resultant passes share times a height of one beside the middle
  BOOST_TEST(with_push(0.));
  BOOST_TEST(with_push(0.45));
  BOOST_TEST(with_push(-0.45));
  BOOST_TEST(!with_push(0.46)); // not clearly within
  BOOST_TEST(!with_push(-0.51));
  BOOST_TEST(!is_seated_on<2>({}, {{{0., 0.}, Tensor<1, 2>({0., -1.})}}));
}

BOOST_AUTO_TEST_CASE(seat_in_space)
{
  // a triangle, its centroid at a third
  const std::vector<Point<3>> base = {{0., 0., 0.}, {3., 0., 0.}, {0., 3., 0.}};
  const auto at                    = [&](const double x, const double y) {
    return is_seated_on<3>(base, {{{x, y, 5.}, Tensor<1, 3>({0., 0., -2.})}});
  };
  BOOST_TEST(at(1., 1.));
  BOOST_TEST(at(1.4, 1.4));
  BOOST_TEST(!at(1.6, 1.6));
  BOOST_TEST(at(0.1, 0.1));
  BOOST_TEST(!at(0.05, 1.));
  BOOST_TEST(!at(-0.5, 1.));
  // pushed sideways: the line meets the base at 1.6, at 1.4
  BOOST_TEST(
    !is_seated_on<3>(base,
                     {{{1., 1., 5.}, Tensor<1, 3>({0., 0., -1.})},
                      {{1., 1., 5.}, Tensor<1, 3>({0.12, 0.12, 0.})}}));
  BOOST_TEST(is_seated_on<3>(base,
                             {{{1., 1., 5.}, Tensor<1, 3>({0., 0., -1.})},
                              {{1., 1., 5.}, Tensor<1, 3>({0.08, 0.08, 0.})}}));
}

BOOST_AUTO_TEST_SUITE_END()
