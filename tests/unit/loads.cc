// SPDX-License-Identifier: LGPL-2.1-or-later
// Loads sum up to area times traction and mass times gravity at any time, and
// what is ramped out goes as half a cosine.
#include "plate.h"

#include <boost/test/unit_test.hpp>

#include <cmath>

BOOST_AUTO_TEST_SUITE(loads)

using namespace Keyblock;

namespace
{
  std::string
  traction(const std::string &formula, const std::string &more = "")
  {
    return "subsection Tractions\n set Names = push\n subsection push\n  set "
           "Boundaries = right\n  set Traction = " +
           formula + "\n" + more + " end\nend\n" + one_stage;
  }

  void
  check_sum(const Plate &plate, const double x, const double y)
  {
    const Tensor<1, 2> sum = plate.sum_of(plate.fields.load);
    BOOST_TEST(std::abs(sum[0] - x) < 1e-9 * Plate::mass);
    BOOST_TEST(std::abs(sum[1] - y) < 1e-9 * Plate::mass);
  }
} // namespace

BOOST_AUTO_TEST_CASE(ramp_shares)
{
  Ramp ramp = Ramp::over(2.);
  BOOST_TEST(ramp.is_running());
  BOOST_TEST(ramp.share_left() == 1.);
  BOOST_TEST(std::abs(ramp.share_of_step(1.) - 0.5) < 1e-15);
  ramp.advance(0.5); // a quarter of the way
  BOOST_TEST(std::abs(ramp.share_left() - 0.5 * (1. + std::sqrt(0.5))) < 1e-15);
  ramp.pace = 0.5;
  ramp.advance(1.); // half the way
  BOOST_TEST(std::abs(ramp.share_left() - 0.5) < 1e-15);
  // the last step ends at nothing
  BOOST_TEST(ramp.share_of_step(1e3) == ramp.share_left());
  ramp.advance(1e3);
  BOOST_TEST(!ramp.is_running());
  BOOST_TEST(ramp.share_left() == 0.);
  BOOST_TEST(ramp.share_of_step(1.) == 0.);
  BOOST_TEST(!Ramp::over(0.).is_running());
}

BOOST_AUTO_TEST_CASE(traction_is_area_times_traction)
{
  Plate plate(traction("3e3; -500"));
  BOOST_TEST(!plate.conditions->loads.is_load_changing());
  BOOST_TEST(plate.conditions->loads.set_load(0.));
  check_sum(plate, 3e3, -500.); // a side of 1 m
  for (unsigned int node = 0; node < plate.numbering->n_owned(); ++node)
    if (plate.place_of(node)[0] < 1.9)
      BOOST_TEST(plate.fields.load[2 * node] == 0.);
  // nothing changes it any more
  BOOST_TEST(!plate.conditions->loads.set_load(1.));
}

BOOST_AUTO_TEST_CASE(traction_where_its_region_is)
{
  // an edge of the region anywhere on the side
  for (const double edge : {0.11, 0.37, 0.5, 0.93})
    for (const std::string growth : {"", "*(1+t)"})
      {
        Plate plate("subsection Tractions\n set Names = push\n subsection "
                    "push\n  set Region = if(x > 1.999, y - " +
                    std::to_string(edge) + ", -1)\n  set Traction = 3e3" +
                    growth + "; 0\n end\nend\n" + one_stage);
        const double time  = growth.empty() ? 0. : 2.;
        const double force = 3e3 * (1. + time) * (1. - edge);
        plate.conditions->set_load(time);
        BOOST_TEST(std::abs(plate.sum_of(plate.fields.load)[0] - force) <
                   1e-3 * 3e3);
        double moment = 0.;
        for (unsigned int node = 0; node < plate.numbering->n_owned(); ++node)
          moment += plate.fields.load[2 * node] * plate.place_of(node)[1];
        moment = world.sum(moment);
        BOOST_TEST(std::abs(moment - force * 0.5 * (1. + edge)) < 1e-3 * 3e3);
      }
}

