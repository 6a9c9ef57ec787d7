// SPDX-License-Identifier: LGPL-2.1-or-later
// Ranks in groups, and jobs shared out to them: the longest first.
#include "world.h"

#include <boost/test/unit_test.hpp>

#include <keyblock/base/rank_groups.h>

BOOST_AUTO_TEST_SUITE(rank_groups)

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

BOOST_AUTO_TEST_CASE(groups_of_ranks)
{
  const unsigned int n_ranks = world.size();
  for (unsigned int n = 1; n <= n_ranks; ++n)
    if (n_ranks % n == 0)
      {
        const RankGroups groups(world, n);
        BOOST_TEST(groups.n() == n);
        BOOST_TEST(groups.all.size() == n_ranks);
        BOOST_TEST(groups.mine().size() == n_ranks / n);
        BOOST_TEST(groups.index() == world.rank() / (n_ranks / n));
        BOOST_TEST(groups.mine().rank() == world.rank() % (n_ranks / n));
        // every rank adds its group's number to those of its group alone
        BOOST_TEST(groups.mine().sum(groups.index()) ==
                   groups.index() * (n_ranks / n));
        groups.wait_for_all();
      }
    else
      BOOST_CHECK_THROW(RankGroups(world, n), InputError);
  BOOST_CHECK_THROW(RankGroups(world, n_ranks + 1), InputError);
}

BOOST_AUTO_TEST_SUITE_END()
