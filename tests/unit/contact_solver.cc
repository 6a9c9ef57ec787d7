// SPDX-License-Identifier: LGPL-2.1-or-later
// Groups of coupled contact points: what redundant points must not cost.
#include <boost/test/unit_test.hpp>

#include <keyblock/contact/solver.h>

#include <random>

BOOST_AUTO_TEST_SUITE(contact_solver)

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

// A node slides on two faces of much friction, as the edge of a wedge does: the
// direction of slip turns by little in each sweep, and the sweeps go on until
// the impulses agree with the law, however slow they are.
BOOST_AUTO_TEST_CASE(node_on_two_rough_faces)
{
  std::mt19937 random(11);
  const auto draw = [&](const double from, const double to) {
    return std::uniform_real_distribution<>(from, to)(random);
  };
  unsigned int n_capped = 0, n_sliding = 0;
  for (unsigned int trial = 0; trial < 3000; ++trial)
    {
      const double half_angle = draw(0.5, 1.3), roll = draw(-0.5, 0.5);
      std::vector<ContactPoint<3>> points(2);
      for (int side = 0; side < 2; ++side)
        {
          const double angle   = roll + (side == 0 ? 1. : -1.) * half_angle;
          points[side].n_nodes = 2;
          points[side].node    = {{0, 1}};
          points[side].weight  = {{1., -1.}};
          points[side].normal  = {{std::sin(angle), 0., std::cos(angle)}};
          points[side].strength.static_friction = draw(0.3, 1.2);
          points[side].strength.kinetic_friction =
            points[side].strength.static_friction;
        }
      const Vector<3> start{{draw(-1., 1.), draw(0.3, 1.), draw(-1., -0.5)}};
      std::vector<double> velocity{start[0], start[1], start[2], 0., 0., 0.};
      const std::vector<double> inverse_mass{2., 0.};
      const ContactNodes<3> nodes{velocity.data(),
                                  inverse_mass.data(),
                                  nullptr};
      SolverSettings settings;
      settings.step             = 1e-3;
      settings.tolerance        = 1e-10;
      const SolverReport report = solve_group<3>(
        points, {points[0].strength, points[1].strength}, nodes, settings);
      n_capped += report.is_capped;
      double largest = 0.;
      for (const ContactPoint<3> &point : points)
        largest = std::max(largest, norm<3>(point.impulse));
      for (const ContactPoint<3> &point : points)
        {
          // none goes into its face; what slides bears its strength against
          // slip
          const Vector<3> c = relative_velocity<3>(point, velocity.data());
          BOOST_TEST(dot<3>(c, point.normal) > -1e-6);
          if (report.is_capped || point.status != ContactStatus::sliding)
            continue;
          ++n_sliding;
          const double pressure = dot<3>(point.impulse, point.normal);
          const Vector<3> shear =
            add<3>(point.impulse, -pressure, point.normal);
          const double speed = norm<3>(c);
          BOOST_TEST(std::abs(norm<3>(shear) - point.strength.kinetic_friction *
                                                 pressure) < 1e-8 * largest);
          if (speed > 1e-3)
            BOOST_TEST(std::abs(dot<3>(shear, c) + norm<3>(shear) * speed) <
                       1e-4 * largest * speed);
        }
    }
  BOOST_TEST(n_sliding > 1000u);
  BOOST_TEST(n_capped == 0u);
}

namespace
{
  /** One compliant point under the velocities that are given. */
  struct CompliantPoint
  {
    std::vector<double> velocity{{0.3, -1., 0.05, 0.1}};
    std::vector<double> inverse_mass{{2., 1.}};
    std::vector<ContactPoint<2>> points{make_point(0, 1, 0.3, 1.)};
    std::vector<double> identity{{1., 0., 0., 1.}};

