// SPDX-License-Identifier: LGPL-2.1-or-later
// Blocks that their support catches, and such that fall.
#include <boost/test/unit_test.hpp>

#include <keyblock/safety/support_state.h>

BOOST_AUTO_TEST_SUITE(support_state)

using namespace Keyblock;

namespace
{
  constexpr double load = 40e3, size = 2.;

  /** A block that hangs. */
  struct Hanging
  {
    double force; ///< of its support [N]
    double depth; ///< [m]
  };

  SupportState<2>
  state_of(const std::vector<Hanging> &blocks)
  {
    SupportState<2> state;
    for (const Hanging &block : blocks)
      state.numbers.insert(state.numbers.end(),
                           {0., -block.force, 0., -block.depth, 4e3});
    return state;
  }

  std::vector<bool>
  caught(const std::vector<Hanging> &from, const std::vector<Hanging> &to)
  {
    const std::vector<double> loads(from.size(), load),
      sizes(from.size(), size);
    return mark_caught_blocks(state_of(from), state_of(to), loads, sizes);
  }
} // namespace

// A stiffness that bears the load on a twentieth of the size is the least one.
BOOST_AUTO_TEST_CASE(support_state_by_stiffness)
{
  const double least = load / (0.05 * size);
  for (const double way : {1e-9, 1e-4, 0.05})
    {
      BOOST_TEST(caught({{5e3, 0.}}, {{5e3 + 1.01 * least * way, way}})[0]);
      BOOST_TEST(!caught({{5e3, 0.}}, {{5e3 + 0.99 * least * way, way}})[0]);
      // of bolts that yield, or break
      BOOST_TEST(!caught({{5e3, 0.}}, {{5e3, way}})[0]);
      BOOST_TEST(!caught({{5e3, 0.}}, {{0., way}})[0]);
    }
}

// What lies on a block that is caught, or hangs on it, goes along with it.
BOOST_AUTO_TEST_CASE(support_state_of_blocks_along)
{
  const auto is_caught =
    caught({{0., 0.}, {0., 0.}, {0., 0.}, {0., 0.}},
           {{30e3, 0.01}, {0., 0.01}, {0., 0.1}, {0., -1.}});
  BOOST_TEST(is_caught[0]);
  BOOST_TEST(is_caught[1]);
  // it falls ten times as far, or goes the other way
  BOOST_TEST(!is_caught[2]);
  BOOST_TEST(!is_caught[3]);
}

BOOST_AUTO_TEST_CASE(support_state_without_elements)
{
  BOOST_TEST(!mark_caught_blocks(
    SupportState<2>(), SupportState<2>(), {load}, {size})[0]);
}

BOOST_AUTO_TEST_SUITE_END()
