// SPDX-License-Identifier: LGPL-2.1-or-later
// The stiffness of structural liners for static solutions: by pieces, and those
// across the bounds of ranks together.
#include <deal.II/lac/full_matrix.h>

#include <keyblock/step/structural_liner.h>

#include <algorithm>
#include <map>

namespace Keyblock
{
  template <int dim>
  void
  StructuralLiners<dim>::deal_out(Lining &lining) const
  {
    std::vector<bool> is_local(lining.points.size(), true);
    for (const Anchor &anchor : lining.anchors)
      if (anchor.share > 0.)
        split.for_each_carrier(anchor.vertex,
                               [&](const unsigned int carrier, double) {
                                 if (numbering.local_node(carrier) == none)
                                   is_local[anchor.point] = false;
                               });
    const unsigned int n_ranks = numbering.communicator.size();
    std::vector<unsigned int> turned; // the lowest rank has the largest number
    for (const LinerPiece<dim> &piece : lining.shell.all_pieces())
      turned.push_back(
        std::all_of(piece.points.begin(),
                    piece.points.end(),
                    [&](const unsigned int p) { return is_local[p]; })
          ? n_ranks - numbering.communicator.rank()
          : 0);
    if (!turned.empty())
      numbering.communicator.max_lists(turned);
    lining.rank_of_piece.clear();
    for (const unsigned int number : turned)
      lining.rank_of_piece.push_back(n_ranks - number);
  }



  namespace
  {
    /** Stiffness of a piece between the displacements whose rows are @p first
     * and @p second. */
    template <int dim>
    Tensor<2, dim>
    stiffness_between(const LinerPiece<dim> &piece,
                      const typename LinerPiece<dim>::Rows &first,
                      const typename LinerPiece<dim>::Rows &second)
    {
      Tensor<2, dim> sum;
      for (unsigned int s = 0; s < LinerPiece<dim>::n_strains; ++s)
        for (unsigned int r = 0; r < LinerPiece<dim>::n_strains; ++r)
          sum += piece.area * piece.stiffness[s][r] *
                 outer_product(first[s], second[r]);
      return sum;
    }
  } // namespace



  template <int dim>
  void
  StructuralLiners<dim>::for_each_stiffness(
    const typename ForceElement<dim>::AddStiffness &add) const
  {
    for (const Lining &lining : linings)
      for (unsigned int i = 0; i < lining.rank_of_piece.size(); ++i)
        if (lining.rank_of_piece[i] == numbering.communicator.rank())
          {
            const LinerPiece<dim> &piece = lining.shell.all_pieces()[i];
            std::map<unsigned int, typename LinerPiece<dim>::Rows> rows;
            for (unsigned int p = 0; p < piece.points.size(); ++p)
              for (const unsigned int a :
                   lining.anchors_of_point[piece.points[p]])
                split.for_each_carrier(
                  lining.anchors[a].vertex,
                  [&](const unsigned int carrier, const double weight) {
                    auto &row = rows[numbering.local_node(carrier)];
                    for (unsigned int s = 0; s < row.size(); ++s)
                      row[s] +=
                        weight * lining.anchors[a].share * piece.rows[p][s];
                  });
            std::vector<unsigned int> dofs;
            dealii::FullMatrix<double> matrix(dim * rows.size(),
                                              dim * rows.size());
            for (const auto &[node, row] : rows)
              {
                unsigned int at = 0;
                for (const auto &[other, column] : rows)
                  {
                    const Tensor<2, dim> block =
                      stiffness_between(piece, row, column);
                    for (unsigned int d = 0; d < dim; ++d)
                      for (unsigned int e = 0; e < dim; ++e)
                        matrix(dofs.size() + d, at + e) = block[d][e];
                    at += dim;
                  }
                for (unsigned int d = 0; d < dim; ++d)
                  dofs.push_back(dim * node + d);
              }
            add(dofs, matrix);
          }
  }



  template <int dim>
  CoupledStiffness
  StructuralLiners<dim>::coupled_stiffness() const
  {
    using Place = std::pair<unsigned int, unsigned int>; // lining, point
    std::map<Place, unsigned int> places;
    std::map<Place, Tensor<2, dim>> blocks; // between two places
    for (unsigned int l = 0; l < linings.size(); ++l)
      for (unsigned int i = 0; i < linings[l].rank_of_piece.size(); ++i)
        if (linings[l].rank_of_piece[i] == numbering.communicator.size())
          {
            const LinerPiece<dim> &piece = linings[l].shell.all_pieces()[i];
            for (const unsigned int p : piece.points)
              places.try_emplace({l, p}, places.size());
            for (unsigned int p = 0; p < piece.points.size(); ++p)
              for (unsigned int q = 0; q < piece.points.size(); ++q)
                blocks[{places[{l, piece.points[p]}],
                        places[{l, piece.points[q]}]}] +=
                  stiffness_between(piece, piece.rows[p], piece.rows[q]);
          }
    CoupledStiffness result;
    if (places.empty())
      return result;
    result.columns.assign(dim * places.size(),
                          std::vector<double>(dim * numbering.n_owned(), 0.));
    for (const auto &[place, number] : places)
      for (const unsigned int a :
           linings[place.first].anchors_of_point[place.second])
        {
          const Anchor &anchor = linings[place.first].anchors[a];
          for_each_owned(anchor,
                         [&](const unsigned int node, const double weight) {
                           for (unsigned int d = 0; d < dim; ++d)
                             result.columns[dim * number + d][dim * node + d] +=
                               weight * anchor.share;
                         });
        }
    auto coupling =
      std::make_shared<dealii::FullMatrix<double>>(dim * places.size(),
                                                   dim * places.size());
    for (const auto &[pair, block] : blocks)
      for (unsigned int d = 0; d < dim; ++d)
        for (unsigned int e = 0; e < dim; ++e)
          (*coupling)(dim * pair.first + d, dim * pair.second + e) =
            block[d][e];
    result.coupling = coupling;
    return result;
  }

#define INSTANTIATE(dim)                                                       \
  template void StructuralLiners<dim>::deal_out(Lining &) const;               \
  template void StructuralLiners<dim>::for_each_stiffness(                     \
    const typename ForceElement<dim>::AddStiffness &) const;                   \
  template CoupledStiffness StructuralLiners<dim>::coupled_stiffness() const;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock
