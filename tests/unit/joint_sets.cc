// SPDX-License-Identifier: LGPL-2.1-or-later
// Random numbers to the last bit; the statistics of joints made from them.
#include "world.h"

#include <boost/test/unit_test.hpp>

#include <keyblock/base/errors.h>
#include <keyblock/scene/domain_outline.h>
#include <keyblock/scene/joint_sets.h>
#include <keyblock/scene/radius_law.h>
#include <keyblock/scene/text.h>

#include <cmath>
#include <functional>

BOOST_AUTO_TEST_SUITE(joint_sets)

using namespace Keyblock;

namespace
{
  /** Mean of a measured quantity over seeds, and its standard error. */
  struct Sample
  {
    double mean, error;
  };

  Sample
  mean_of(const std::vector<double> &values)
  {
    double sum = 0., squares = 0.;
    for (const double value : values)
      {
        sum += value;
        squares += value * value;
      }
    const double n = values.size(), mean = sum / n;
    return {mean, std::sqrt((squares / n - mean * mean) / (n - 1.))};
  }

  template <int dim>
  using Joints = std::vector<std::unique_ptr<Joint<dim>>>;

  /** Whether the mean over 20 seeds of what @p measure finds in the joints of
   * @p set is within three standard errors of @p expected. */
  template <int dim>
  void
  check_mean(JointSet<dim> set,
             const Domain<dim> &domain,
             const double expected,
             const std::function<double(const Joints<dim> &)> &measure)
  {
    std::vector<double> values;
    for (set.seed = 1; set.seed <= 20; ++set.seed)
      values.push_back(measure(make_joints_of_set(set, domain)));
    const Sample found = mean_of(values);
    BOOST_TEST(found.error > 0.);
    BOOST_TEST(found.error < 0.1 * expected);
    BOOST_TEST(std::abs(found.mean - expected) < 3. * found.error,
               found.mean << " +- " << found.error << ", expected "
                          << expected);
  }

  template <int dim>
  Domain<dim>
  cube(const double size)
  {
    Domain<dim> domain;
    domain.size.assign(dim, size);
    return domain;
  }

  bool
  is_inside(const Point<3> &p, const double size)
  {
    for (unsigned int d = 0; d < 3; ++d)
      if (p[d] < 0. || p[d] > size)
        return false;
    return true;
  }

  /** Unit vectors along a plane with this normal. */
  std::array<Tensor<1, 3>, 2>
  frame(const Tensor<1, 3> &n)
  {
    Tensor<1, 3> axis;
    axis[std::abs(n[0]) < 0.7 ? 0 : 1] = 1.;
    Tensor<1, 3> a                     = cross_product_3d(n, axis);
    a /= a.norm();
    return {{a, cross_product_3d(n, a)}};
  }

  /** Area of discs within the cube over its volume, by 300 points a disc that
   * share its area equally. */
  double
  measure_p32(const Joints<3> &joints, const double size)
  {
    double area = 0.;
    for (const auto &joint : joints)
      {
        const auto axes = frame(joint->normal());
        for (unsigned int i = 0; i < 300; ++i)
          {
            const double r     = joint->radius * std::sqrt((i + 0.5) / 300.);
            const double angle = 2.399963229728653 * i;
            const Point<3> p   = joint->point + r * std::cos(angle) * axes[0] +
                               r * std::sin(angle) * axes[1];
            if (is_inside(p, size))
              area +=
                dealii::numbers::PI * joint->radius * joint->radius / 300.;
          }
      }
    return area / (size * size * size);
  }

  /** Joints crossed by lines along @p n through the cube, over their length. */
  double
  measure_p10(const Joints<3> &joints, const double size, const Tensor<1, 3> &n)
  {
    const auto axes   = frame(n);
    double n_crossed  = 0.;
    const double half = 0.3 * size;
    for (int i = -2; i <= 2; ++i)
      for (int j = -2; j <= 2; ++j)
        {
          const Point<3> middle = Point<3>(size / 2, size / 2, size / 2) +
                                  0.05 * size * i * axes[0] +
                                  0.05 * size * j * axes[1];
          for (const auto &joint : joints)
            {
              const Tensor<1, 3> m = joint->normal();
              const double t       = m * (joint->point - middle) / (m * n);
              const Point<3> p     = middle + t * n;
              n_crossed += std::abs(t) < half &&
                           (joint->extent == JointShape::infinite ||
                            p.distance(joint->point) < joint->radius);
            }
        }
    return n_crossed / (25. * 2. * half);
  }

