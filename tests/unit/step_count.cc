// SPDX-License-Identifier: LGPL-2.1-or-later
// Numbers of steps beyond 32 bits, and such as are none.
#include <boost/test/unit_test.hpp>

#include <keyblock/base/errors.h>
#include <keyblock/scene/step_count.h>

#include <limits>

BOOST_AUTO_TEST_SUITE(step_count)

using namespace Keyblock;

namespace
{
  Stage
  stage_of(const double duration)
  {
    Stage stage;
    stage.name     = "shake";
    stage.duration = duration;
    return stage;
  }

  std::string
  refusal(const double duration, const double longest)
  {
    try
      {
        count_steps(stage_of(duration), longest);
      }
    catch (const InputError &error)
      {
        return error.message;
      }
    return "";
  }
} // namespace

BOOST_AUTO_TEST_CASE(steps_are_counted_in_64_bits)
{
  // ten more than 2^32
  const Stage stage = stage_of(4294.967306);
  BOOST_TEST(count_steps(stage, 1e-6) == 4294967306ull);
  BOOST_TEST(plan_steps(stage, stage.duration / 4294967306ull) ==
             4294967306ull);
  BOOST_TEST(count_steps(stage_of(1.), 0.3) == 4u);
  BOOST_TEST(count_steps(stage_of(1.), 0.25) == 4u);
  // a step longer by less than a billionth is still one
  BOOST_TEST(count_steps(stage_of(1.), 0.25 * (1. - 1e-11)) == 4u);
  BOOST_TEST(count_steps(stage_of(1e-8), 1.) == 1u);
}

BOOST_AUTO_TEST_CASE(steps_end_at_their_maximum)
{
  Stage stage         = stage_of(1.);
  stage.maximum_steps = 3;
  BOOST_TEST(plan_steps(stage, 0.25) == 3u);
  stage.maximum_steps = 9;
  BOOST_TEST(plan_steps(stage, 0.25) == 4u);
  stage.duration = 0.;
  BOOST_TEST(plan_steps(stage, 0.25) == 9u);
}

BOOST_AUTO_TEST_CASE(numbers_that_are_none_are_refused)
{
  const double infinity = std::numeric_limits<double>::infinity();
  const auto has        = [](const std::string &text, const std::string &part) {
    return text.find(part) != std::string::npos;
  };
  BOOST_TEST(has(refusal(1e-12, 1e-3), "rounds to no time step"));
  BOOST_TEST(has(refusal(1e-12, 1e-3), "'Stages/shake/Duration'"));
  BOOST_TEST(has(refusal(1e200, 1e-6), "can be counted"));
  BOOST_TEST(has(refusal(infinity, 1e-6), "has to be a positive number"));
  BOOST_TEST(has(refusal(1., infinity), "'Time stepping/Maximum step'"));
  BOOST_TEST(has(refusal(1., infinity - infinity), "Maximum step"));
}

BOOST_AUTO_TEST_SUITE_END()
