// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_blocks_section_outline_h
#define keyblock_blocks_section_outline_h

#include <keyblock/mesh/surface.h>

#include <array>
#include <vector>

namespace Keyblock
{
  /** A place on the outline of an excavation's section. */
  template <int dim>
  struct OutlinePlace
  {
    Point<dim> point;
    Tensor<1, dim> inward; ///< unit normal there, into the rock
  };

  /**
   * A straight piece of the outline of an excavation's section. Chords of an
   * arc have the arc's normals: at their ends the bisector of both chords, from
   * there on evenly towards their own one in their middle.
   */
  template <int dim>
  struct OutlinePiece
  {
    Point<dim> begin, end;
    Tensor<1, dim> inward; ///< its own unit normal, into the rock

    /** A corner at its begin or end. */
    struct Corner
    {
      Tensor<1, dim> beyond; ///< normal of the next piece; zero: none
      double influence = 0.; ///< how far it turns this one's normal [m]
    };
    std::array<Corner, 2> corner{};

    double
    length() const
    {
      return begin.distance(end);
    }

    /** What is at a distance from its begin [m]. */
    OutlinePlace<dim> at(const double distance) const;
  };

  /** Pieces from one end to the other, clockwise around the section as seen
   * along its axis: over a roof to the right. */
  template <int dim>
  using Outline = std::vector<OutlinePiece<dim>>;

  /** Length of an outline [m]. */
  template <int dim>
  double length_of(const Outline<dim> &outline);

  template <int dim>
  bool is_closed(const Outline<dim> &outline);

  /** What is at a distance along the outline [m]. */
  template <int dim>
  OutlinePlace<dim> place_on(const Outline<dim> &outline,
                             const double distance);

  /**
   * Put pieces of one section across @p axis (2D: none) that touch into rows,
   * those in a line as one. Of their corners those less than 35 degrees are of
   * an arc. Neither rows nor pieces depend on the order of @p pieces.
   */
  template <int dim>
  std::vector<Outline<dim>> put_in_rows(Outline<dim> pieces,
                                        const Tensor<1, dim> &axis);

  /** The rows of those of @p rows for which @p is_wanted holds, whose corners
   * stay. */
  template <int dim, typename IsWanted>
  std::vector<Outline<dim>>
  select_from_rows(const std::vector<Outline<dim>> &rows,
                   const IsWanted &is_wanted)
  {
    std::vector<Outline<dim>> selected;
    for (const Outline<dim> &row : rows)
      {
        const std::size_t n_before = selected.size();
        bool is_going_on           = false;
        for (const OutlinePiece<dim> &piece : row)
          {
            const bool is_of_row = is_wanted(piece);
            if (is_of_row && !is_going_on)
              selected.emplace_back();
            if (is_of_row)
              selected.back().push_back(piece);
            is_going_on = is_of_row;
          }
        // around the place where a closed one begins
        if (selected.size() > n_before + 1 && is_closed(row) && is_going_on &&
            is_wanted(row.front()))
          {
            Outline<dim> &first = selected[n_before];
            first.insert(first.begin(),
                         selected.back().begin(),
                         selected.back().end());
            selected.pop_back();
          }
      }
    return selected;
  }
} // namespace Keyblock

#endif