  Tensor<1, 3>
  mean_pole(const JointSet<3> &set)
  {
    Joint<3> joint;
    joint.dip           = set.dip;
    joint.dip_direction = set.dip_direction;
    return joint.normal();
  }

  JointSet<3>
  set_of_discs()
  {
    JointSet<3> set;
    set.name          = "A";
    set.dip           = 60.;
    set.dip_direction = 30.;
    set.concentration = 20.;
    set.intensity     = 0.2;
    set.radius_law    = RadiusDistribution::constant;
    set.radius_mean   = 2.;
    return set;
  }
} // namespace

// The numbers below were computed in Python with the Mersenne twister written
// out (checked by its 10,000th number, 9981545732273789042, which the C++
// standard names) and mpmath at 50 digits, then rounded to the nearest double.
BOOST_AUTO_TEST_CASE(random_numbers_to_the_last_bit)
{
  RandomNumbers uniform(1), exponential(1), normal(1), poisson(1);
  for (const double value : {0x1.122deafddb434p-3,
                             0x1.175c928118c7cp-3,
                             0x1.ce0b479deb990p-2,
                             0x1.5876015e4d700p-6})
    BOOST_TEST(uniform.uniform() == value);
  for (const double value : {0x1.265ad52cffb28p-3,
                             0x1.2c58ca2fd58bdp-3,
                             0x1.333989e536853p-1,
                             0x1.5c222f8b340b3p-6})
    BOOST_TEST(exponential.exponential() == value);
  for (const double value : {0x1.676a93ccea4ffp-2,
                             0x1.16007c53e018dp+0,
                             0x1.94108d1f8799ep-1,
                             0x1.01c9a344df5dfp+0})
    BOOST_TEST(rounded(normal.pair().normal<Real>()) == value);
  for (const unsigned int value : {16, 14, 13, 7, 15, 5})
    BOOST_TEST(poisson.poisson(10.) == value);
}

// dip, dip direction and centre of the first discs with a centre in the
// domain, likewise from Python
BOOST_AUTO_TEST_CASE(discs_to_the_last_bit)
{
  JointSet<3> set             = set_of_discs();
  set.seed                    = 7;
  const auto joints           = make_joints_of_set(set, cube<3>(10.));
  const double expected[3][5] = {{0x1.00f43fc6c6836p+6,
                                  0x1.9a8d69751a408p+4,
                                  0x1.84f235a7a6b1ep+2,
                                  0x1.463ebd274a582p+2,
                                  0x1.cfe823083ca30p+0},
                                 {0x1.3c8c35901747bp+6,
                                  0x1.65b43f9b30e24p+5,
                                  0x1.f8745e4673a44p+2,
                                  0x1.a418702c7616cp+0,
                                  0x1.21bc71f4a7658p+3},
                                 {0x1.f772cd46bded4p+5,
                                  0x1.e7a59a6cc60dep+4,
                                  0x1.0bac2c505cf01p+3,
                                  0x1.06c2dc92127dbp+2,
                                  0x1.0703907a897c2p+3}};
  unsigned int n              = 0;
  for (const auto &joint : joints)
    if (is_inside(joint->point, 10.))
      {
        if (n < 3)
          {
            BOOST_TEST(joint->dip == expected[n][0]);
            BOOST_TEST(joint->dip_direction == expected[n][1]);
            for (unsigned int d = 0; d < 3; ++d)
              BOOST_TEST(joint->point[d] == expected[n][2 + d]);
          }
        ++n;
      }
  BOOST_TEST(n == 18u);
  BOOST_TEST(joints.size() < 39u); // those drawn, some wholly outside
  BOOST_TEST(joints[4]->name == "A.5");
  BOOST_TEST(joints[4]->set == "A");
}

