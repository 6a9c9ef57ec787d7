// SPDX-License-Identifier: LGPL-2.1-or-later
// Times left are those of what ends the stage, or none.
#include <keyblock/run/factor_progress.h>
#include <keyblock/run/folded_lines.h>
#include <keyblock/run/progress_line.h>

#include <boost/test/unit_test.hpp>

#include <fcntl.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <sstream>

BOOST_AUTO_TEST_SUITE(progress_line)

using namespace Keyblock;

BOOST_AUTO_TEST_CASE(lines_are_folded_at_blanks)
{
  const std::string row =
    "Factor  block 1 after dig: 0.5 [0.49, 0.51], sliding on A";
  BOOST_TEST(fold(row, 0) == row);
  BOOST_TEST(fold(row, row.size()) == row);
  BOOST_TEST(fold(row, 45) == "Factor  block 1 after dig: 0.5 [0.49, 0.51],\n"
                              "        sliding on A");
  const std::string word(60, 'x');
  BOOST_TEST(fold("        " + word + " y", 50) ==
             "        " + word + "\n        y");
  BOOST_TEST(fold("a" + std::string(60, ' '), 50) == "a");

  std::ostringstream out;
  {
    const FoldedLines folded(out, []() { return 45; });
    out << row << std::endl << "\rprogress " + word << std::flush;
    out << "\r" << row << '\n'
        << word.substr(0, 30) << std::flush << " cut " << word << "\n";
  }
  out << row;
  const std::string twice = fold(row, 45);
  BOOST_TEST(out.str() == twice + "\n\rprogress " + word + "\r" + twice + "\n" +
                            word.substr(0, 30) + " cut " + word + "\n" + row);
}

BOOST_AUTO_TEST_CASE(time_left_by_steps)
{
  StageAdvance before, now;
  before.planned = now.planned = before.largest_steps = now.largest_steps =
    1000;
  now.time  = 2.;
  now.steps = 100.;
  BOOST_TEST(std::abs(time_left(before, now) - 18.) < 1e-12);
  BOOST_TEST(time_left(now, now) < 0.);
}

BOOST_AUTO_TEST_CASE(time_left_by_ratio)
{
  // a decade in 3 s, two to go
  StageAdvance before, now;
  before.ratio  = 1e-2;
  before.target = now.target = 1e-5;
  now.ratio                  = 1e-3;
  now.time                   = 3.;
  now.steps                  = 50.;
  now.largest_steps          = 200000.;
  BOOST_TEST(std::abs(time_left(before, now) - 6.) < 1e-9);
  now.largest_steps = 75.; // 25 steps at most
  BOOST_TEST(std::abs(time_left(before, now) - 1.5) < 1e-9);
  now.ramp_left = 0.1;
  BOOST_TEST(time_left(before, now) < 0.);
  now.ramp_left = 0.;
  now.ratio     = 2e-2; // it rises
  BOOST_TEST(time_left(before, now) < 0.);
}

BOOST_AUTO_TEST_CASE(durations_for_people)
{
  BOOST_TEST(duration_text(0.4) == "0 s");
  BOOST_TEST(duration_text(99.) == "99 s");
  BOOST_TEST(duration_text(210.) == "3.5 min");
  BOOST_TEST(duration_text(7560.) == "2.1 h");
}

// what matters most stays whole where a line is short
BOOST_AUTO_TEST_CASE(fields_that_do_not_fit)
{
  const std::vector<ProgressField> fields = {
    {"Stage 1 of 3", 0},
    {" (excavation)", 4},
    {"  step 12000", 3},
    {"  unbalanced 0.00453 of 1e-05", 1},
    {"  open/sliding/sticking 1/2/3", 5},
    {"  left 7 min", 2},
    {"  12.3 M element-steps/s", 6}};
  const std::string left = "unbalanced 0.00453 of 1e-05  left 7 min";
  BOOST_TEST(fit_fields(fields, 79) ==
             "Stage 1 of 3 (excavation)  step 12000  " + left);
  BOOST_TEST(fit_fields(fields, 60) == "Stage 1 of 3  " + left);
  BOOST_TEST(fit_fields(fields, 10) == "Stage 1 of");
  BOOST_TEST(fit_fields(fields, 0).size() > 120u);
}

BOOST_AUTO_TEST_CASE(fields_of_a_search)
{
  const auto line = [](const SearchAdvance &now, const double left) {
    return fit_fields(fields_of_search(now, 7, 14, 23, left), 0);
  };
  BOOST_TEST(line({5, 1.2, 1.5}, 210.) ==
             "Factor  block 7 of 14 (id 23), trial 5, bracket so far [1.2, "
             "1.5]  left 3.5 min");
  BOOST_TEST(line({2, 1.2, 0.}, -1.) ==
             "Factor  block 7 of 14 (id 23), trial 2, holds at 1.2");
  BOOST_TEST(line({2, 0., 3.}, -1.) ==
             "Factor  block 7 of 14 (id 23), trial 2, fails at 3");
  BOOST_TEST(line({}, -1.) == "Factor  block 7 of 14 (id 23)");
}

BOOST_AUTO_TEST_CASE(time_that_is_left_of_blocks)
{
  // two blocks took 10 s each
  BOOST_TEST(time_left_of_blocks(1, 4, 0., 3.) < 0.);
  BOOST_TEST(time_left_of_blocks(3, 4, 20., 3.) == 17.);
  BOOST_TEST(time_left_of_blocks(3, 4, 20., 30.) == 10.);
  BOOST_TEST(time_left_of_blocks(3, 3, 20., 3.) == 7.);
  BOOST_TEST(time_left_of_blocks(3, 3, 20., 30.) < 0.);
}

BOOST_AUTO_TEST_CASE(terminals_without_a_size_are_none)
{
  const int main_end = posix_openpt(O_RDWR | O_NOCTTY);
  BOOST_REQUIRE(main_end >= 0);
  BOOST_REQUIRE((grantpt(main_end) == 0 && unlockpt(main_end) == 0));
  const int terminal = open(ptsname(main_end), O_RDWR | O_NOCTTY);
  BOOST_REQUIRE(isatty(terminal));
  BOOST_TEST(terminal_width(terminal) == 0u);
  winsize size{};
  size.ws_col = 133;
  BOOST_REQUIRE(ioctl(main_end, TIOCSWINSZ, &size) == 0);
  BOOST_TEST(terminal_width(terminal) == 133u);
  close(terminal);
  BOOST_TEST(terminal_width(terminal) == 0u); // no file
  const int pipe_like = open("/dev/null", O_WRONLY);
  BOOST_TEST(terminal_width(pipe_like) == 0u);
  close(pipe_like);
  close(main_end);
}

BOOST_AUTO_TEST_SUITE_END()
