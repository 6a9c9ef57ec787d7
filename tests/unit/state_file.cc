// SPDX-License-Identifier: LGPL-2.1-or-later
// Files in memory: several at once, each with its own content.
#include "world.h"

#include <boost/test/unit_test.hpp>

#include <keyblock/checkpoint/state_file.h>

BOOST_AUTO_TEST_SUITE(state_file)

using namespace Keyblock;

BOOST_AUTO_TEST_CASE(several_state_files_at_once)
{
  StateFile first(world), second(world);
  double one = 1., two = 2.;
  first.exchange("run/value", one);
  second.exchange("run/value", two);
  std::vector<char> first_image = first.image(), second_image = second.image();
  BOOST_TEST(!first_image.empty());
  StateFile first_again(world, first_image), second_again(world, second_image);
  double value = 0.;
  first_again.exchange("run/value", value);
  BOOST_TEST(value == 1.);
  second_again.exchange("run/value", value);
  BOOST_TEST(value == 2.);
}

BOOST_AUTO_TEST_SUITE_END()
