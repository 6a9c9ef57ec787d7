// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/rock/liner_shell.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace Keyblock
{
  template <int dim>
  std::array<double, LinerPiece<dim>::n_strains>
  LinerPiece<dim>::strains(
    const std::vector<Tensor<1, dim>> &displacement) const
  {
    std::array<double, n_strains> strain{};
    for (unsigned int i = 0; i < points.size(); ++i)
      for (unsigned int s = 0; s < n_strains; ++s)
        strain[s] += rows[i][s] * displacement[points[i]];
    return strain;
  }



  template <int dim>
  std::array<double, LinerPiece<dim>::n_strains>
  LinerPiece<dim>::stresses(
    const std::vector<Tensor<1, dim>> &displacement) const
  {
    const auto strain = strains(displacement);
    std::array<double, n_strains> stress{};
    for (unsigned int s = 0; s < n_strains; ++s)
      for (unsigned int r = 0; r < n_strains; ++r)
        stress[s] += stiffness[s][r] * strain[r];
    return stress;
  }



  template <int dim>
  LinerShell<dim>::LinerShell(const LinerSection &section,
                              const std::vector<Point<dim>> &points,
                              const std::vector<LinedFace<dim>> &faces)
    : pieces(make_liner_pieces(section, points, faces))
  {
    for (const LinedFace<dim> &face : faces)
      points_of_face.push_back(face.points);
    list_columns(points.size());
    assemble();
  }



  template <int dim>
  void
  LinerShell<dim>::list_columns(const unsigned int n_points)
  {
    std::vector<std::set<unsigned int>> beside(n_points);
    for (const LinerPiece<dim> &piece : pieces)
      for (const unsigned int p : piece.points)
        beside[p].insert(piece.points.begin(), piece.points.end());
    row_begin.assign(1, 0);
    for (const std::set<unsigned int> &row : beside)
      {
        columns.insert(columns.end(), row.begin(), row.end());
        row_begin.push_back(columns.size());
      }
  }



  template <int dim>
  void
  LinerShell<dim>::assemble()
  {
    constexpr unsigned int n = LinerPiece<dim>::n_strains;
    blocks.assign(columns.size(), Tensor<2, dim>());
    std::vector<unsigned int> place(n_points());
    for (const LinerPiece<dim> &piece : pieces)
      for (unsigned int i = 0; i < piece.points.size(); ++i)
        {
          const unsigned int p = piece.points[i];
          std::array<Tensor<1, dim>, n> weighted;
          for (unsigned int s = 0; s < n; ++s)
            for (unsigned int r = 0; r < n; ++r)
              weighted[r] +=
                piece.area * piece.stiffness[s][r] * piece.rows[i][s];
          for (unsigned int k = row_begin[p]; k < row_begin[p + 1]; ++k)
            place[columns[k]] = k;
          for (unsigned int j = 0; j < piece.points.size(); ++j)
            for (unsigned int r = 0; r < n; ++r)
              blocks[place[piece.points[j]]] +=
                outer_product(weighted[r], piece.rows[j][r]);
        }
  }



  template <int dim>
  std::vector<double>
  LinerShell<dim>::row_sums() const
  {
    // along the axes of what holds each point by itself: out of the liner and
    // along it
    std::vector<Tensor<2, dim>> axes(n_points());
    for (unsigned int p = 0; p < axes.size(); ++p)
      for (unsigned int i = row_begin[p]; i < row_begin[p + 1]; ++i)
        if (columns[i] == p)
          {
            const auto found = eigenvectors(symmetrize(blocks[i]));
            for (unsigned int d = 0; d < dim; ++d)
              axes[p][d] = found[d].second;
          }
    std::vector<double> sums(n_points(), 0.);
    for (unsigned int p = 0; p < sums.size(); ++p)
      {
        Tensor<1, dim> row;
        for (unsigned int i = row_begin[p]; i < row_begin[p + 1]; ++i)
          {
            const Tensor<2, dim> block =
              axes[p] * blocks[i] * transpose(axes[columns[i]]);
            for (unsigned int d = 0; d < dim; ++d)
              for (unsigned int e = 0; e < dim; ++e)
                row[d] += std::abs(block[d][e]);
          }
        for (unsigned int d = 0; d < dim; ++d)
          sums[p] = std::max(sums[p], row[d]);
      }
    return sums;
  }



  namespace
  {
    /** The tensor with these components along the axes of @p piece. */
    template <int dim>
    SymmetricTensor<2, dim>
    tensor_of(const LinerPiece<dim> &piece,
              const std::array<double, LinerPiece<dim>::n_strains> &value)
    {
      Tensor<2, dim> sum =
        value[0] * outer_product(piece.axes[0], piece.axes[0]);
      if constexpr (dim == 3)
        sum += value[1] * outer_product(piece.axes[1], piece.axes[1]) +
               value[2] * (outer_product(piece.axes[0], piece.axes[1]) +
                           outer_product(piece.axes[1], piece.axes[0]));
      return symmetrize(sum);
    }
  } // namespace



  template <int dim>
  std::vector<LinerForce<dim>>
  LinerShell<dim>::forces(const std::vector<Tensor<1, dim>> &displacement) const
  {
    const unsigned int n_faces = points_of_face.size();
    std::vector<LinerForce<dim>> result(n_faces);
    std::vector<double> area(n_faces, 0.), bend(n_points(), 0.);
    for (const LinerPiece<dim> &piece : pieces)
      {
        const auto stress = piece.stresses(displacement);
        if (dim == 2 && piece.is_bending)
          {
            bend[piece.face] = stress[0];
            continue;
          }
        LinerForce<dim> &force = result[piece.face];
        (piece.is_bending ? force.moment : force.thrust) +=
          piece.area * tensor_of(piece, stress);
        if (!piece.is_bending)
          area[piece.face] += piece.area;
      }
    for (unsigned int f = 0; f < n_faces; ++f)
      {
        result[f].thrust /= area[f];
        result[f].moment /= area[f];
      }
    if constexpr (dim == 2)
      for (const LinerPiece<dim> &piece : pieces)
        if (!piece.is_bending)
          {
            const double begin     = bend[points_of_face[piece.face][0]],
                         end       = bend[points_of_face[piece.face][1]];
            LinerForce<dim> &force = result[piece.face];
            force.shear            = (end - begin) / piece.area;
            force.moment =
              tensor_of(piece,
                        {{std::abs(begin) > std::abs(end) ? begin : end}});
          }
    return result;
  }

  template struct LinerPiece<2>;
  template struct LinerPiece<3>;
  template class LinerShell<2>;
  template class LinerShell<3>;
} // namespace Keyblock
