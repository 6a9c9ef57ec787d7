// SPDX-License-Identifier: LGPL-2.1-or-later
// Outlines of sections: rows, normals and parts do not depend on the mesh.
#include <boost/test/unit_test.hpp>

#include <keyblock/blocks/excavation_parts.h>
#include <keyblock/blocks/section_outline.h>

#include <algorithm>
#include <cmath>
#include <random>

BOOST_AUTO_TEST_SUITE(section_outline)

using namespace Keyblock;

namespace
{
  constexpr double radian = dealii::numbers::PI / 180.;

  /** A point or normal of the section, in 3D that across y. */
  template <int dim, typename Place = Point<dim>>
  Place
  in_section(const double across, const double up)
  {
    Place place;
    place[0]       = across;
    place[dim - 1] = up;
    return place;
  }

  template <int dim>
  Tensor<1, dim>
  normal_at(const double azimuth)
  {
    return in_section<dim, Tensor<1, dim>>(std::cos(azimuth * radian),
                                           std::sin(azimuth * radian));
  }

  template <int dim>
  Point<dim>
  on_circle(const double azimuth)
  {
    return Point<dim>(3. * normal_at<dim>(azimuth));
  }

  /** Add the side between two corners of a section with the rock to the left,
   * as faces of a mesh of any size. */
  template <int dim>
  void
  add_side(const Point<dim> &begin,
           const Point<dim> &end,
           const double azimuth,
           std::mt19937 &random,
           Outline<dim> &pieces)
  {
    const unsigned int n = 1 + random() % 4;
    for (unsigned int i = 0; i < n; ++i)
      {
        Point<dim> a = begin + double(i) / n * (end - begin),
                   b = begin + double(i + 1) / n * (end - begin);
        if (random() % 2)
          std::swap(a, b);
        pieces.push_back({a, b, normal_at<dim>(azimuth), {}});
      }
  }

  /** A horseshoe of width and height 6 m with six chords. */
  template <int dim>
  std::vector<Outline<dim>>
  horseshoe(std::mt19937 &random)
  {
    Outline<dim> pieces;
    for (unsigned int i = 0; i < 6; ++i)
      add_side<dim>(on_circle<dim>(180. - 30. * i),
                    on_circle<dim>(150. - 30. * i),
                    165. - 30. * i,
                    random,
                    pieces);
    const Point<dim> left  = in_section<dim>(-3., -3.),
                     right = in_section<dim>(3., -3.);
    add_side<dim>(on_circle<dim>(0.), right, 0., random, pieces);
    add_side<dim>(right, left, -90., random, pieces);
    add_side<dim>(left, on_circle<dim>(180.), 180., random, pieces);
    std::shuffle(pieces.begin(), pieces.end(), random);
    Tensor<1, dim> axis;
    if (dim == 3)
      axis[1] = 1.;
    return put_in_rows(pieces, axis);
  }

  /** Azimuth of a normal of the section [degrees]. */
  template <int dim>
  double
  azimuth_of(const Tensor<1, dim> &normal)
  {
    return std::atan2(normal[dim - 1], normal[0]) / radian;
  }

  template <int dim>
  void
  check_horseshoe()
  {
    std::mt19937 random(7);
    const double chord = 6. * std::sin(15. * radian);
    for (unsigned int n = 0; n < 50; ++n)
      {
        const auto rows = horseshoe<dim>(random);
        BOOST_REQUIRE(rows.size() == 1u);
        BOOST_TEST(is_closed(rows[0]));
        BOOST_TEST(rows[0].size() == 9u);
        BOOST_TEST(std::abs(length_of(rows[0]) - 12. - 6. * chord) < 1e-9);
        Tensor<1, dim> up;
        up[dim - 1]     = 1.;
        const auto roof = select_from_rows(rows, [&up](const auto &piece) {
          return is_of_parts<dim>(piece.inward, up, {"roof"});
        });
        // chords at 45 degrees are of the roof, which begins on the left
        BOOST_REQUIRE(roof.size() == 1u);
        BOOST_REQUIRE(roof[0].size() == 4u);
        BOOST_TEST(roof[0][0].begin.distance(on_circle<dim>(150.)) < 1e-9);
        for (unsigned int k = 0; k <= 40; ++k)
          {
            const OutlinePlace<dim> place = place_on(roof[0], 0.1 * k * chord);
            // even along a chord, where azimuths of points are not: these
            // differ by a (x - atan(x tan a) / a), at most 0.1333 degrees for
            // chords of 2 a = 30 degrees
            const double azimuth = azimuth_of<dim>(place.inward);
            BOOST_TEST(std::abs(azimuth - 150. + 3. * k) < 1e-6);
            BOOST_TEST(std::abs(azimuth - azimuth_of<dim>(place.point)) <
                       0.1334);
          }
        // walls keep their normal below and at the corner with the floor, at
        // which a bolt stands between both
        const auto wall = select_from_rows(rows, [](const auto &piece) {
          return piece.inward[0] < -0.99;
        });
        BOOST_REQUIRE(wall.size() == 1u);
        for (const double up : {0.001, 1., 2.})
          BOOST_TEST(
            (place_on(wall[0], up).inward - normal_at<dim>(180.)).norm() <
            1e-12);
        BOOST_TEST(
          (place_on(wall[0], 0.).inward - normal_at<dim>(-135.)).norm() < 1e-9);
      }
  }
} // namespace

BOOST_AUTO_TEST_CASE(horseshoe_of_six_chords)
{
  check_horseshoe<2>();
  check_horseshoe<3>();
}

// Rounding does not part faces at 45 degrees.
BOOST_AUTO_TEST_CASE(parts_at_45_degrees)
{
  for (const double rounding : {-1e-9, -1e-15, 0., 1e-15, 1e-9})
    {
      const double up = std::sqrt(0.5) + rounding;
      BOOST_TEST(part_of_excavation(up) == "roof");
      BOOST_TEST(part_of_excavation(-up) == "floor");
    }
  BOOST_TEST(part_of_excavation(std::sin(44.9 * radian)) == "walls");
  BOOST_TEST(part_of_excavation(-std::sin(44.9 * radian)) == "walls");
}

BOOST_AUTO_TEST_SUITE_END()
