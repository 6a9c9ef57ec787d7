// SPDX-License-Identifier: LGPL-2.1-or-later
// Liners in 3D: linear triangles that are stretched, and Morley's, which bend.
#include <keyblock/rock/liner_slopes.h>

namespace Keyblock
{
  namespace
  {
    using Vector = Tensor<1, 3>;

    Vector
    unit(const Vector &v)
    {
      return v / v.norm();
    }

    class PlateBuilder
    {
    public:
      PlateBuilder(const LinerSection &section,
                   const std::vector<Point<3>> &places,
                   const std::vector<LinedFace<3>> &faces)
        : section(section)
        , places(places)
        , n_faces(faces.size())
        , slopes(places, faces)
      {}

      std::vector<LinerPiece<3>>
      build()
      {
        std::vector<LinerPiece<3>> pieces;
        for (unsigned int f = 0; f < n_faces; ++f)
          {
            const std::array<LinerRows, 2> diagonals = slopes.at_diagonals(f);
            for (unsigned int k = 0; k < 4; ++k)
              {
                pieces.push_back(stretch(f, k));
                pieces.push_back(bend(f, k, diagonals[k % 2]));
              }
          }
        return pieces;
      }

    private:
      LinerPiece<3>
      begin_piece(const unsigned int f, const unsigned int k) const
      {
        const LinerTriangle &t = slopes.triangle(f, k);
        LinerPiece<3> piece;
        piece.face    = f;
        piece.area    = 0.5 * t.area;
        piece.axes[0] = unit(places[t.points[1]] - places[t.points[0]]);
        piece.axes[1] = cross_product_3d(t.normal, piece.axes[0]);
        return piece;
      }

      LinerPiece<3>
      stretch(const unsigned int f, const unsigned int k) const
      {
        const LinerTriangle &t = slopes.triangle(f, k);
        LinerPiece<3> piece    = begin_piece(f, k);
        piece.is_bending       = false;
        piece.stiffness        = stiffness_of(section.membrane);
        const auto &[e1, e2]   = piece.axes;
        for (unsigned int i = 0; i < 3; ++i)
          {
            const double g1 = t.gradient[i] * e1, g2 = t.gradient[i] * e2;
            piece.points.push_back(t.points[i]);
            piece.rows.push_back({{g1 * e1, g2 * e2, g1 * e2 + g2 * e1}});
          }
        return piece;
      }

      LinerPiece<3>::Stiffness
      stiffness_of(const double modulus) const
      {
        const double nu = section.poisson;
        return {{{{modulus, nu * modulus, 0.}},
                 {{nu * modulus, modulus, 0.}},
                 {{0., 0., 0.5 * (1. - nu) * modulus}}}};
      }

      /** The stiffness that is left where the curvature of @p free makes no
       * moment, as its slope is free. */
      static void
      release(LinerPiece<3>::Stiffness &stiffness,
              const std::array<double, 3> &free)
      {
        std::array<double, 3> moment{};
        double own = 0.;
        for (unsigned int r = 0; r < 3; ++r)
          {
            for (unsigned int s = 0; s < 3; ++s)
              moment[r] += stiffness[r][s] * free[s];
            own += free[r] * moment[r];
          }
        if (own > 1e-9 * (stiffness[0][0] + stiffness[1][1]))
          for (unsigned int r = 0; r < 3; ++r)
            for (unsigned int s = 0; s < 3; ++s)
              stiffness[r][s] -= moment[r] * moment[s] / own;
      }

      LinerPiece<3>
      bend(const unsigned int f,
           const unsigned int k,
           const LinerRows &diagonal)
      {
        const LinerTriangle &t = slopes.triangle(f, k);
        LinerPiece<3> piece    = begin_piece(f, k);
        piece.is_bending       = true;
        piece.stiffness        = stiffness_of(section.bending);
        const auto &[e1, e2]   = piece.axes;
        std::map<unsigned int, LinerPiece<3>::Rows> sum;
        for (unsigned int side = 0; side < 3; ++side)
          {
            const LinerEdge edge(places,
                                 t.points[side],
                                 t.points[(side + 1) % 3]);
            const Vector out = edge.outward(t.normal);
            const double c1 = out * e1, c2 = out * e2;
            const std::array<double, 3> along{{c1 * c1, c2 * c2, 2. * c1 * c2}};
            bool is_free = false;
            LinerRows slope;
            if (side == 2)
              add_rows(slope, diagonal, k < 2 ? 1. : -1.);
            else
              slope = slopes.at_edge(f, (k + 3 + side) % 4, is_free);
            if (is_free)
              {
                release(piece.stiffness, along);
                continue;
              }
            add_rows(slope, t.slope(out), -1.);
            for (const auto &[point, row] : slope)
              for (unsigned int s = 0; s < 3; ++s)
                sum[point][s] -= edge.length / t.area * along[s] * row;
          }
        for (const auto &[point, rows] : sum)
          {
            piece.points.push_back(point);
            piece.rows.push_back(rows);
          }
        return piece;
      }

      const LinerSection &section;
      const std::vector<Point<3>> &places;
      const unsigned int n_faces;
      LinerSlopes slopes;
    };
  } // namespace



  std::vector<LinerPiece<3>>
  make_liner_pieces(const LinerSection &section,
                    const std::vector<Point<3>> &points,
                    const std::vector<LinedFace<3>> &faces)
  {
    return PlateBuilder(section, points, faces).build();
  }
} // namespace Keyblock
