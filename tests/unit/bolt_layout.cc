// SPDX-License-Identifier: LGPL-2.1-or-later
// Patterns of bolts set out on the faces of an excavation.
#include <boost/test/unit_test.hpp>

#include "bolted_cavern.h"

#include <algorithm>
#include <cmath>

BOOST_AUTO_TEST_SUITE(bolt_layout)

using namespace Keyblock;

namespace
{
  const std::string pattern = "  set Excavations = cavern\n  set Length = 2\n"
                              "  set Spacing = 1, 2\n";
} // namespace

BOOST_AUTO_TEST_CASE(bolt_pattern_in_the_plane)
{
  // two walls of 3 m and a roof of 4 m in one row
  const auto bolts = bolts_of<2>(pattern);
  BOOST_TEST(bolts.size() == 10u);
  unsigned int n_up = 0;
  for (const Bolt<2> &bolt : bolts)
    {
      const Tensor<1, 2> way = bolt.direction();
      BOOST_TEST(std::abs(bolt.length() - 2.) < 1e-12);
      BOOST_TEST(std::abs(std::abs(way[0]) + std::abs(way[1]) - 1.) < 1e-12);
      n_up += way[1] > 0.5;
      // on the face, and out of the cavern
      const bool is_on_roof = std::abs(bolt.head[1] - 7.) < 1e-12;
      BOOST_TEST(is_on_roof == (way[1] > 0.5));
      BOOST_TEST((is_on_roof || (bolt.head[0] < 5.) == (way[0] < 0.)));
      // half a spacing from corners
      const double along = is_on_roof ? bolt.head[0] : bolt.head[1];
      BOOST_TEST(std::abs(along - std::floor(along) - 0.5) < 1e-9);
      BOOST_TEST(bolt.crossings.empty());
    }
  BOOST_TEST(n_up == 4u);
}

// Around the whole section they are equally far from each other, no more than
// the spacing, from the middle of the roof on.
BOOST_AUTO_TEST_CASE(bolt_pattern_around_the_section)
{
  const auto places = [](const auto &bolts, const unsigned int up) {
    // clockwise from the middle of the roof, on an outline of 14 m
    std::vector<double> list;
    for (const auto &bolt : bolts)
      {
        const double x = bolt.head[0] - 5., y = bolt.head[up] - 4.;
        double place = x;
        if (std::abs(y) < 1e-9)
          place = 7. - x;
        else if (std::abs(y - 3.) > 1e-9)
          place = x > 0. ? 5. - y : 9. + y;
        list.push_back(place < -1e-9 ? place + 14. : place);
      }
    std::sort(list.begin(), list.end());
    return list;
  };
  const std::string around = "  set Excavations = cavern\n  set Length = 2\n"
                             "  set Parts = roof, walls, floor\n";
  for (const auto &[spacing, n] :
       {std::make_pair("1.3", 11u), {"1.4", 10u}, {"1.3999", 10u}, {"20", 1u}})
    {
      const std::string entries =
        around + "  set Spacing = " + spacing + ", 20\n";
      const auto plane = places(bolts_of<2>(entries), 1),
                 ring  = places(bolts_of<3>(entries), 2);
      BOOST_REQUIRE(plane.size() == n);
      BOOST_REQUIRE(ring.size() == n);
      for (unsigned int k = 0; k < n; ++k)
        {
          BOOST_TEST(std::abs(plane[k] - 14. * k / n) < 1e-9);
          BOOST_TEST(std::abs(ring[k] - 14. * k / n) < 1e-9);
        }
    }
}

// Where gravity points to -x, the roof is at x = 7 and the walls are at y = 4
// and y = 7: turned by a right angle, clockwise.
BOOST_AUTO_TEST_CASE(bolt_pattern_in_turned_axes)
{
  const auto turned = [](const std::string &gravity) {
    return "subsection Initial state\n  set Gravity = " + gravity + "\nend\n";
  };
  const auto roof =
    bolts_of<2>(pattern + "  set Parts = roof\n", turned("-9.81; 0"));
  BOOST_TEST(roof.size() == 3u);
  for (const Bolt<2> &bolt : roof)
    BOOST_TEST(std::abs(bolt.head[0] - 7.) < 1e-12);
  const auto ring =
    bolts_of<3>(pattern + "  set Parts = roof, walls\n", turned("0; 0; 9.81"));
  BOOST_TEST(ring.size() == 100u);
  for (const Bolt<3> &bolt : ring)
    BOOST_TEST(bolt.direction()[2] < 1e-12);
  // from the middle of the roof on
  const auto around =
    bolts_of<2>("  set Excavations = cavern\n  set Length = 2\n"
                "  set Parts = roof, walls, floor\n"
                "  set Spacing = 20, 20\n",
                turned("-9.81; 0"));
  BOOST_REQUIRE(around.size() == 1u);
  BOOST_TEST(around[0].head.distance(Point<2>(7., 5.5)) < 1e-9);
}

BOOST_AUTO_TEST_CASE(bolt_pattern_in_rings)
{
  for (const auto &[parts, number] :
       {std::make_pair("roof, walls", 100u), {"roof", 40u}, {"floor", 40u}})
    {
      const auto bolts = bolts_of<3>(pattern + "  set Parts = " + parts + "\n");
      BOOST_TEST(bolts.size() == number);
      for (const Bolt<3> &bolt : bolts)
        {
          BOOST_TEST(std::abs(bolt.direction()[1]) < 1e-12);
          BOOST_TEST(std::abs(std::remainder(bolt.head[1] - 1., 2.)) < 1e-9);
        }
    }
  // towards the axis by 30 degrees, above half of the cavern
  const auto bolts = bolts_of<3>(
    pattern +
    "  set Parts = roof\n  set Inclination = 30\n  set Region = y - 10\n");
  BOOST_TEST(bolts.size() == 20u);
  for (const Bolt<3> &bolt : bolts)
    {
      BOOST_TEST(std::abs(bolt.direction()[1] - 0.5) < 1e-12);
      BOOST_TEST(std::abs(bolt.direction()[2] - std::sqrt(0.75)) < 1e-12);
    }
}

BOOST_AUTO_TEST_SUITE_END()
