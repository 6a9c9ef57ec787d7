// SPDX-License-Identifier: LGPL-2.1-or-later
// Feet of points on faces of any shape.
#include <keyblock/contact/face_foot.h>
#include <keyblock/contact/geometry.h>

#include <boost/test/unit_test.hpp>

#include <random>

using namespace Keyblock;

namespace
{
  using Quadrilateral = std::array<Vector<3>, 4>;

  Vector<3>
  point_at(const Quadrilateral &x, const std::array<double, 4> &weight)
  {
    Vector<3> p{};
    for (int v = 0; v < 4; ++v)
      p = add<3>(p, weight[v], x[v]);
    return p;
  }

  /** Whether (a, b) is in a simple quadrilateral of the plane z = 0: crossings
   * of a ray. */
  bool
  is_in(const Quadrilateral &x, const double a, const double b)
  {
    const std::array<int, 4> around = {{0, 1, 3, 2}};
    bool result                     = false;
    for (int i = 0; i < 4; ++i)
      {
        const Vector<3> &u = x[around[i]], &v = x[around[(i + 1) % 4]];
        if ((u[1] > b) != (v[1] > b) &&
            a < u[0] + (b - u[1]) / (v[1] - u[1]) * (v[0] - u[0]))
          result = !result;
      }
    return result;
  }

  /** Turns of the quadrilateral's boundary to the left, at its corners. */
  int
  n_left_turns(const Quadrilateral &x)
  {
    const std::array<int, 4> around = {{0, 1, 3, 2}};
    int n                           = 0;
    for (int i = 0; i < 4; ++i)
      n += cross(difference<3>(x[around[(i + 1) % 4]], x[around[i]]),
                 difference<3>(x[around[(i + 2) % 4]],
                               x[around[(i + 1) % 4]]))[2] > 0.;
    return n;
  }
} // namespace



BOOST_AUTO_TEST_SUITE(face_foot)

// Plane quadrilaterals, convex ones and such with a reflex corner, at heights
// up to their size: inside is what the polygon covers, and the foot is below.
BOOST_AUTO_TEST_CASE(plane_faces_of_any_shape)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1., 1.);
  unsigned int n_convex = 0, n_reflex = 0, n_inside = 0, n_wrong = 0;
  while (n_convex < 200 || n_reflex < 200)
    {
      Quadrilateral x = {{{{-0.5, -0.5, 0.}},
                          {{0.5, -0.5, 0.}},
                          {{-0.5, 0.5, 0.}},
                          {{0.5, 0.5, 0.}}}};
      for (Vector<3> &corner : x)
        for (int d = 0; d < 2; ++d)
          corner[d] += 0.6 * uniform(random);
      const int n_left = n_left_turns(x);
      if (n_left < 3) // crosses itself
        continue;
      (n_left == 4 ? n_convex : n_reflex) += 1;
      for (int i = 0; i < 200; ++i)
        {
          const Vector<3> p      = {{uniform(random), uniform(random), 0.3}};
          const FaceFoot<3> foot = find_foot<3>(x, p);
          const bool is_inside   = is_in(x, p[0], p[1]);
          n_inside += is_inside;
          // a face with a reflex corner reaches a little beyond its edges there
          if (n_left == 4 ? foot.is_inside != is_inside
                          : is_inside && !foot.is_inside)
            ++n_wrong;
          BOOST_TEST(norm<3>(difference<3>(
                       add<3>(point_at(x, foot.weight), 1., foot.offset), p)) <
                     1e-12);
          BOOST_TEST(foot.normal[2] > 0.999);
          if (foot.is_inside)
            {
              BOOST_TEST(std::abs(foot.gap - 0.3) < 1e-12);
              BOOST_TEST(std::hypot(foot.offset[0], foot.offset[1]) < 1e-5);
            }
        }
    }
  BOOST_TEST(n_inside > 10000u);
  BOOST_TEST(n_wrong == 0u);
}

// On faces that are warped a point is inside only above its foot.
BOOST_AUTO_TEST_CASE(feet_on_warped_faces)
{
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-1., 1.);
  unsigned int n_inside = 0, n_found = 0;
  for (int i = 0; i < 20000; ++i)
    {
      Quadrilateral x = {{{{-0.5, -0.5, 0.}},
                          {{0.5, -0.5, 0.}},
                          {{-0.5, 0.5, 0.}},
                          {{0.5, 0.5, 0.}}}};
      for (Vector<3> &corner : x)
        for (int d = 0; d < 3; ++d)
          corner[d] += (d < 2 ? 0.6 : 0.2) * uniform(random);
      const FaceFoot<3> any = find_foot<3>(
        x, {{uniform(random), uniform(random), 0.1 * uniform(random)}});
      if (any.is_inside)
        {
          ++n_inside;
          BOOST_TEST(norm<3>(add<3>(any.offset, -any.gap, any.normal)) < 1e-5);
        }
      // a point put above the middle is found there
      const Vector<3> middle = point_at(x, {{0.25, 0.25, 0.25, 0.25}});
      const Vector<3> n =
        unit<3>(cross(difference<3>(x[3], x[0]), difference<3>(x[2], x[1])));
      const FaceFoot<3> foot = find_foot<3>(x, add<3>(middle, 0.01, n));
      n_found += foot.is_inside && std::abs(foot.gap - 0.01) < 1e-9;
    }
  BOOST_TEST(n_inside > 2000u);
  BOOST_TEST(n_found > 19800u);
}

BOOST_AUTO_TEST_SUITE_END()
