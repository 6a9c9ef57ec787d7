// SPDX-License-Identifier: LGPL-2.1-or-later
// Groups of coupled contact points: what redundant points must not cost.
#include <boost/test/unit_test.hpp>

#include <keyblock/contact/solver.h>

using namespace Keyblock;

namespace
{
  ContactPoint<2>
  make_point(const unsigned int slave,
             const unsigned int master,
             const double tilt,
             const double up)
  {
    ContactPoint<2> point;
    point.n_nodes = 2;
    point.node    = {{slave, master}};
    point.weight  = {{1., -1.}};
    point.normal  = {{up * std::sin(tilt), up * std::cos(tilt)}};
    point.strength.static_friction  = 0.7;
    point.strength.kinetic_friction = 0.7;
    return point;
  }
} // namespace

// A node slides over another that lies on its face as well: two points for one
// contact, their normals a little apart.
BOOST_AUTO_TEST_CASE(two_points_that_do_the_same)
{
  for (const double tilt : {0., 1e-7, 1e-6, 1e-5})
    {
      std::vector<double> velocity{{3., -1., 0., 0.}};
      const std::vector<double> start = velocity, inverse_mass{{2., 1.}};
      const ContactNodes<2> nodes{velocity.data(),
                                  inverse_mass.data(),
                                  nullptr};
      std::vector<ContactPoint<2>> points{make_point(0, 1, 0., 1.),
                                          make_point(1, 0, tilt, -1.)};
      const SolverReport report = solve_group<2>(
        points, {points[0].strength, points[1].strength}, nodes, {1e-3});
      BOOST_TEST(!report.is_capped);
      BOOST_TEST(report.n_iterations < 50u);
      // no approach, Coulomb's law on the sum, momentum
      BOOST_TEST(std::abs(velocity[1] - velocity[3]) < 1e-4);
      const double impulse = (velocity[1] - start[1]) / inverse_mass[0];
      BOOST_TEST(std::abs((velocity[0] - start[0]) / inverse_mass[0] +
                          0.7 * impulse) < 1e-4);
      for (int d = 0; d < 2; ++d)
        {
          double momentum = 0.;
          for (int node = 0; node < 2; ++node)
            momentum += (velocity[2 * node + d] - start[2 * node + d]) /
                        inverse_mass[node];
          BOOST_TEST(std::abs(momentum) < 1e-14);
        }
    }
}

// A stack of nodes on a held one, pushed from above: all come to rest on each
// other, whatever the order of the points.
BOOST_AUTO_TEST_CASE(column_of_nodes)
{
  const unsigned int n = 40;
  std::vector<double> velocity(2 * n, 0.), inverse_mass(n, 1.);
  inverse_mass[0] = 0.;
  for (unsigned int i = 1; i < n; ++i)
    velocity[2 * i + 1] = -1.;
  const ContactNodes<2> nodes{velocity.data(), inverse_mass.data(), nullptr};
  std::vector<ContactPoint<2>> points;
  std::vector<PointStrength> broken;
  for (unsigned int i = 1; i < n; ++i)
    {
      points.push_back(make_point(i, i - 1, 0., 1.));
      broken.push_back(points.back().strength);
    }
  SolverSettings settings;
  settings.step               = 1e-3;
  settings.maximum_iterations = 20000;
  const SolverReport report   = solve_group<2>(points, broken, nodes, settings);
  BOOST_TEST(!report.is_capped);
  for (unsigned int i = 0; i < n; ++i)
    BOOST_TEST(std::abs(velocity[2 * i + 1]) < 1e-5);
  BOOST_TEST(std::abs(points[0].impulse[1] - (n - 1.)) < 1e-3);
}
