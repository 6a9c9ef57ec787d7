// SPDX-License-Identifier: LGPL-2.1-or-later
// The mode by which nodes creep: found where one lasts, not where several mix
// or the motion runs away.
#include "world.h"

#include <boost/test/unit_test.hpp>

#include <keyblock/safety/slow_mode.h>

#include <cmath>

BOOST_AUTO_TEST_SUITE(slow_mode)

using namespace Keyblock;

namespace
{
  constexpr double mass[2] = {2., 3.}, omega[2] = {5., 40.};

  // two nodes on springs of their own to the ground, and one that is not
  // looked at; node i has moved by `way[i]` along x
  void
  put(Fields<2> &fields, const double way_0, const double way_1)
  {
    const double way[2] = {way_0, way_1};
    for (unsigned int i = 0; i < 2; ++i)
      {
        fields.displacement[2 * i] = way[i];
        // the force changes by its spring's, half inside and half in contact
        const double force           = -mass[i] * omega[i] * omega[i] * way[i];
        fields.internal_force[2 * i] = -0.5 * force;
        fields.contact_force[2 * i]  = 0.5 * force;
      }
    fields.displacement[4] += 1.;
  }
} // namespace

BOOST_AUTO_TEST_CASE(slow_mode_of_creep)
{
  Fields<2> fields;
  fields.mass = {mass[0], mass[1], 1.};
  for (auto *list : {&fields.displacement,
                     &fields.internal_force,
                     &fields.contact_force,
                     &fields.load})
    list->assign(6, 0.);
  const std::vector<unsigned int> nodes = {0, 1};

  put(fields, 0., 0.);
  SlowMode<2> creep(world, fields, nodes);
  // slow mode alone, dying away: three looks agree
  put(fields, 1., 0.);
  BOOST_TEST(creep.check() == 0.);
  put(fields, 1.5, 0.);
  BOOST_TEST(creep.check() == 0.);
  put(fields, 1.7, 0.);
  BOOST_TEST(std::abs(creep.check() - omega[0]) < 1e-12);
  // the fast one takes over: nothing lasts until it has for three looks
  put(fields, 1.7, 1.);
  BOOST_TEST(creep.check() == 0.);
  put(fields, 1.7, 0.4);
  BOOST_TEST(creep.check() == 0.);
  put(fields, 1.7, 0.6);
  BOOST_TEST(std::abs(creep.check() - omega[1]) < 1e-12);
  // no motion, no mode
  BOOST_TEST(creep.check() == 0.);
  BOOST_TEST(creep.check() == 0.);
  BOOST_TEST(creep.check() == 0.);
  // forces that drive the motion on are no spring's
  for (unsigned int i = 1; i < 5; ++i)
    {
      fields.displacement[0] += 1.;
      fields.load[0] += 100.;
      BOOST_TEST(creep.check() == 0.);
    }
}

BOOST_AUTO_TEST_SUITE_END()
