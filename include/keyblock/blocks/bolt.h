// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_blocks_bolt_h
#define keyblock_blocks_bolt_h

#include <keyblock/mesh/cell_point.h>

namespace Keyblock
{
  /** A joint face that a bolt goes through. */
  template <int dim>
  struct BoltCrossing
  {
    double place = 0.; ///< distance from the head [m]
    std::array<unsigned int, 2> block{{none, none}}; ///< towards head and end
    unsigned int joint = none;
    std::array<CellPoint<dim>, 2> side; ///< the rock just before and behind
    Tensor<1, dim> normal;              ///< of the joint there, towards the end
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
    std::vector<double> places; ///< of its nodes, from the head [m]

    /** The rock at each of them when it is installed. */
    std::vector<CellPoint<dim>> rock;

    /** Cells that it passes between its nodes, as many on each segment. */
    std::vector<unsigned int> passed;

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

    Point<dim>
    at(const double s) const
    {
      return head + s * direction();
    }
  };
} // namespace Keyblock

#endif
