// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_step_bolt_points_h
#define keyblock_step_bolt_points_h

#include <keyblock/step/rock_binding.h>

namespace Keyblock
{
  /**
   * The nodes of all bolts in the rock of this rank: for each bolt the
   * rock's nodes that carry it, each once, and the weights of the bolt's own
   * nodes on them. All bolts stand one behind the other, as a step goes through
   * them.
   */
  template <int dim>
  class BoltPoints
  {
  public:
    /** There are no bolts. */
    void clear();

    /** Add a bolt along @p way (unit vector), the first @p n of whose points
     * are its nodes. */
    void add_bolt(const Tensor<1, dim> &way,
                  const std::vector<RockBinding<dim>> &points,
                  const unsigned int n);

    /** Number of nodes of all bolts. */
    unsigned int
    size() const
    {
      return first_carrier.size() - 1;
    }

    /** Write this rank's part of the displacement of the rock at each node
     * along its bolt to @p along [m]. */
    void gather(const std::vector<double> &displacement, double *along);

    /** Subtract forces on the rock at each node along its bolt from those of
     * this rank's nodes [N]. */
    void subtract(const double *along, std::vector<double> &forces);

  private:
    struct Line
    {
      Tensor<1, dim> way;
      unsigned int end_node;  ///< behind its last one in nodes
      unsigned int end_point; ///< behind its last point
    };
    std::vector<Line> lines;
    std::vector<unsigned int> nodes; ///< of the rock, bolt by bolt
    std::vector<unsigned int> first_carrier = {0}; ///< of each point
    std::vector<unsigned int> slot; ///< of a carrier among the bolt's nodes
    std::vector<double> weight;     ///< of a carrier [-]
    std::vector<double> work;       ///< of one bolt's nodes [m or N]
  };
} // namespace Keyblock

#endif
