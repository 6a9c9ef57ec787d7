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
    /** Places in the list of pairs, by vertices and joint. */
    using PairAt = std::map<std::array<unsigned int, 3>, unsigned int>;

    using Stress = typename CellArrays<dim>::Stress;

    /** One side of a joint's face. */
    struct Side
    {
      unsigned int cell, face; ///< of this rank, and of the cell
      /** Place in the list of the pair at each corner of the face, if any. */
      std::array<unsigned int, Mesh<dim>::n_face_vertices> pair;
      Vector<dim> area; ///< what its stress stands for [m^(dim-1)]
    };

    void add_side(const JointFace &face,
                  Side side,
                  const unsigned int cell,
                  const PairAt &pair_at);

    const PairTopology<dim> &topology;
    const Interface<dim> &interface;
    const CellArrays<dim> &cells;
    const std::vector<unsigned int> &pairs;
    std::vector<Side> sides;
    /** Shares of Gauss points in the mean over a corner's shape function, by
     * the cell's face and its corner. */
    std::array<std::array<std::array<double, Mesh<dim>::n_cell_vertices>,
                          Mesh<dim>::n_face_vertices>,
               2 * dim>
      weights;
    std::vector<Vector<dim>> traction;
  };
} // namespace Keyblock

#endif