BOOST_AUTO_TEST_CASE(traction_of_a_stage)
{
  Plate plate(traction("3e3; 0", "  set Stage = rest\n"));
  plate.conditions->set_load(0.);
  check_sum(plate, 0., 0.);
  BOOST_TEST(plate.conditions->changes(2));
  plate.conditions->excavate(2);
  plate.conditions->set_load(0.);
  check_sum(plate, 3e3, 0.);
}

BOOST_AUTO_TEST_CASE(formulas_in_time)
{
  Plate plate("subsection Initial state\n set Gravity = 0; -10*t\nend\n" +
              traction("1e3*t^2*y; 0"));
  BOOST_TEST(plate.conditions->loads.is_load_changing());
  for (const double time : {0., 1., 3.})
    {
      plate.conditions->set_load(time);
      check_sum(plate, 500. * time * time, -10. * time * Plate::mass);
    }
}

BOOST_AUTO_TEST_CASE(water_in_time_and_below_a_table)
{
  // a level joint of 2 m, whose sides water pushes apart
  const std::string joint   = "subsection Joints\n set Names = level\n "
                              "subsection level\n  set Point = 0, 0.5\n  set "
                              "Dip = 0\n";
  const auto force_on_sides = [](const Plate &plate) {
    std::vector<double> size = plate.fields.load;
    for (double &force : size)
      force = std::abs(force);
    const Tensor<1, 2> sum = plate.sum_of(plate.fields.load);
    BOOST_TEST(sum.norm() < 1e-9 * Plate::mass);
    return plate.sum_of(size);
  };
  Plate rising(joint + "  set Water pressure = 500*t\n end\nend\n" + one_stage);
  BOOST_TEST(rising.conditions->loads.is_load_changing());
  for (const double time : {0., 1., 3.})
    {
      BOOST_TEST(rising.conditions->loads.set_load(time));
      BOOST_TEST(std::abs(force_on_sides(rising)[1] - 2. * 2. * 500. * time) <
                 1e-6);
    }
  Plate table(joint + " end\nend\nsubsection Water\n set Level = 0.7\n set "
                      "Unit weight = 1e4\nend\nsubsection Stages\n set Names "
                      "= wet, dry\n subsection wet\n  set Duration = 1\n end\n "
                      "subsection dry\n  set Duration = 1\n  set Water level = "
                      "none\n end\nend\n");
  BOOST_TEST(!table.conditions->loads.is_load_changing());
  table.conditions->loads.set_load(0.);
  BOOST_TEST(std::abs(force_on_sides(table)[1] - 2. * 2. * 0.2e4) < 1e-6);
  BOOST_TEST(!table.conditions->changes(2));
  BOOST_TEST(table.conditions->changes(3));
  table.conditions->excavate(3);
  table.conditions->loads.set_load(0.);
  BOOST_TEST(force_on_sides(table)[1] == 0.);
}

BOOST_AUTO_TEST_CASE(carried_force_is_ramped_out)
{
  Plate plate("subsection Initial state\n set Gravity = 0; -10\nend\n" +
              one_stage);
  std::vector<double> carried(2 * plate.numbering->n_owned(), 0.);
  for (unsigned int node = 0; node < plate.numbering->n_owned(); ++node)
    carried[2 * node] = 8e3 / plate.numbering->n_global();
  auto &loads = plate.conditions->loads;
  loads.start_ramp(carried, 4., false);
  BOOST_TEST(loads.is_load_changing());
  for (const double share : {1., 0.5, 0.})
    {
      plate.conditions->set_load(0.);
      check_sum(plate, 8e3 * share, -10. * Plate::mass);
      BOOST_TEST(std::abs(loads.ramp_share_left() - share) < 1e-15);
      loads.advance_ramp(2.);
    }
  BOOST_TEST(!loads.is_load_changing());
  // a state that is recalled is half way again
  loads.start_ramp(carried, 4., false);
  loads.advance_ramp(2.);
  const StageState half = plate.conditions->remember();
  loads.start_ramp({}, 0., false);
  plate.conditions->set_load(0.);
  check_sum(plate, 0., -10. * Plate::mass);
  plate.conditions->recall(half);
  plate.conditions->set_load(0.);
  check_sum(plate, 4e3, -10. * Plate::mass);
}

BOOST_AUTO_TEST_SUITE_END()
