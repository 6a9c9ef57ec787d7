// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_contact_contact_detection_h
#define keyblock_contact_contact_detection_h

#include <keyblock/contact/history.h>
#include <keyblock/contact/multi_pair_contact.h>

namespace Keyblock
{

  /**
   * Which pairs have slid and which nodes may meet a face: what is solved on
   * all ranks alike until the next search.
   */
  template <int dim>
  class ContactDetection
  {
  public:
    ContactDetection(ContactSearch<dim> &search,
                     const PairTopology<dim> &topology,
                     const ContactStrength<dim> &strength,
                     const SurfaceNodes<dim> &nodes,
                     ContactAreas<dim> &areas,
                     ContactHistory<dim> &history,
                     JointSprings<dim> &springs,
                     MultiPairContact<dim> &multi_pairs,
                     Fields<dim> &fields,
                     ContactMemory<dim> &memory);

    /** Convert pairs that have slid; search if one has, or if nodes have moved
     * far (collective). @return whether there was a search */
    bool update(const double step);

    /** Normals of pairs from present positions (collective). */
    void refresh_normals();

    /** Find again what the last search found, at its positions. */
    void search_again();

  private:
    /** Whether a pair is none of faces however far it slides: both nodes are
     * held along its normal, and others of their faces are not. The little that
     * the motion of these closes would be kept open by an impulse without
     * bounds, and with it friction. */
    bool stays_pair(const unsigned int pair) const;

    /** @return whether one has slid on this rank. */
    bool convert_slid_pairs();

    /** Whether a node has moved by half the skin since the last search; looked
     * at again before the fastest can have gone an eighth of it (collective).
     */
    void measure_motion(const double step);

    /** Every rank needs the state of every pair that may be solved on all. */
    void share_pair_states();

    /** Search at searched_position.
     * @param is_moved whether that is new, else only what has converted since
     *   is searched again */
    void list_candidates(const bool is_moved);

    /** Whether a pair stands for the contact of a node with a face. */
    bool is_paired(const unsigned int node,
                   const unsigned int face,
                   const std::vector<bool> &has_converted) const;

    /** Which nodes and groups are solved on all ranks, after a search. */
    void mark_surface_contacts();

    /** Whether a group has a converted pair, by group. */
    std::vector<bool> list_converted_groups() const;

    ContactSearch<dim> &search;
    const ContactSurface<dim> &surface;
    const PairTopology<dim> &topology;
    const Scene<dim> &scene;
    const SplitMesh<dim> &split;
    const Interface<dim> &interface;
    const Numbering<dim> &numbering;
    const ContactStrength<dim> &strength;
    const SurfaceNodes<dim> &nodes;
    ContactAreas<dim> &areas;
    ContactHistory<dim> &history;
    JointSprings<dim> &springs;
    MultiPairContact<dim> &multi_pairs;
    Fields<dim> &fields;
    ContactMemory<dim> &memory;
    std::vector<bool> listed_converted; ///< pairs that were at the last search
  };
} // namespace Keyblock

#endif
