// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_contact_topology_h
#define keyblock_contact_topology_h

#include <keyblock/contact/contact_surface.h>
#include <keyblock/rock/dofs.h>

namespace Keyblock
{

  /** Which pairs, groups of pairs and surface nodes there are, and who has
   * them; the same throughout a run. */
  template <int dim>
  class PairTopology
  {
  public:
    PairTopology(const Scene<dim> &scene,
                 const SplitMesh<dim> &split,
                 const Numbering<dim> &numbering,
                 const ContactSurface<dim> &surface);

    /** Blocks of a pair's minus and plus vertices. */
    std::array<unsigned int, 2> blocks_of_pair(const unsigned int pair) const;

    /** Whether this rank owns a group: its first vertex. */
    bool is_primary(const unsigned int group) const;

    /** Whether a group is one pair of nodes that are free or wholly held.
     * @param projection of surface nodes, null for such */
    bool is_single(const unsigned int group,
                   const std::vector<const double *> &projection) const;

    /** Pairs of a group: [first, second). */
    std::array<unsigned int, 2>
    pairs_of_group(const unsigned int group) const
    {
      return {{interface.group_pairs_begin[group],
               interface.group_pairs_begin[group + 1]}};
    }

    const Scene<dim> &scene;
    const SplitMesh<dim> &split;
    const Interface<dim> &interface;
    const Numbering<dim> &numbering;
    const ContactSurface<dim> &surface; ///< for the numbers of surface nodes

    std::vector<unsigned int> group_of_pair;
    std::vector<unsigned int> group_of_node; ///< by surface node, or `none`
  };

  /** Local nodes of each of @p n_blocks blocks, in order, of those that this
   * rank owns. */
  template <int dim>
  std::vector<std::vector<unsigned int>>
  owned_nodes_of_blocks(const SplitMesh<dim> &split,
                        const Numbering<dim> &numbering,
                        const unsigned int n_blocks);
} // namespace Keyblock

#endif
