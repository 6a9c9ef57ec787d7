// SPDX-License-Identifier: LGPL-2.1-or-later
// Factors of groups, which all blocks of the group have.
#include <boost/test/unit_test.hpp>

#include <keyblock/safety/safety_factor.h>

using namespace Keyblock;

namespace
{
  /** Factor 3 of a block (index) that moves with a group, or of one alone. */
  SafetyFactor
  factor_of(const unsigned int block,
            const std::vector<unsigned int> &group = {},
            const double value                     = 0.)
  {
    SafetyFactor factor;
    factor.block = block;
    factor.stage = "rest";
    factor.lower = factor.upper = 3.;
    factor.group                = group;
    factor.group_lower = factor.group_upper = value;
    factor.trials.resize(1);
    factor.trials[0].is_of_group = !group.empty();
    factor.trials[0].factor      = value;
    return factor;
  }
} // namespace



BOOST_AUTO_TEST_CASE(blocks_have_the_factor_of_their_group)
{
  Blocks<2> blocks;
  blocks.blocks.resize(4);
  for (unsigned int b = 0; b < 4; ++b)
    blocks.blocks[b].id = b + 1;
  std::vector<SafetyFactor> factors = {factor_of(0, {1, 2}, 1.9)};
  BOOST_TEST(share_last_group(blocks, factors).empty());
  // found before its own, which held with weaker neighbors
  factors.push_back(factor_of(1));
  factors[1].trials.resize(2);
  factors[1].trials[1].is_of_group = factors[1].trials[1].is_stable = true;
  factors[1].trials[1].factor                                       = 3.;
  BOOST_TEST(share_last_group(blocks, factors).empty());
  BOOST_TEST((factors[1].group == std::vector<unsigned int>{1, 2}));
  BOOST_TEST(factors[1].value_of_group() == 1.9);
  BOOST_TEST(!factors[1].has_own_group());
  // not a member; then found after its own, weaker, and not of this stage
  factors.push_back(factor_of(2));
  share_last_group(blocks, factors);
  BOOST_TEST(factors[2].group.empty());
  factors.push_back(factor_of(3, {2, 3, 4}, 1.5));
  const std::vector<unsigned int> told = share_last_group(blocks, factors);
  BOOST_TEST((told == std::vector<unsigned int>{1, 2}));
  BOOST_TEST(factors[0].value_of_group() == 1.9);
  BOOST_TEST(factors[1].value_of_group() == 1.5);
  factors.push_back(factor_of(0, {1, 3}, 1.2));
  factors.back().stage = "later";
  BOOST_TEST(share_last_group(blocks, factors).empty());
  BOOST_TEST(factors[2].value_of_group() == 1.5);
}

BOOST_AUTO_TEST_CASE(blocks_that_fail_before_their_group_do_not_have_its_factor)
{
  Blocks<2> blocks;
  blocks.blocks.resize(2);
  for (unsigned int b = 0; b < 2; ++b)
    blocks.blocks[b].id = b + 1;
  std::vector<SafetyFactor> factors = {factor_of(0, {1, 2}, 1.8), factor_of(1)};
  factors[1].lower = factors[1].upper = 1.5;
  BOOST_TEST(share_last_group(blocks, factors).empty());
  BOOST_TEST(factors[1].group.empty());
}

BOOST_AUTO_TEST_CASE(a_group_has_one_factor)
{
  Blocks<2> blocks;
  blocks.blocks.resize(2);
  for (unsigned int b = 0; b < 2; ++b)
    blocks.blocks[b].id = b + 1;
  // found twice, from states of different history; one fails before, alone
  std::vector<SafetyFactor> factors = {factor_of(0, {1, 2}, 1.8),
                                       factor_of(1, {1, 2}, 1.7)};
  factors[0].lower = factors[0].upper = 1.5;
  BOOST_TEST(
    (share_last_group(blocks, factors) == std::vector<unsigned int>{0}));
  BOOST_TEST(factors[0].value_of_group() == 1.7);
  BOOST_TEST(factors[1].value_of_group() == 1.7);
}