BOOST_AUTO_TEST_CASE(intensity_of_discs)
{
  JointSet<3> set    = set_of_discs();
  const auto measure = [](const Joints<3> &joints) {
    return measure_p32(joints, 10.);
  };
  check_mean<3>(set, cube<3>(10.), 0.2, measure);
  set.radius_law     = RadiusDistribution::exponential;
  set.radius_maximum = 5.;
  set.radius_mean    = 1.5;
  set.radius_minimum = 0.5;
  check_mean<3>(set, cube<3>(10.), 0.2, measure);
  set.radius_law     = RadiusDistribution::power_law;
  set.radius_minimum = 1.;
  check_mean<3>(set, cube<3>(10.), 0.2, measure);
}

BOOST_AUTO_TEST_CASE(frequency_along_the_mean_normal)
{
  JointSet<3> set    = set_of_discs();
  set.concentration  = 5.;
  set.intensity      = 0.;
  set.frequency      = 0.5;
  const auto measure = [&set](const Joints<3> &joints) {
    return measure_p10(joints, 20., mean_pole(set));
  };
  check_mean<3>(set, cube<3>(20.), 0.5, measure);
  // the same by the spacing, of planes
  set.frequency   = 0.;
  set.spacing     = 2.;
  set.radius_law  = RadiusDistribution::infinite;
  set.radius_mean = 0.;
  check_mean<3>(set, cube<3>(20.), 0.5, measure);
  set.spacing_law = SpacingDistribution::constant;
  set.jitter      = 0.5;
  check_mean<3>(set, cube<3>(20.), 0.5, measure);
}

BOOST_AUTO_TEST_CASE(planes_at_constant_spacing)
{
  JointSet<3> set;
  set.name          = "bedding";
  set.spacing       = 3.;
  set.spacing_law   = SpacingDistribution::constant;
  const auto joints = make_joints_of_set(set, cube<3>(20.));
  BOOST_REQUIRE(joints.size() >= 6);
  for (unsigned int j = 1; j < joints.size(); ++j)
    BOOST_TEST(std::abs(joints[j]->point[2] - joints[j - 1]->point[2] - 3.) <
               1e-12);
  for (const auto &joint : joints)
    BOOST_TEST((joint->point[2] > 0. && joint->point[2] < 20.));
}

// E cos(theta) = coth(kappa) - 1 / kappa by Fisher's law, and nothing across
BOOST_AUTO_TEST_CASE(fisher_orientations)
{
  JointSet<3> set   = set_of_discs();
  set.dip           = 30.;
  set.concentration = 30.;
  set.region_corner = {5., 5., 5.};
  set.region_size   = {10., 10., 10.};
  const auto axes   = frame(mean_pole(set));
  const auto along  = [&](const Tensor<1, 3> &direction) {
    return [&set, direction](const Joints<3> &joints) {
      double sum = 0.;
      for (const auto &joint : joints)
        sum += (joint->normal() * mean_pole(set) > 0. ? 1. : -1.) *
               (joint->normal() * direction);
      return sum / joints.size();
    };
  };
  const double cosine = 1. / std::tanh(30.) - 1. / 30.;
  check_mean<3>(set, cube<3>(20.), cosine, along(mean_pole(set)));
  for (const auto &axis : axes)
    {
      // so that there is an expected value to be within a tenth of
      const auto across = along(axis);
      check_mean<3>(set, cube<3>(20.), 1., [&](const Joints<3> &joints) {
        return 1. + across(joints);
      });
    }
  BOOST_TEST(std::abs(mean_cosine<3>(30.) - (1. - 1. / 30.)) < 1e-12);
  BOOST_TEST(std::abs(mean_cosine<3>(0.) - 0.5) < 1e-12);
  BOOST_TEST(std::abs(mean_cosine<3>(1.001e-3) - mean_cosine<3>(0.999e-3)) <
             1e-9);
}

