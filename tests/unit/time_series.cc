// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/errors.h>
#include <keyblock/base/history_columns.h>

#include "world.h"

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <fstream>

BOOST_AUTO_TEST_SUITE(time_series)

using namespace Keyblock;

namespace
{
  std::string
  write(const std::string &text)
  {
    const std::string file =
      "time_series_" + std::to_string(world.size()) + ".csv";
    MPI_Barrier(world);
    if (world.is_root())
      std::ofstream(file) << text;
    MPI_Barrier(world);
    return file;
  }

  /** The sentence with which a file is refused. */
  std::string
  refusal(const std::string &text, const unsigned int n_components = 1)
  {
    try
      {
        TimeSeries::read(write(text),
                         "Supports/base/History file",
                         n_components);
      }
    catch (const InputError &error)
      {
        return error.message;
      }
    return "";
  }
} // namespace

BOOST_AUTO_TEST_CASE(time_series_between_rows)
{
  const TimeSeries series =
    TimeSeries::read(write("t, v_x, v_y\n# a comment\n1, 0, 4\n1.5, 2, 2\n"
                           "2, -2, 0\n"),
                     "Supports/base/History file",
                     2);
  BOOST_TEST(series.start_time() == 1.);
  BOOST_TEST(series.end_time() == 2.);
  BOOST_TEST(series.value(1.25, 0) == 1.);
  BOOST_TEST(series.value(1.75, 0) == 0.);
  BOOST_TEST(series.value(1.75, 1) == 1.);
  BOOST_TEST(series.value(2., 0) == -2.);
  BOOST_TEST(series.value(0.99, 1) == 0.);
  BOOST_TEST(series.value(2.01, 0) == 0.);
  BOOST_TEST(series.largest_magnitude() == 4.);
  BOOST_TEST(series.integral().last(1) == 2.);
  // what is integrated stays as long as it is told to
  const TimeSeries way = series.integral(), held = way.held_until(2.7);
  BOOST_TEST(way.value(2.5, 1) == 0.);
  BOOST_TEST(way.held_until(1.2).end_time() == 2.);
  BOOST_TEST(held.end_time() == 3.);
  BOOST_TEST(held.value(0.99, 1) == 0.);
  BOOST_TEST(held.value(1.5, 1) == way.value(1.5, 1));
  BOOST_TEST(held.value(2., 1) == 2.);
  BOOST_TEST(held.value(2.7, 1) == 2.);
  BOOST_TEST(held.value(3.01, 1) == 0.);
}

BOOST_AUTO_TEST_CASE(time_series_frequency)
{
  std::vector<double> v;
  for (unsigned int i = 0; i < 1000; ++i)
    v.push_back(std::sin(2. * 3.14159265358979 * 7. * 0.002 * i));
  const TimeSeries sine(0., 0.002, {v});
  BOOST_TEST(std::abs(sine.frequency_below(0.5) - 7.) < 0.5);
  BOOST_TEST(sine.frequency_below(0.99) < 12.);
}

BOOST_AUTO_TEST_CASE(time_series_refusals)
{
  BOOST_TEST(refusal("t, v\n0, 1\n1, 2\n").empty());
  BOOST_TEST(refusal("t, v\n0, 1\n1, 2\n1.5, 3\n").find("even times") !=
             std::string::npos);
  BOOST_TEST(refusal("t, v\n0, 1\n1, 2\n0.5, 3\n").find("Line 4") !=
             std::string::npos);
  BOOST_TEST(refusal("t, v\n0, 1\n1, fast\n").find("'fast' in column 2") !=
             std::string::npos);
  BOOST_TEST(refusal("t, v\n0, 1\n").find("has 1 row;") != std::string::npos);
  BOOST_TEST(refusal("t, v\n0, 1\n1, 2\n", 2).find("it needs 3") !=
             std::string::npos);
}

BOOST_AUTO_TEST_CASE(time_series_units)
{
  const std::string entry = "Supports/base/History file";
  const TimeSeries velocity =
    TimeSeries::read(write("time (ms),vx (cm/s),vy [mm/s]\n0,1,2\n10,3,4\n"),
                     entry,
                     2);
  BOOST_TEST(std::abs(velocity.end_time() - 0.01) < 1e-15);
  BOOST_TEST(std::abs(velocity.value(0., 0) - 0.01) < 1e-15);
  BOOST_TEST(std::abs(velocity.value(0.01, 1) - 4e-3) < 1e-15);
  const TimeSeries acceleration = read_history(
    write("t (s),ax (g),ay (m/s^2)\n0,1,2\n1,3,4\n"), entry, 2, "m/s2");
  BOOST_TEST(acceleration.value(0., 0) == 9.80665);
  BOOST_TEST(acceleration.value(1., 1) == 4.);
  BOOST_TEST(
    refusal("t (h), v\n0, 1\n1, 2\n").find("times may be in s or ms") !=
    std::string::npos);
  // names of another quantity
  for (const std::string name :
       {"ax", "acceleration", "a_x", "sxy", "stress x", "ux", "ax (m/s)"})
    BOOST_TEST(refusal("t," + name + "\n0,1\n1,2\n")
                 .find("by which it is no velocity") != std::string::npos);
  BOOST_TEST(refusal("t, v (g)\n0, 1\n1, 2\n").find("'v (g)' a unit") !=
             std::string::npos);
}

BOOST_AUTO_TEST_CASE(time_series_order_of_axes)
{
  const std::string entry = "Supports/base/History file";
  BOOST_TEST(
    TimeSeries::read(write("t,vy,vx\n0,1,2\n1,3,4\n"), entry, 2).value(0., 0) ==
    2.);
  // of the second value; in 2D the one that is up is y
  for (const std::string names :
       {"t,up,east", "t,V,h", "t,z,x", "t,UD,NS", "t,HNZ,HNE", "t,v2,v1"})
    BOOST_TEST(TimeSeries::read(write(names + "\n0,1,2\n1,3,4\n"), entry, 2)
                 .value(0., 0) == 2.);
  for (const std::string names :
       {"t,up,east,north", "t,vertical,E,N", "time,U,EW,NS", "t,v_z,v_x,v_y"})
    for (unsigned int d = 0; d < 3; ++d)
      BOOST_TEST(
        TimeSeries::read(write(names + "\n0,3,1,2\n1,0,0,0\n"), entry, 3)
          .value(0., d) == d + 1.);
  BOOST_TEST(refusal("t,V,H1\n0,1,2\n1,3,4\n", 2).find("'H1', which tells") !=
             std::string::npos);
  BOOST_TEST(refusal("t,vx,vx\n0,1,2\n1,3,4\n", 2).find("axis y") !=
             std::string::npos);
  BOOST_TEST(refusal("vx,t\n0,1\n1,3\n").find("the time in column 2") !=
             std::string::npos);
}

BOOST_AUTO_TEST_CASE(time_series_of_rounded_times)
{
  const std::string rounded = "t,v\n0,1\n0.0033,2\n0.0067,3\n0.0100,4\n";
  BOOST_TEST(refusal(rounded).empty());
  BOOST_TEST(
    refusal("t,v\n0,1\n0.0033,2\n0.0070,3\n0.0100,4\n").find("even times") !=
    std::string::npos);
}

BOOST_AUTO_TEST_SUITE_END()
