// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_contact_pair_cluster_h
#define keyblock_contact_pair_cluster_h

#include <keyblock/contact/state.h>
#include <keyblock/contact/surface_nodes.h>

namespace Keyblock
{
  /** A group of pairs that share nodes, moving as one body: its velocity, and
   * the forces between its nodes that this takes. */
  template <int dim>
  class PairCluster
  {
  public:
    /** Which nodes are free, with present masses, supports and pairs. */
    void set_up(const PairTopology<dim> &topology,
                const SurfaceNodes<dim> &nodes,
                const std::vector<PairState<dim>> &state);

    /** The one velocity of all nodes [m/s].
     * @return whether nothing holds it */
    bool find_common_velocity(const SurfaceNodes<dim> &nodes,
                              Vector<dim> &common) const;

    /**
     * Of the impulses that add up to @p needed at the nodes, those nearest to
     * what the pairs have, by area; where nodes are held, the support takes its
     * share.
     * @param needed dim values for each of surface nodes [N s] */
    void recover_impulses(const PairTopology<dim> &topology,
                          const double *needed,
                          std::vector<PairState<dim>> &state) const;

    /** Whether node @p i of surface nodes moves along an axis. */
    bool
    is_free(const unsigned int i, const unsigned int axis) const
    {
      return free_index[axis][i] >= 0;
    }

    unsigned int group;
    std::vector<unsigned int> surface_nodes; ///< its surface nodes

    /** Held in directions that are no axes: it is no cluster then. */
    bool is_oblique = false;

    /** Whether the pairs that are left join all of its nodes: else it is no
     * cluster; a block between two others may have been taken away. */
    bool is_connected = true;

  private:
    /** Whether pairs join all nodes; @p index_of a vertex among the nodes. */
    template <typename Index>
    bool joins_all_nodes(const PairTopology<dim> &topology,
                         const std::vector<PairState<dim>> &state,
                         const Index &index_of) const;

    /** Inverse of the area-weighted Laplacian of the free nodes, one per axis
     * (they differ where nodes are held along an axis). */
    std::array<std::vector<double>, dim> inverse;
    std::array<std::vector<int>, dim> free_index;
  };
} // namespace Keyblock

#endif
