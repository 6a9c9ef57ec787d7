// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_contact_surface_contacts_h
#define keyblock_contact_surface_contacts_h

#include <keyblock/contact/history.h>
#include <keyblock/contact/multi_pair_contact.h>

namespace Keyblock
{

  /**
   * Contact of nodes that slid, or met a face they were not paired with: solved
   * together with the pairs beside them, on all ranks alike. Points are
   * numbered through: surface contacts first, then pairs.
   */
  template <int dim>
  class SurfaceContacts
  {
  public:
    SurfaceContacts(const ContactSearch<dim> &search,
                    const PairTopology<dim> &topology,
                    const ContactStrength<dim> &strength,
                    ContactAreas<dim> &areas,
                    const ContactHistory<dim> &history,
                    MultiPairContact<dim> &pairs_on_nodes,
                    SurfaceNodes<dim> &nodes,
                    PointSolver<dim> &solver,
                    JointSprings<dim> &springs,
                    ContactMemory<dim> &memory);

    void solve(const ContactStep &step);

    /** Push nodes that overlap faces a tenth of the way out. The elastic energy
     * that this takes is booked in @p tally. */
    void correct_penetration(Fields<dim> &fields, ContactTally &tally) const;

  private:
    /** Distance [m] within which two surfaces may meet in this step. */
    double find_reach(const double step) const;

    /** Surface contacts nearer than @p reach [m], with their strengths and the
     * impulses of the step before. */
    void find_contacts(const ContactStep &step, const double reach);
    void drop_removed_blocks();
    void take_over_impulses(const std::vector<SurfaceContact<dim>> &previous,
                            const double scale);

    /** What the pair bore that a surface contact replaces, before it slid. */
    Vector<dim> impulse_of_slid_pair(const SurfaceContact<dim> &contact,
                                     const double scale) const;

    /** Pairs that surface contacts may push; groups that none touches are
     * solved by themselves. */
    std::vector<unsigned int> list_pairs(const ContactStep &step);

    /** Whether node @p k of a point has a share in it and may move. */
    bool can_move(const ContactPoint<dim> &point, const int k) const;

    /** Numbers of the points that share nodes which can move. */
    std::vector<std::vector<unsigned int>>
    group_points(const std::vector<ContactPoint<dim>> &points) const;

    /** Solve them, group by group; @p pairs belong to the last of them. */
    void solve_groups(std::vector<ContactPoint<dim>> &points,
                      const std::vector<unsigned int> &pairs,
                      const ContactStep &step);

    /** Results to the memory, the nodes' impulses and the ledger. */
    void take_up(const std::vector<ContactPoint<dim>> &points,
                 const std::vector<unsigned int> &pairs,
                 const ContactStep &step);

    /** A converted pair shows the surface contact of its nodes. */
    void show_on_converted_pairs();

    /** Put the masters of hanging nodes in their place. */
    void put_masters_into(ContactPoint<dim> &point) const;

    const ContactSearch<dim> &search;
    const PairTopology<dim> &topology;
    const SplitMesh<dim> &split;
    const Interface<dim> &interface;
    const ContactSurface<dim> &surface;
    const ContactStrength<dim> &strength;
    ContactAreas<dim> &areas;
    const ContactHistory<dim> &history;
    MultiPairContact<dim> &pairs_on_nodes;
    SurfaceNodes<dim> &nodes;
    PointSolver<dim> &solver;
    JointSprings<dim> &springs;
    ContactMemory<dim> &memory;
  };
} // namespace Keyblock

#endif
