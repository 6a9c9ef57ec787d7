// SPDX-License-Identifier: LGPL-2.1-or-later
// Least and median stable step of cells, shared out to ranks.
#include "world.h"

#include <boost/test/unit_test.hpp>

#include <keyblock/step/step_spread.h>

#include <numeric>

BOOST_AUTO_TEST_SUITE(step_spread)

using namespace Keyblock;

namespace
{
  /** A row of unit squares with the given frequencies [rad/s], every rank with
   * its share of them. */
  StepSpread<2>
  spread_of(const std::vector<double> &frequencies)
  {
    Mesh<2> mesh;
    const unsigned int n = frequencies.size();
    for (unsigned int i = 0; i <= n; ++i)
      for (unsigned int j = 0; j < 2; ++j)
        mesh.vertices.emplace_back(i, j);
    std::vector<double> mine;
    std::vector<unsigned int> mesh_cell;
    for (unsigned int c = 0; c < n; ++c)
      {
        mesh.cells.push_back({{2 * c, 2 * c + 2, 2 * c + 1, 2 * c + 3}});
        if (c % world.size() == world.rank())
          {
            mine.push_back(frequencies[c]);
            mesh_cell.push_back(c);
          }
      }
    return measure_step_spread(world, mine, mesh_cell, mesh);
  }
} // namespace

BOOST_AUTO_TEST_CASE(spread_of_steps)
{
  // steps 2, 0.5, 1, 4, 0.25 s
  const StepSpread<2> odd = spread_of({1., 4., 2., 0.5, 8.});
  BOOST_TEST(odd.least == 0.25);
  BOOST_TEST(odd.median == 1.);
  BOOST_TEST(odd.ratio() == 0.25);
  BOOST_TEST(odd.cell == 4u);
  BOOST_TEST(odd.place[0] == 4.5);
  BOOST_TEST(odd.place[1] == 0.5);
  // steps 2, 0.25, 0.25, 1 s: of equal cells the first
  const StepSpread<2> even = spread_of({1., 8., 8., 2.});
  BOOST_TEST(even.least == 0.25);
  BOOST_TEST(even.median == 0.625);
  BOOST_TEST(even.cell == 1u);
  BOOST_TEST(even.place[0] == 1.5);
  // one cell, and none
  BOOST_TEST(spread_of({4.}).ratio() == 1.);
  const StepSpread<2> empty = spread_of({});
  BOOST_TEST(empty.least == 0.);
  BOOST_TEST(empty.cell == none);
  BOOST_TEST(empty.ratio() == 1.);
}

BOOST_AUTO_TEST_SUITE_END()
