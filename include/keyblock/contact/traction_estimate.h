// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_contact_traction_estimate_h
#define keyblock_contact_traction_estimate_h

#include <keyblock/contact/topology.h>
#include <keyblock/rock/internal_force.h>

#include <map>

namespace Keyblock
{

  /** Force on pairs that share nodes, from the stress of the cells beside them:
   * where a cluster's forces are not unique, those nearest to it are taken. */
  template <int dim>
  class TractionEstimate
  {
  public:
    TractionEstimate(const PairTopology<dim> &topology,
                     const CellArrays<dim> &cells,
                     const std::vector<unsigned int> &pairs);

    /** Which cells bear on which pairs: after a change of cells. */
    void set_up();

    /** Estimate from present stresses (collective). */
    void update();

    /** On the plus side of a pair [N]. */
    const Vector<dim> &
    of_pair(const unsigned int pair) const
    {
      return traction[pair];
    }

  private:
    /** Share of a Gauss point's stress in the mean traction of a pair. */
    struct TractionWeight
    {
      unsigned int pair, cell, point;
      Vector<dim> weight; ///< [m^(dim-1)]
    };

    /** The pairs listed, by vertices and joint. */
    using PairAt = std::map<std::array<unsigned int, 3>, unsigned int>;

    /** The cell on one side of a joint's face. */
    struct FaceSide
    {
      unsigned int cell, face; ///< of the mesh, and of the cell
      unsigned int local_cell;
      double share; ///< of the force that its stress stands for [-]
    };

    void add_side(const JointFace &face,
                  const FaceSide &side,
                  const PairAt &pair_at);

    const PairTopology<dim> &topology;
    const Interface<dim> &interface;
    const CellArrays<dim> &cells;
    const std::vector<unsigned int> &pairs;
    std::vector<TractionWeight> weights;
    std::vector<Vector<dim>> traction;
  };
} // namespace Keyblock

#endif