// by von Mises' law E|cos| = 0.947520720732537 for kappa = 9.8: the integral by
// mpmath in Python
BOOST_AUTO_TEST_CASE(traces_in_the_plane)
{
  JointSet<2> set;
  set.name          = "A";
  set.dip           = 20.;
  set.dip_direction = 270.;
  set.concentration = 9.8;
  set.intensity     = 0.5;
  set.radius_law    = RadiusDistribution::lognormal;
  set.radius_mean   = 3.;

  set.radius_deviation   = 1.;
  const double size      = 40.;
  const Domain<2> domain = cube<2>(size);
  // length within the square by 100 points a trace
  check_mean<2>(set, domain, 0.5, [size](const Joints<2> &joints) {
    double length = 0.;
    for (const auto &joint : joints)
      for (unsigned int i = 0; i < 100; ++i)
        {
          const Tensor<1, 2> n = joint->normal();
          const double s       = joint->radius * (2. * (i + 0.5) / 100. - 1.);
          const double x       = joint->point[0] - s * n[1],
                       y       = joint->point[1] + s * n[0];
          if (x > 0. && x < size && y > 0. && y < size)
            length += 0.02 * joint->radius;
        }
    return length / (size * size);
  });
  set.region_corner       = {10., 10.};
  set.region_size         = {20., 20.};
  const double mean_angle = 20. / 180. * dealii::numbers::PI;
  check_mean<2>(set, domain, 0.9475207, [&](const Joints<2> &joints) {
    double sum = 0.;
    for (const auto &joint : joints)
      sum += std::abs(-std::sin(mean_angle) * joint->normal()[0] +
                      std::cos(mean_angle) * joint->normal()[1]);
    return sum / joints.size();
  });
  BOOST_TEST(std::abs(mean_cosine<2>(9.8) - 0.947520720732537) < 1e-12);
  BOOST_TEST(std::abs(mean_cosine<2>(0.) - 2. / dealii::numbers::PI) < 1e-10);
  BOOST_TEST(std::abs(mean_cosine<2>(1e5) - (1. - 0.5e-5)) < 1e-9);
}

BOOST_AUTO_TEST_CASE(moments_of_radii)
{
  JointSet<3> set;
  set.name             = "A";
  set.radius_mean      = 2.;
  set.radius_deviation = 1.5;
  set.radius_minimum   = 0.5;
  set.radius_maximum   = 6.;
  using R              = RadiusDistribution;
  for (const R law : {R::uniform, R::exponential, R::lognormal, R::power_law})
    for (const double exponent : {1., 2., 3., 3.7})
      BOOST_TEST_CONTEXT(name_of(law) << ", " << exponent)
      {
        if (law != R::power_law && exponent > 1.)
          continue;
        set.radius_law      = law;
        set.radius_exponent = exponent;
        const RadiusLaw radii(set);
        RandomNumbers random(3);
        std::vector<double> first, second;
        for (unsigned int i = 0; i < 4000; ++i)
          {
            const double r =
              rounded(radii.radius_of<Real>(radii.draw(random).numbers));
            BOOST_REQUIRE((r >= 0.5 && r <= 6.));
            first.push_back(r);
            second.push_back(r * r);
          }
        const Sample mean = mean_of(first), square = mean_of(second);
        BOOST_TEST(std::abs(mean.mean - radii.moment(1)) < 3. * mean.error);
        BOOST_TEST(std::abs(square.mean - radii.moment(2)) < 3. * square.error);
      }
}