    CompliantPoint(const double normal, const double shear, const double tau)
    {
      PointSpring<2> &spring = points[0].spring;
      spring.is_elastic      = true;
      spring.normal          = normal;
      spring.shear           = shear;
      spring.tau = spring.tau_shear = tau;
      spring.kick = spring.step = 1e-3;
      spring.before             = {{{-2., 1.}}, {{1e-5, -2e-5}}};
    }

    /** @param is_held whether the nodes say which directions they hold: none */
    void
    solve(const bool is_held)
    {
      const std::vector<const double *> projection(2, identity.data());
      const ContactNodes<2> nodes{velocity.data(),
                                  inverse_mass.data(),
                                  is_held ? &projection : nullptr};
      solve_group<2>(points, {points[0].strength}, nodes, {1e-3});
    }
  };
} // namespace

// The force is that of the stretch at the share tau of the move as long as the
// joint bears it, else on its strength, and slip is along it; with the matrix
// of partly held nodes the same.
BOOST_AUTO_TEST_CASE(compliant_point)
{
  for (const double tau : {0.5, 0.8})
    for (const double shear : {1e3, 1e6})
      {
        CompliantPoint one(3e5, shear, tau), other(3e5, shear, tau);
        one.solve(false);
        other.solve(true);
        const ContactPoint<2> &point = one.points[0];
        const Vector<2> &n           = point.normal;
        const Vector<2> c = relative_velocity<2>(point, one.velocity.data());
        const SpringChange<2> change = advance_spring<2>(
          point.spring, point.impulse, n, c, point.status, point.strength);
        const Vector<2> moved =
          add<2>(point.spring.before.stretch, tau * 1e-3, c);
        const Vector<2> elastic = scale_parts<2>(moved, n, -3e5, -shear);
        const Vector<2> force   = change.after.force;
        const double f_n        = dot<2>(force, n),
                     f_t        = norm<2>(add<2>(force, -f_n, n));
        BOOST_TEST(std::abs(f_n - dot<2>(elastic, n)) < 1e-9 * f_n);
        if (shear < 1e4)
          {
            BOOST_TEST((point.status == ContactStatus::sticking));
            BOOST_TEST(norm<2>(add<2>(force, -1., elastic)) < 1e-9 * f_n);
          }
        else
          {
            BOOST_TEST((point.status == ContactStatus::sliding));
            BOOST_TEST(std::abs(f_t - 0.7 * f_n) < 1e-9 * f_n);
            BOOST_TEST(dot<2>(force, change.slip) < 0.);
            BOOST_TEST(std::abs(dot<2>(change.slip, n)) < 1e-18);
          }
        for (int d = 0; d < 2; ++d)
          BOOST_TEST(std::abs(other.points[0].impulse[d] - point.impulse[d]) <
                     1e-7 * norm<2>(point.impulse));
      }
}

// As stiffness grows a point without stretch gets the impulse of a rigid one.
BOOST_AUTO_TEST_CASE(stiff_point)
{
  CompliantPoint stiff(1e16, 1e16, 1.), rigid(1., 1., 1.);
  stiff.points[0].spring.before     = {};
  rigid.points[0].spring.is_elastic = false;
  stiff.solve(false);
  rigid.solve(false);
  for (int d = 0; d < 2; ++d)
    BOOST_TEST(
      std::abs(stiff.points[0].impulse[d] - rigid.points[0].impulse[d]) < 1e-9);
}

// What turns with a normal keeps its length and its angle with it.
BOOST_AUTO_TEST_CASE(turned_force)
{
  const Vector<3> from{{0., 0., 1.}}, to{{0.6, 0., 0.8}}, v{{1., 2., 3.}};
  const Vector<3> turned = turn<3>(v, from, to);
  BOOST_TEST(std::abs(norm<3>(turned) - norm<3>(v)) < 1e-14);
  BOOST_TEST(std::abs(dot<3>(turned, to) - 3.) < 1e-14);
  BOOST_TEST(std::abs(turned[1] - 2.) < 1e-14);
}

BOOST_AUTO_TEST_SUITE_END()
