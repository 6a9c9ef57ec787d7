// SPDX-License-Identifier: LGPL-2.1-or-later
// Lines cut by the cells that they go through.
#include <boost/test/unit_test.hpp>

#include <keyblock/mesh/cell_line.h>

#include <cmath>
#include <random>

BOOST_AUTO_TEST_SUITE(cell_line)

using namespace Keyblock;

namespace
{
  /** Cells of about 1, n along each axis, all vertices shifted at random, so
   * that faces in 3D are bent; without the middle one (a void). */
  template <int dim>
  Mesh<dim>
  shaken_mesh(const unsigned int n, std::mt19937 &random)
  {
    std::uniform_real_distribution<double> shift(-0.1, 0.1);
    Mesh<dim> mesh;
    const auto number = [&](const std::array<unsigned int, 3> &i) {
      return i[0] + (n + 1) * (i[1] + (n + 1) * i[2]);
    };
    const unsigned int last = dim == 3 ? n : 0;
    for (unsigned int z = 0; z <= last; ++z)
      for (unsigned int y = 0; y <= n; ++y)
        for (unsigned int x = 0; x <= n; ++x)
          {
            const std::array<double, 3> place{
              {double(x), double(y), double(z)}};
            Point<dim> vertex;
            for (unsigned int d = 0; d < dim; ++d)
              vertex[d] = place[d] + shift(random);
            mesh.vertices.push_back(vertex);
          }
    for (unsigned int z = 0; z < (dim == 3 ? n : 1); ++z)
      for (unsigned int y = 0; y < n; ++y)
        for (unsigned int x = 0; x < n; ++x)
          {
            if (x == n / 2 && y == n / 2 && (dim == 2 || z == n / 2))
              continue;
            typename Mesh<dim>::CellVertices cell;
            for (unsigned int v = 0; v < cell.size(); ++v)
              cell[v] = number({{x + v % 2, y + v / 2 % 2, z + v / 4}});
            mesh.cells.push_back(cell);
          }
    return mesh;
  }

  /** Pieces of random lines are where single points of them are found. */
  template <int dim>
  void
  check_pieces()
  {
    std::mt19937 random(11);
    constexpr unsigned int n         = 5;
    constexpr unsigned int n_lines   = 200;
    constexpr unsigned int n_samples = 4000;
    const Mesh<dim> mesh             = shaken_mesh<dim>(n, random);
    const CellLocator<dim> cells(mesh, [](const unsigned int) { return true; });
    std::vector<unsigned int> part(mesh.n_cells());
    for (unsigned int c = 0; c < part.size(); ++c)
      part[c] = c;
    std::uniform_real_distribution<double> coordinate(-0.5, n + 0.5);
    unsigned int n_in_void = 0;
    for (unsigned int l = 0; l < n_lines; ++l)
      {
        Point<dim> a, b;
        for (unsigned int d = 0; d < dim; ++d)
          {
            a[d] = coordinate(random);
            b[d] = coordinate(random);
          }
        const double length = a.distance(b), shortest = 1e-9 * length;
        const auto pieces = cut_by_cells(mesh, cells, a, b, shortest, part);
        BOOST_TEST(pieces.front().begin == 0.);
        BOOST_TEST(pieces.back().end == length);
        unsigned int k = 0, n_wrong = 0;
        for (unsigned int i = 0; i < n_samples; ++i)
          {
            const double s = length * (i + 0.5) / n_samples;
            while (pieces[k].end < s)
              {
                BOOST_TEST(pieces[k + 1].begin == pieces[k].end);
                ++k;
              }
            // on the face between two cells it is in both
            const bool is_clear =
              s - pieces[k].begin > 1e-5 && pieces[k].end - s > 1e-5;
            n_wrong += is_clear && pieces[k].cell !=
                                     cells.find(a + s / length * (b - a)).cell;
          }
        BOOST_TEST(n_wrong == 0u);
        for (unsigned int i = 1; i + 1 < pieces.size(); ++i)
          n_in_void += pieces[i].cell == none;
      }
    BOOST_TEST(n_in_void > 0u);
  }
} // namespace

BOOST_AUTO_TEST_CASE(cell_line_in_the_plane)
{
  check_pieces<2>();
}

BOOST_AUTO_TEST_CASE(cell_line_through_bent_faces)
{
  check_pieces<3>();
}

// A line along the face between two parts stays in one of them.
BOOST_AUTO_TEST_CASE(cell_line_on_a_face)
{
  Mesh<2> mesh;
  for (unsigned int y = 0; y <= 2; ++y)
    for (unsigned int x = 0; x <= 4; ++x)
      mesh.vertices.push_back({double(x), double(y)});
  std::vector<unsigned int> part;
  // upper and lower cells in turn, so that no part has the first ones
  for (unsigned int x = 0; x < 4; ++x)
    for (const unsigned int y : {x % 2, 1 - x % 2})
      {
        const unsigned int first = x + 5 * y;
        mesh.cells.push_back({{first, first + 1, first + 5, first + 6}});
        part.push_back(y);
      }
  const CellLocator<2> cells(mesh, [](const unsigned int) { return true; });
  const auto pieces =
    cut_by_cells(mesh, cells, {0.5, 1.}, {3.5, 1.}, 1e-6, part);
  BOOST_REQUIRE(pieces.size() == 4u);
  for (const CellPiece &piece : pieces)
    BOOST_TEST(part[piece.cell] == part[pieces[0].cell]);
}

BOOST_AUTO_TEST_SUITE_END()
