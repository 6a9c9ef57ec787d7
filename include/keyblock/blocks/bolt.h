// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_blocks_bolt_h
#define keyblock_blocks_bolt_h

#include <keyblock/mesh/cell_piece.h>
#include <keyblock/mesh/cell_point.h>

namespace Keyblock
{
  /** Where a bolt goes from one block to another: through a joint, or across a
   * void between them. */
  template <int dim>
  struct BoltCrossing
  {
    double begin = 0., end = 0.; ///< distances from the head between which
                                 ///< there is a void; the same at a joint [m]
    std::array<unsigned int, 2> block{{none, none}}; ///< towards head and end
    unsigned int joint = none;                       ///< none: there is a void
    std::array<CellPoint<dim>, 2> side; ///< the rock just before and behind
    Tensor<1, dim> normal; ///< of the joint there, towards the end; 0: no joint

    double
    middle() const
    {
      return 0.5 * (begin + end);
    }

    bool
    is_void() const
    {
      return joint == none;
    }
  };

  /** A bolt: where it is, and of which set. */
  template <int dim>
  struct Bolt
  {
    Bolt(const unsigned int set, const Point<dim> &head, const Point<dim> &end)
      : set(set)
      , head(head)
      , end(end)
    {}

    unsigned int set; ///< index into Scene::bolts
    Point<dim> head, end;
    std::vector<double> places; ///< of its nodes, from the head, ascending [m]

    /** The rock at each of them when it is installed. */
    std::vector<CellPoint<dim>> rock;

    /** What it goes through from the head to the end when it is installed. */
    std::vector<CellPiece> pieces;

    /** Where it goes from one block to another when it is installed. */
    std::vector<BoltCrossing<dim>> crossings;

    double
    length() const
    {
      return head.distance(end);
    }

    Tensor<1, dim>
    direction() const
    {
      return (end - head) / length();
    }

    /** The piece (index) at the distance @p s from the head; between two the
     * one before. */
    unsigned int
    piece_at(const double s) const
    {
      unsigned int k = 0;
      while (k + 1 < pieces.size() && pieces[k + 1].begin < s)
        ++k;
      return k;
    }

    Point<dim>
    at(const double s) const
    {
      return head + s * direction();
    }
  };
} // namespace Keyblock

#endif