BOOST_AUTO_TEST_CASE(discs_and_planes_in_a_domain)
{
  const DomainOutline<3> outline(cube<3>(2.));
  Joint<3> joint;
  joint.normal_entry = {1., 1., 1.};
  joint.point        = Point<3>(1., 1., 1.);
  // the regular hexagon with edges of sqrt(2)
  const auto corners = outline.cut(joint);
  BOOST_REQUIRE(corners.size() == 6u);
  for (unsigned int i = 0; i < 6; ++i)
    BOOST_TEST(std::abs(corners[i].distance(corners[(i + 1) % 6]) -
                        std::sqrt(2.)) < 1e-12);
  joint.point = Point<3>(2.1, 2.1, 2.1);
  BOOST_TEST(outline.cut(joint).empty());
  BOOST_TEST(!outline.meets(joint));
  // a level disc beside the edge x = y = 2, at 0.3 from it on the diagonal
  joint.normal_entry = {0., 0., 1.};
  joint.extent       = JointShape::disc;
  const double place = 2. + 0.3 / std::sqrt(2.);
  joint.point        = Point<3>(place, place, 1.);
  joint.radius       = 0.31;
  BOOST_TEST(outline.meets(joint));
  joint.radius = 0.29;
  BOOST_TEST(!outline.meets(joint));
  joint.point = Point<3>(1., 1., 1.);
  BOOST_TEST(outline.meets(joint));

  // an L, and traces in its notch, through its corner and across an arm
  Domain<2> domain;
  domain.shape   = DomainShape::polygon;
  domain.polygon = {Point<2>(0., 0.),
                    Point<2>(2., 0.),
                    Point<2>(2., 1.),
                    Point<2>(1., 1.),
                    Point<2>(1., 2.),
                    Point<2>(0., 2.)};
  const DomainOutline<2> notched(domain);
  Joint<2> trace;
  trace.extent = JointShape::disc;
  trace.dip    = 45.;
  trace.point  = Point<2>(1.6, 1.6);
  trace.radius = 0.5;
  BOOST_TEST(!notched.meets(trace));
  trace.dip_direction = 270.;
  BOOST_TEST(!notched.meets(trace));
  trace.radius = 0.9;
  BOOST_TEST(notched.meets(trace));
  trace.point = Point<2>(1.5, 0.5);
  BOOST_TEST(notched.meets(trace));
  trace.extent        = JointShape::infinite;
  trace.point         = Point<2>(3.1, 0.);
  trace.dip_direction = 90.;
  BOOST_TEST(!notched.meets(trace));
}

BOOST_AUTO_TEST_CASE(persistence_is_the_jointed_share)
{
  JointSet<3> set = set_of_discs();
  set.intensity = set.frequency = 0.;
  set.spacing                   = 2.;
  const double whole            = intensity_of(set);
  set.persistence               = 0.3;
  BOOST_TEST(intensity_of(set) == 0.3 * whole,
             boost::test_tools::tolerance(1e-14));
  set.radius_law = RadiusDistribution::infinite;
  BOOST_CHECK_THROW(make_joints_of_set(set, cube<3>(10.)), InputError);
}

BOOST_AUTO_TEST_CASE(seeds_and_names_of_sets)
{
  JointSet<3> set   = set_of_discs();
  const auto places = [&]() {
    std::vector<double> list;
    for (const auto &joint : make_joints_of_set(set, cube<3>(10.)))
      list.push_back(joint->point[0]);
    return list;
  };
  const auto first = places();
  BOOST_TEST(places() == first);
  set.seed = 2;
  BOOST_TEST(places() != first);
  set.seed = 1;
  set.name = "B";
  BOOST_TEST(places() != first);
}

// discs of a whole large domain, and of the rock around what is dug
BOOST_AUTO_TEST_CASE(sets_that_fill_the_domain)
{
  const auto warnings = [](const std::string &region) {
    const SceneInMemory memory(
      "set Dimension = 3\n"
      "subsection Domain\n set Corner = -50, -50, -50\n"
      " set Size = 100, 100, 100\nend\n"
      "subsection Mesh\n set Cells = 2, 2, 2\nend\n"
      "subsection Excavations\n set Names = hall\n subsection hall\n"
      "  set Shape = box\n  set Corner = -10, -10, -10\n"
      "  set Size = 20, 20, 20\n end\nend\n"
      "subsection Joint sets\n set Names = A\n subsection A\n"
      "  set P32 = 0.2\n  set Radius law = constant\n"
      "  set Radius mean = 5\n" +
      region +
      " end\nend\n"
      "subsection Materials\n set Names = rock\nend\n");
    Scene<3> scene;
    scene.read(world, memory.name(), {});
    std::vector<std::string> found;
    for (const std::string &warning : scene.warnings())
      if (warning.find("fill the whole domain") != std::string::npos)
        found.push_back(warning);
    return found;
  };
  const auto all = warnings("");
  BOOST_REQUIRE(all.size() == 1u);
  for (const std::string part : {"The sets 'A' fill the whole domain with ",
                                 "'Region corner' and 'Region size'",
                                 "in twice its size, 40, 40, 40 m"})
    BOOST_TEST(all[0].find(part) != std::string::npos, all[0]);
  BOOST_TEST(warnings("  set Region corner = -20, -20, -20\n"
                      "  set Region size = 40, 40, 40\n")
               .empty());
}

BOOST_AUTO_TEST_SUITE_END()
