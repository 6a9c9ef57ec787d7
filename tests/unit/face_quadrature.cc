// SPDX-License-Identifier: LGPL-2.1-or-later
// Integrals over faces: of what varies linearly, and of what has a kink.
#include <keyblock/blocks/face_quadrature.h>

#include <boost/test/unit_test.hpp>

BOOST_AUTO_TEST_SUITE(face_quadrature)

using namespace Keyblock;

namespace
{
  /** Resultant of a pressure, and its moment about x = 0. */
  template <int dim, typename Pressure>
  std::array<double, 2>
  integrals(const FaceCorners<dim> &corners, const Pressure &pressure)
  {
    std::array<double, 2> sums = {};
    for (const auto &point : adapted_points<dim>(corners, pressure))
      {
        const double force = pressure(point.place) * point.area.norm();
        sums[0] += force;
        sums[1] += force * point.place[0];
      }
    return sums;
  }
} // namespace

BOOST_AUTO_TEST_CASE(linear_pressure_has_its_moment)
{
  const FaceCorners<2> segment = {{Point<2>(0., 1.), Point<2>(3., 1.)}};
  const auto on_segment =
    integrals<2>(segment, [](const Point<2> &p) { return 2. * p[0]; });
  BOOST_TEST(std::abs(on_segment[0] - 9.) < 1e-13);
  BOOST_TEST(std::abs(on_segment[1] - 18.) < 1e-13);
  // a triangle of which two corners are one: x from 0 to 3, 1 m high at x = 3
  const auto triangle = faces_of<3>(
    {Point<3>(0., 0., 1.), Point<3>(3., 0., 1.), Point<3>(3., 1., 1.)});
  BOOST_TEST(triangle.size() == 1u);
  const auto on_triangle =
    integrals<3>(triangle[0], [](const Point<3> &p) { return 2. * p[0]; });
  BOOST_TEST(std::abs(on_triangle[0] - 6.) < 1e-13);
  BOOST_TEST(std::abs(on_triangle[1] - 13.5) < 1e-13);
}

BOOST_AUTO_TEST_CASE(water_table_within_a_face)
{
  // up to depth z = 3 - w, wherever the table w crosses
  const FaceCorners<2> segment   = {{Point<2>(0., 0.), Point<2>(3., 0.)}};
  const FaceCorners<3> rectangle = {{Point<3>(0., 0., 0.),
                                     Point<3>(3., 0., 0.),
                                     Point<3>(0., 2., 0.),
                                     Point<3>(3., 2., 0.)}};
  for (double w = 0.1; w < 3.; w += 0.37)
    {
      const double z  = 3. - w;
      const auto line = integrals<2>(segment, [w](const Point<2> &p) {
        return std::max(0., p[0] - w);
      });
      BOOST_TEST(std::abs(line[0] - z * z / 2.) < 1e-6);
      BOOST_TEST(std::abs(line[1] - (z * z / 2. * (w + 2. / 3. * z))) < 3e-6);
      const auto plane = integrals<3>(rectangle, [w](const Point<3> &p) {
        return std::max(0., p[0] - w);
      });
      BOOST_TEST(std::abs(plane[0] - z * z) < 2e-3);
    }
  // what is steady or smooth asks for no parts
  BOOST_TEST(adapted_points<2>(segment, [](const Point<2> &) {
               return 1.;
             }).size() == 2u);
  BOOST_TEST(adapted_points<3>(rectangle, [](const Point<3> &p) {
               return p[0] * p[1];
             }).size() == 4u);
}

BOOST_AUTO_TEST_SUITE_END()
