// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/mesh/cell_line.h>

#include <algorithm>
#include <cmath>

namespace Keyblock
{
  namespace
  {
    /** How far beside a face a line still goes through it, in the size of the
     * face: a place too many does no harm [-]. */
    constexpr double face_margin = 1e-6;

    /** Below this, over what it is compared to, a coefficient is 0 [-]. */
    constexpr double round_off = 1e-13;

    template <int dim>
    using FacePoints = std::array<Point<dim>, Mesh<dim>::n_face_vertices>;

    bool
    is_inside(const double share)
    {
      return share >= -face_margin && share <= 1. + face_margin;
    }

    /** Append the distances from @p origin along @p way (unit vector) at which
     * a line goes through a face. */
    void
    append_crossings(const FacePoints<2> &face,
                     const Point<2> &origin,
                     const Tensor<1, 2> &way,
                     std::vector<double> &distances)
    {
      const Tensor<1, 2> edge = face[1] - face[0], to = face[0] - origin;
      const Tensor<1, 2> across{{-way[1], way[0]}};
      const double slope = edge * across;
      if (std::abs(slope) <= round_off * edge.norm())
        return;
      const double share = -(to * across) / slope;
      if (is_inside(share))
        distances.push_back((to + share * edge) * way);
    }

    /** Cross product of vectors in the plane. */
    double
    turn(const Tensor<1, 2> &a, const Tensor<1, 2> &b)
    {
      return a[0] * b[1] - a[1] * b[0];
    }

    /** Real roots of a x^2 + b x + c, of which numbers of size @p scale are the
     * parts. */
    std::vector<double>
    roots(const double a, const double b, const double c, const double scale)
    {
      const double least = round_off * scale;
      if (std::abs(a) <= least)
        return std::abs(b) <= least ? std::vector<double>()
                                    : std::vector<double>{-c / b};
      const double square = std::max(0., b * b - 4. * a * c);
      if (b * b - 4. * a * c < -least * scale)
        return {};
      const double q = -0.5 * (b + std::copysign(std::sqrt(square), b));
      return q == 0. ? std::vector<double>{0.}
                     : std::vector<double>{q / a, c / q};
    }

    /** The same of a bilinear face: as seen along the line, its point at u and
     * v, p + u q + v r + u v w, is at 0. */
    void
    append_crossings(const FacePoints<3> &face,
                     const Point<3> &origin,
                     const Tensor<1, 3> &way,
                     std::vector<double> &distances)
    {
      unsigned int least = 0;
      for (unsigned int d = 1; d < 3; ++d)
        if (std::abs(way[d]) < std::abs(way[least]))
          least = d;
      Tensor<1, 3> axis;
      axis[least]               = 1.;
      Tensor<1, 3> first        = cross_product_3d(way, axis);
      first                     = first / first.norm();
      const Tensor<1, 3> second = cross_product_3d(way, first);
      const auto seen           = [&](const Tensor<1, 3> &x) {
        return Tensor<1, 2>{{x * first, x * second}};
      };
      const Tensor<1, 3> to = face[0] - origin, along_u = face[1] - face[0],
                         along_v = face[2] - face[0],
                         twist   = face[3] - face[2] - along_u;
      const Tensor<1, 2> p = seen(to), q = seen(along_u), r = seen(along_v),
                         w = seen(twist);
      const double size    = along_u.norm() + along_v.norm() + twist.norm();
      for (const double u :
           roots(turn(q, w), turn(p, w) + turn(q, r), turn(p, r), size * size))
        {
          const Tensor<1, 2> slope = r + u * w;
          const double square      = slope.norm_square();
          if (!is_inside(u) || square <= round_off * round_off * size * size)
            continue;
          const double v = -((p + u * q) * slope) / square;
          if (is_inside(v))
            distances.push_back(
              (to + u * along_u + v * along_v + u * v * twist) * way);
        }
    }

    /** Where the pieces of the line end, ascending, its own end among them. */
    template <int dim>
    std::vector<double>
    list_ends(const Mesh<dim> &mesh,
              const CellLocator<dim> &cells,
              const Point<dim> &a,
              const Point<dim> &b,
              const double shortest)
    {
      const double length    = a.distance(b);
      const Tensor<1, dim> t = (b - a) / length;
      std::vector<double> all;
      for (const unsigned int cell : cells.list_along(a, b))
        for (unsigned int f = 0; f < Mesh<dim>::n_cell_faces; ++f)
          {
            const auto vertices = mesh.face_vertices(cell, f);
            FacePoints<dim> face;
            for (unsigned int v = 0; v < face.size(); ++v)
              face[v] = mesh.vertices[vertices[v]];
            append_crossings(face, a, t, all);
          }
      std::sort(all.begin(), all.end());
      std::vector<double> ends;
      for (const double s : all)
        if (s > (ends.empty() ? 0. : ends.back()) + shortest &&
            s < length - shortest)
          ends.push_back(s);
      ends.push_back(length);
      return ends;
    }
  } // namespace



  template <int dim>
  std::vector<CellPiece>
  cut_by_cells(const Mesh<dim> &mesh,
               const CellLocator<dim> &cells,
               const Point<dim> &a,
               const Point<dim> &b,
               const double shortest,
               const std::vector<unsigned int> &part_of_cell)
  {
    const Tensor<1, dim> t = (b - a) / a.distance(b);
    std::vector<CellPiece> pieces;
    double begin = 0.;
    for (const double end : list_ends(mesh, cells, a, b, shortest))
      {
        const std::vector<CellPoint<dim>> around =
          cells.find_all(a + 0.5 * (begin + end) * t);
        CellPiece piece{begin,
                        end,
                        around.empty() ? none : around.front().cell};
        if (!pieces.empty() && pieces.back().cell != none)
          for (const CellPoint<dim> &point : around)
            if (part_of_cell[point.cell] == part_of_cell[pieces.back().cell])
              {
                piece.cell = point.cell;
                break;
              }
        if (!pieces.empty() && pieces.back().cell == piece.cell)
          pieces.back().end = end;
        else
          pieces.push_back(piece);
        begin = end;
      }
    return pieces;
  }

#define INSTANTIATE(dim)                                                       \
  template std::vector<CellPiece> cut_by_cells(                                \
    const Mesh<dim> &,                                                         \
    const CellLocator<dim> &,                                                  \
    const Point<dim> &,                                                        \
    const Point<dim> &,                                                        \
    const double,                                                              \
    const std::vector<unsigned int> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock
