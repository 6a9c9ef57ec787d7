// SPDX-License-Identifier: LGPL-2.1-or-later
// Sides of planes on which vertices lie: by doubles as by integers, and by
// integers as by numbers of any length.
#include "random_tensor.h"

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/cpp_int.hpp>
#include <boost/test/unit_test.hpp>

#include <keyblock/base/exact_sign.h>

#include <cmath>
#include <random>

BOOST_AUTO_TEST_SUITE(exact_sign)

using namespace Keyblock;

namespace
{
  using Big  = boost::multiprecision::int512_t;
  using Real = boost::multiprecision::cpp_bin_float_100;

  /** Determinant of a matrix of big integers, along its first row. */
  Big
  determinant_of(const std::vector<std::vector<Big>> &rows)
  {
    if (rows.size() == 1)
      return rows[0][0];
    Big sum = 0;
    for (unsigned int j = 0; j < rows.size(); ++j)
      {
        std::vector<std::vector<Big>> rest;
        for (unsigned int i = 1; i < rows.size(); ++i)
          {
            rest.push_back(rows[i]);
            rest.back().erase(rest.back().begin() + j);
          }
        sum += (j % 2 == 0 ? 1 : -1) * rows[0][j] * determinant_of(rest);
      }
    return sum;
  }

  /** Determinant of the planes' normals, or of all of their coefficients if
   * there are more planes than dimensions. */
  template <int dim>
  Big
  determinant_of(const std::vector<ExactPlane<dim>> &planes)
  {
    std::vector<std::vector<Big>> rows;
    for (const auto &plane : planes)
      {
        rows.emplace_back();
        for (unsigned int i = 0; i < planes.size(); ++i)
          rows.back().push_back(plane.multiples[i]);
      }
    return determinant_of(rows);
  }

  struct Counts
  {
    unsigned int vertices = 0, by_doubles = 0, zeros = 0;
  };

  /** Compare sides of planes that are spoilt by @p noise: they pass through one
   * point or are parallel but for that. */
  template <int dim>
  void
  compare(const double noise, std::mt19937 &random, Counts &counts)
  {
    const Point<dim> center(0.5 * random_tensor<dim>(random));
    const Tensor<1, dim> common = random_tensor<dim>(random);
    const bool is_parallel      = random() % 3 == 0;
    std::vector<ExactPlane<dim>> planes;
    while (planes.size() < dim + 1)
      {
        Tensor<1, dim> normal = random_tensor<dim>(random);
        if (is_parallel && planes.size() >= dim - 1)
          normal = common + noise * normal;
        if (random() % 8 == 0) // two with the same normal, or an axis
          normal = planes.empty() ? Tensor<1, dim>(Point<dim>::unit_vector(0))
                                  : planes[0].normal;
        planes.push_back(
          make_exact_plane<dim>(center + noise * random_tensor<dim>(random),
                                normal));
      }
    const Big size = determinant_of<dim>({planes.begin(), planes.end() - 1});
    const std::array<unsigned int, 3> first{{0, 1, 2}};
    std::array<unsigned int, dim> indices;
    std::copy_n(first.begin(), dim, indices.begin());
    if (size == 0)
      return;
    // (only vertices in the box are asked for)
    std::array<double, dim> place;
    for (unsigned int d = 0; d < dim; ++d)
      {
        std::vector<ExactPlane<dim>> replaced(planes.begin(), planes.end() - 1);
        for (auto &plane : replaced)
          plane.multiples[d] = plane.multiples[dim];
        place[d] = -double(Real(determinant_of<dim>(replaced)) / Real(size));
        if (std::abs(place[d]) > 1.)
          return;
      }
    const auto vertex = intersect<dim>(planes, indices);
    ++counts.vertices;
    BOOST_TEST_REQUIRE(vertex.orientation == size.sign());
    for (unsigned int d = 0; d < dim; ++d)
      BOOST_TEST_REQUIRE(std::abs(vertex.x[d] - place[d]) <= vertex.error);
    const int exact = determinant_of<dim>(planes).sign() * size.sign();
    BOOST_TEST_REQUIRE(side_by_integers(planes, vertex, dim) == exact);
    const int side = side_by_doubles(planes[dim], vertex);
    if (side != 0)
      BOOST_TEST_REQUIRE(side == exact);
    BOOST_TEST_REQUIRE(side_of(planes, vertex, dim) == exact);
    BOOST_TEST_REQUIRE(side_of(planes, vertex, 0) == 0);
    counts.by_doubles += side != 0;
    counts.zeros += exact == 0;
  }

  template <int dim>
  void
  compare_many()
  {
    std::mt19937 random(dim);
    Counts counts;
    for (unsigned int i = 0; i < 4000; ++i)
      compare<dim>(std::pow(10., -double(i % 18)), random, counts);
    BOOST_TEST_MESSAGE(dim << "D: " << counts.vertices << " vertices, "
                           << counts.by_doubles << " sides by doubles, "
                           << counts.zeros << " on the plane");
    // each way of deciding must have been tried
    BOOST_TEST(counts.by_doubles > 300u);
    BOOST_TEST(counts.vertices - counts.by_doubles > 300u);
    BOOST_TEST(counts.zeros > 20u);
  }
} // namespace

BOOST_AUTO_TEST_CASE(sides_are_those_of_long_integers)
{
  compare_many<2>();
  compare_many<3>();
}

BOOST_AUTO_TEST_CASE(same_planes_have_the_same_key)
{
  // coefficients of planes through the origin may be multiples of each other
  ExactPlane<3> a = make_exact_plane<3>({}, Point<3>(0., 0., 3.)), b = a;
  b.multiples[2] = -a.multiples[2] + 1;
  BOOST_TEST((a.key() == b.key()));
  const auto c = make_exact_plane<3>({0., 0., 0x1p-52}, Point<3>(0., 0., 1.));
  BOOST_TEST((a.key() != c.key()));
  const auto d = make_exact_plane<3>({0.1, 0.2, 0.3}, Point<3>(1., 2., -0.7));
  const auto e = make_exact_plane<3>({0.1, 0.2, 0.3}, Point<3>(-1., -2., 0.7));
  BOOST_TEST((d.key() == e.key()));
}

BOOST_AUTO_TEST_CASE(planes_of_the_box)
{
  const auto plane = [](const double x, const double slope) {
    return make_exact_plane<2>({x, 0.}, Point<2>(1., slope));
  };
  BOOST_TEST(plane(1., 0.).meets_box());
  BOOST_TEST(!plane(1. + 0x1p-52, 0.).meets_box());
  BOOST_TEST(plane(1.9, 1.).meets_box());
  BOOST_TEST(!plane(2.1, 1.).meets_box());
}

BOOST_AUTO_TEST_SUITE_END()
