// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/blocks/section_outline.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace Keyblock
{
  namespace
  {
    /** Pieces whose unit normals differ by less are in a line [-]. */
    constexpr double straight_tolerance = 1e-4;

    /** Corners above this are none of an arc, each piece keeps its normal there
     * [rad]. Horseshoes of six chords have 30 degrees. */
    constexpr double largest_arc_corner = 35. * dealii::numbers::PI / 180.;

    /** Places as near to each other, in a piece's length, are the same [-]. */
    constexpr double place_tolerance = 1e-6;

    template <int dim>
    double
    angle_between(const Tensor<1, dim> &a, const Tensor<1, dim> &b)
    {
      return 2. * std::asin(std::min(1., 0.5 * (a - b).norm()));
    }

    /** @p from, turned by a share of its angle with @p to (unit vectors). */
    template <int dim>
    Tensor<1, dim>
    turn_towards(const Tensor<1, dim> &from,
                 const Tensor<1, dim> &to,
                 const double share)
    {
      const double angle = angle_between(from, to);
      const Tensor<1, dim> turned =
        std::sin((1. - share) * angle) * from + std::sin(share * angle) * to;
      return turned.norm() > 0. ? turned / turned.norm() : from;
    }

    /** Points by whole numbers, the same for those that touch. */
    template <int dim>
    using Key = std::array<long long, dim>;

    template <int dim>
    Key<dim>
    key_of(const Point<dim> &point, const double tolerance)
    {
      Key<dim> key;
      for (unsigned int d = 0; d < dim; ++d)
        key[d] = std::llround(point[d] / tolerance);
      return key;
    }

    /** Let a piece go around the section as Outline says. */
    template <int dim>
    void
    orient(OutlinePiece<dim> &piece, const Tensor<1, dim> &axis)
    {
      Tensor<1, dim> way;
      if constexpr (dim == 2)
        {
          (void)axis;
          way[0] = piece.inward[1];
          way[1] = -piece.inward[0];
        }
      else
        way = cross_product_3d(axis, piece.inward);
      if ((piece.end - piece.begin) * way < 0.)
        std::swap(piece.begin, piece.end);
    }

    /** Chain oriented pieces. */
    template <int dim>
    std::vector<Outline<dim>>
    chain(const Outline<dim> &pieces, const double tolerance)
    {
      std::multimap<Key<dim>, unsigned int> beginning;
      std::map<Key<dim>, unsigned int> n_ending;
      for (unsigned int i = 0; i < pieces.size(); ++i)
        {
          beginning.emplace(key_of(pieces[i].begin, tolerance), i);
          ++n_ending[key_of(pieces[i].end, tolerance)];
        }
      std::vector<bool> is_used(pieces.size(), false);
      std::vector<Outline<dim>> rows;
      const auto walk = [&](unsigned int i) {
        rows.emplace_back();
        while (true)
          {
            is_used[i] = true;
            rows.back().push_back(pieces[i]);
            const auto range =
              beginning.equal_range(key_of(pieces[i].end, tolerance));
            const auto next =
              std::find_if(range.first, range.second, [&](const auto &entry) {
                return !is_used[entry.second];
              });
            if (next == range.second)
              return;
            i = next->second;
          }
      };
      // open rows from their begins, then closed ones
      for (const bool is_open : {true, false})
        for (unsigned int i = 0; i < pieces.size(); ++i)
          if (!is_used[i] &&
              (!is_open ||
               n_ending.count(key_of(pieces[i].begin, tolerance)) == 0))
            walk(i);
      return rows;
    }

    /** Make one of the pieces of a row that are in a line. */
    template <int dim>
    Outline<dim>
    join_straight(Outline<dim> row)
    {
      const auto is_bent = [](const OutlinePiece<dim> &a,
                              const OutlinePiece<dim> &b) {
        return (a.inward - b.inward).norm() > straight_tolerance;
      };
      if (is_closed(row) && !is_bent(row.back(), row.front()))
        {
          const auto corner =
            std::adjacent_find(row.begin(), row.end(), is_bent);
          if (corner != row.end())
            std::rotate(row.begin(), corner + 1, row.end());
        }
      Outline<dim> joined;
      for (const OutlinePiece<dim> &piece : row)
        if (joined.empty() || is_bent(joined.back(), piece))
          joined.push_back(piece);
        else
          joined.back().end = piece.end;
      return joined;
    }

    /** Tell pieces of a row what is beyond their corners. */
    template <int dim>
    void
    set_corners(Outline<dim> &row)
    {
      const unsigned int n = row.size();
      for (unsigned int i = is_closed(row) ? 0 : 1; i < n; ++i)
        {
          OutlinePiece<dim> &before = row[(i + n - 1) % n], &behind = row[i];
          const bool is_of_arc =
            angle_between(before.inward, behind.inward) < largest_arc_corner;
          const double influence = (is_of_arc ? 0.5 : place_tolerance) *
                                   std::min(before.length(), behind.length());
          before.corner[1] = {behind.inward, influence};
          behind.corner[0] = {before.inward, influence};
        }
    }
  } // namespace



  template <int dim>
  OutlinePlace<dim>
  OutlinePiece<dim>::at(const double distance) const
  {
    const double share = std::min(1., std::max(0., distance / length()));
    OutlinePlace<dim> place{begin + share * (end - begin), inward};
    for (unsigned int i = 0; i < 2; ++i)
      {
        const double far = (i == 0 ? share : 1. - share) * length();
        if (far >= corner[i].influence)
          continue;
        // all of a corner that is none of an arc counts
        const bool is_of_arc =
          corner[i].influence > 2. * place_tolerance * length();
        const double part = is_of_arc ? 1. - far / corner[i].influence : 1.;
        place.inward      = turn_towards(inward, corner[i].beyond, 0.5 * part);
      }
    return place;
  }



  template <int dim>
  double
  length_of(const Outline<dim> &outline)
  {
    double length = 0.;
    for (const OutlinePiece<dim> &piece : outline)
      length += piece.length();
    return length;
  }



  template <int dim>
  bool
  is_closed(const Outline<dim> &outline)
  {
    return outline.front().begin.distance(outline.back().end) <
           place_tolerance * length_of(outline);
  }



  template <int dim>
  OutlinePlace<dim>
  place_on(const Outline<dim> &outline, const double distance)
  {
    double passed = 0.;
    for (const OutlinePiece<dim> &piece : outline)
      {
        if (distance <= passed + piece.length())
          return piece.at(distance - passed);
        passed += piece.length();
      }
    return outline.back().at(outline.back().length());
  }



  template <int dim>
  std::vector<Outline<dim>>
  put_in_rows(Outline<dim> pieces, const Tensor<1, dim> &axis)
  {
    double size = 0.;
    for (OutlinePiece<dim> &piece : pieces)
      {
        orient(piece, axis);
        size = std::max(size, piece.length());
      }
    const double tolerance         = place_tolerance * size;
    std::vector<Outline<dim>> rows = chain(pieces, tolerance);
    for (Outline<dim> &row : rows)
      {
        row = join_straight(row);
        set_corners(row);
        // closed ones from the same corner in any mesh
        if (is_closed(row))
          std::rotate(row.begin(),
                      std::min_element(row.begin(),
                                       row.end(),
                                       [&](const auto &a, const auto &b) {
                                         return key_of(a.begin, tolerance) <
                                                key_of(b.begin, tolerance);
                                       }),
                      row.end());
      }
    std::sort(rows.begin(), rows.end(), [&](const auto &a, const auto &b) {
      return key_of(a.front().begin, tolerance) <
             key_of(b.front().begin, tolerance);
    });
    return rows;
  }

#define INSTANTIATE(dim)                                                       \
  template struct OutlinePiece<dim>;                                           \
  template double length_of(const Outline<dim> &);                             \
  template bool is_closed(const Outline<dim> &);                               \
  template OutlinePlace<dim> place_on(const Outline<dim> &, const double);     \
  template std::vector<Outline<dim>> put_in_rows(Outline<dim>,                 \
                                                 const Tensor<1, dim> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock
