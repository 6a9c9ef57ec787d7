// SPDX-License-Identifier: LGPL-2.1-or-later
// How good triangles and tetrahedra are.
#include <keyblock/mesh/simplex_mesh.h>

#include <algorithm>
#include <cmath>

namespace Keyblock
{
  namespace
  {
    /** Altitude of a regular triangle or tetrahedron over its edge [-]. */
    template <int dim>
    constexpr double regular_altitude = (dim == 2) ? 0.866 : 0.8165;

    /** Weight of the scaled Jacobian against the altitude. */
    constexpr double jacobian_weight = 1.5;

    /** Below this altitude shapes are not looked at [-]. */
    constexpr double flat = 0.02;

    inline Tensor<1, 3>
    unit(const Tensor<1, 3> &v)
    {
      return v * (1. / std::sqrt(v * v));
    }

    inline double
    triple(const Tensor<1, 3> &a, const Tensor<1, 3> &b, const Tensor<1, 3> &c)
    {
      return (a[1] * b[2] - a[2] * b[1]) * c[0] +
             (a[2] * b[0] - a[0] * b[2]) * c[1] +
             (a[0] * b[1] - a[1] * b[0]) * c[2];
    }

    /**
     * Least scaled Jacobian of the four hexahedra that a tetrahedron is cut
     * into, over their corners: at the vertices, the middles of edges, the
     * centres of faces and that of the cell. The edges of the hexahedra lie on
     * the edges of the tetrahedron, on the medians of its faces and on its own
     * medians, so that few vectors do for all of them.
     */
    double
    least_piece_jacobian(const std::array<const Point<3> *, 4> &x)
    {
      // the other three vertices in an order that keeps the orientation
      static constexpr unsigned int others[4][3] = {{1, 2, 3},
                                                    {0, 3, 2},
                                                    {0, 1, 3},
                                                    {0, 2, 1}};
      Tensor<1, 3> edge[4][4];   // from, to
      Tensor<1, 3> median[4][4]; // of the face opposite to the first, to the
                                 // second
      Tensor<1, 3> inward[4];    // from the face opposite to it
      for (unsigned int i = 0; i < 4; ++i)
        {
          const Tensor<1, 3> a    = *x[others[i][0]] - *x[i],
                             b    = *x[others[i][1]] - *x[i],
                             c    = *x[others[i][2]] - *x[i];
          edge[i][others[i][0]]   = unit(a);
          edge[i][others[i][1]]   = unit(b);
          edge[i][others[i][2]]   = unit(c);
          median[i][others[i][0]] = unit(2. * a - b - c);
          median[i][others[i][1]] = unit(2. * b - a - c);
          median[i][others[i][2]] = unit(2. * c - a - b);
          inward[i]               = unit(-(a + b + c));
        }
      double least = 1.;
      for (unsigned int i = 0; i < 4; ++i)
        {
          for (unsigned int k = 0; k < 3; ++k)
            {
              const unsigned int a = others[i][k], b = others[i][(k + 1) % 3],
                                 c = others[i][(k + 2) % 3];
              if (i < a)
                least =
                  std::min(least,
                           triple(edge[i][a], median[c][b], median[b][c]));
              least =
                std::min(least, triple(median[c][a], median[c][b], inward[c]));
            }
          const auto [a, b, c] = others[i];
          least                = std::min({least,
                                           triple(edge[i][a], edge[i][b], edge[i][c]),
                                           triple(inward[a], inward[b], inward[c])});
        }
      return least;
    }
  } // namespace



  template <int dim>
  double
  SimplexMesh<dim>::volume(const CellVertices &cell) const
  {
    Tensor<1, dim> edges[dim];
    for (unsigned int i = 0; i < dim; ++i)
      edges[i] = vertices[cell[i + 1]] - vertices[cell[0]];
    if constexpr (dim == 2)
      return 0.5 * (edges[0][0] * edges[1][1] - edges[0][1] * edges[1][0]);
    else
      return triple(edges[0], edges[1], edges[2]) / 6.;
  }



  template <int dim>
  double
  SimplexMesh<dim>::quality(const CellVertices &cell, const double bound) const
  {
    const double size = size_at(cell), measure = volume(cell);
    if (measure <= 0.)
      return measure / std::pow(size, dim) - 1e-12;
    double largest_square = 0.; // of edges, or of twice the areas of faces
    for (unsigned int i = 0; i <= dim; ++i)
      {
        const Point<dim> &a    = vertices[cell[(i + 1) % (dim + 1)]];
        const Tensor<1, dim> e = vertices[cell[(i + 2) % (dim + 1)]] - a;
        if constexpr (dim == 2)
          largest_square = std::max(largest_square, e * e);
        else
          {
            const Tensor<1, dim> normal =
              cross_product_3d(e, vertices[cell[(i + 3) % 4]] - a);
            largest_square = std::max(largest_square, normal * normal);
          }
      }
    const double altitude = (dim == 2 ? 2. : 6.) * measure /
                            std::sqrt(largest_square) /
                            (regular_altitude<dim> * size);
    if constexpr (dim == 2)
      return altitude;
    else
      {
        if (altitude <= std::max(flat, bound))
          return altitude;
        const double jacobian =
          jacobian_weight * least_piece_jacobian({{&vertices[cell[0]],
                                                   &vertices[cell[1]],
                                                   &vertices[cell[2]],
                                                   &vertices[cell[3]]}});
        return std::min(altitude, std::max(jacobian, flat * altitude));
      }
  }



  template <int dim>
  double
  SimplexMesh<dim>::quality_of(const unsigned int cell) const
  {
    if (cells[cell].quality == unknown)
      cells[cell].quality = quality(cells[cell].vertices);
    return cells[cell].quality;
  }



  template <int dim>
  double
  SimplexMesh<dim>::least_quality_at(const unsigned int vertex) const
  {
    double least = 1e300;
    for (const unsigned int cell : cells_at[vertex])
      least = std::min(least, quality_of(cell));
    return least;
  }



  template <int dim>
  typename SimplexMesh<dim>::Qualities
  SimplexMesh<dim>::qualities_at(const unsigned int vertex) const
  {
    Qualities result;
    for (const unsigned int cell : cells_at[vertex])
      result.emplace_back(quality_of(cell), cell);
    std::sort(result.begin(), result.end());
    return result;
  }



  template <int dim>
  typename SimplexMesh<dim>::Qualities
  SimplexMesh<dim>::better_qualities(const Qualities &before) const
  {
    Qualities result;
    const double least = before.front().first;
    for (const auto &[old, cell] : before)
      {
        const double now = quality(cells[cell].vertices, least);
        if (now <= least)
          return {};
        result.emplace_back(now, cell);
      }
    std::sort(result.begin(), result.end());
    return result;
  }

  template double SimplexMesh<2>::volume(const CellVertices &) const;
  template double SimplexMesh<2>::quality(const CellVertices &,
                                          const double) const;
  template double SimplexMesh<2>::quality_of(const unsigned int) const;
  template double SimplexMesh<2>::least_quality_at(const unsigned int) const;
  template SimplexMesh<2>::Qualities
  SimplexMesh<2>::qualities_at(const unsigned int) const;
  template SimplexMesh<2>::Qualities
  SimplexMesh<2>::better_qualities(const Qualities &) const;
  template double SimplexMesh<3>::volume(const CellVertices &) const;
  template double SimplexMesh<3>::quality(const CellVertices &,
                                          const double) const;
  template double SimplexMesh<3>::quality_of(const unsigned int) const;
  template double SimplexMesh<3>::least_quality_at(const unsigned int) const;
  template SimplexMesh<3>::Qualities
  SimplexMesh<3>::qualities_at(const unsigned int) const;
  template SimplexMesh<3>::Qualities
  SimplexMesh<3>::better_qualities(const Qualities &) const;
} // namespace Keyblock
