// SPDX-License-Identifier: LGPL-2.1-or-later
// Jobs shared out to rank groups: the longest first.
#include <boost/test/unit_test.hpp>

#include <keyblock/base/rank_groups.h>

using namespace Keyblock;

BOOST_AUTO_TEST_CASE(share_out_of_jobs)
{
  using List = std::vector<unsigned int>;
  // 7 | 5 + 1: the third is as long as the second, and comes after it
  BOOST_TEST(share_out({1., 5., 7.}, 2) == List({1, 1, 0}),
             boost::test_tools::per_element());
  BOOST_TEST(share_out({2., 2., 2., 2.}, 2) == List({0, 1, 0, 1}),
             boost::test_tools::per_element());
  BOOST_TEST(share_out({3., 1.}, 1) == List({0, 0}),
             boost::test_tools::per_element());
  BOOST_TEST(share_out({3.}, 4) == List({0}), boost::test_tools::per_element());
  BOOST_TEST(share_out({}, 2).empty());
}
