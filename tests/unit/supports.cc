// SPDX-License-Identifier: LGPL-2.1-or-later
// Supports take away what they hold and put in what they prescribe.
#include "plate.h"

#include <boost/test/unit_test.hpp>

#include <cmath>

BOOST_AUTO_TEST_SUITE(supports)

using namespace Keyblock;

namespace
{
  const std::string base_and_sides =
    "subsection Supports\n set Names = base, sides\n subsection base\n  set "
    "Boundaries = bottom\n end\n subsection sides\n  set Boundaries = left, "
    "right\n  set Directions = normal\n end\nend\n";

  std::string
  moved_top(const std::string &motion)
  {
    return "subsection Supports\n set Names = base, top\n subsection base\n  "
           "set Boundaries = bottom\n end\n subsection top\n  set Boundaries = "
           "top\n  set " +
           motion + "\n end\nend\n" +
           "subsection Stages\n set Names = press\n subsection press\n  set "
           "Kind = quasi-static\n end\nend\n";
  }

  bool
  is_near(const double a, const double b)
  {
    return std::abs(a - b) < 1e-12;
  }

  /** What is left of (1, 2) at a place, by base_and_sides. */
  Tensor<1, 2>
  left_of_pattern(const Point<2> &place)
  {
    Tensor<1, 2> left;
    if (is_near(place[1], 0.))
      return left;
    left[0] = is_near(place[0], 0.) || is_near(place[0], 2.) ? 0. : 1.;
    left[1] = 2.;
    return left;
  }
} // namespace

BOOST_AUTO_TEST_CASE(held_components_are_removed)
{
  Plate plate(base_and_sides + one_stage);
  std::vector<double> force(plate.fields.velocity.size());
  for (unsigned int i = 0; i < force.size(); ++i)
    force[i] = plate.fields.velocity[i] = 1. + i % 2;
  plate.conditions->supports.remove_held_components(force);
  plate.conditions->apply_supports(0., 0.1);
  for (unsigned int node = 0; node < plate.numbering->n_owned(); ++node)
    {
      const Point<2> place    = plate.place_of(node);
      const Tensor<1, 2> left = left_of_pattern(place);
      for (unsigned int d = 0; d < 2; ++d)
        {
          BOOST_TEST(is_near(force[2 * node + d], left[d]));
          BOOST_TEST(is_near(plate.fields.velocity[2 * node + d], left[d]));
        }
      const bool is_fixed = is_near(place[1], 0.);
      BOOST_TEST((plate.fields.inverse_mass[node] == 0.) == is_fixed);
    }
  const double n_base =
    world.sum(double(plate.fields.nodes_of_support[0].size()));
  BOOST_TEST(n_base == 5.);
}

BOOST_AUTO_TEST_CASE(prescribed_velocity)
{
  Plate plate(moved_top("Velocity = 3*t; x"));
  const double time = 0.5, step = 0.1;
  plate.conditions->apply_supports(time, step);
  for (unsigned int node = 0; node < plate.numbering->n_owned(); ++node)
    {
      const Point<2> place = plate.place_of(node);
      const double *v      = plate.fields.velocity.data() + 2 * node;
      const bool is_moved  = is_near(place[1], 1.);
      BOOST_TEST(is_near(v[0], is_moved ? 3. * (time + 0.5 * step) : 0.));
      BOOST_TEST(is_near(v[1], is_moved ? place[0] : 0.));
    }
}

BOOST_AUTO_TEST_CASE(prescribed_displacement)
{
  Plate plate(moved_top("Displacement = 0; -0.01*(1 + x)"));
  auto &conditions = *plate.conditions;
  for (const NodeSupport<2> &support : plate.fields.supports)
    {
      const Point<2> place = plate.place_of(support.node);
      const auto u = conditions.supports.prescribed_displacement(support);
      const bool is_moved = is_near(place[1], 1.);
      BOOST_TEST(is_near(u[1], is_moved ? -0.01 * (1. + place[0]) : 0.));
      BOOST_TEST(u[0] == 0.);
    }
  // by the end of the ramp it is reached, whatever the steps
  conditions.loads.start_ramp({}, 1., true);
  std::vector<double> way(plate.fields.velocity.size(), 0.);
  for (const double step : {0.1, 0.25, 0.4, 0.3, 0.2})
    {
      std::fill(plate.fields.velocity.begin(), plate.fields.velocity.end(), 0.);
      conditions.apply_supports(0., step);
      conditions.loads.advance_ramp(step);
      for (unsigned int i = 0; i < way.size(); ++i)
        way[i] += step * plate.fields.velocity[i];
    }
  for (unsigned int node = 0; node < plate.numbering->n_owned(); ++node)
    {
      const Point<2> place = plate.place_of(node);
      const bool is_moved  = is_near(place[1], 1.);
      BOOST_TEST(is_near(way[2 * node], 0.));
      BOOST_TEST(
        is_near(way[2 * node + 1], is_moved ? -0.01 * (1. + place[0]) : 0.));
    }
}

BOOST_AUTO_TEST_SUITE_END()
