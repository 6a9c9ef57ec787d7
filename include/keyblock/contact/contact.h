// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_contact_contact_h
#define keyblock_contact_contact_h

#include <keyblock/contact/block_motion.h>
#include <keyblock/contact/contact_detection.h>
#include <keyblock/contact/pair_contact.h>
#include <keyblock/contact/pair_exchange.h>
#include <keyblock/contact/report.h>
#include <keyblock/contact/strength_loans.h>
#include <keyblock/contact/surface_contacts.h>

namespace Keyblock
{
  /**
   * The contact step: from predicted velocities to velocities that satisfy
   * non-penetration, Coulomb friction and bonds (hot loop 2).
   *
   * Points that share nodes form groups. Pairs that have not slid form small
   * groups, one per vertex of the mesh before the split: a group that stuck in
   * the last step is merged into one cluster, its forces recovered and tested;
   * if a strength is exceeded it is solved by projected Gauss-Seidel. Every
   * rank that holds a node of such a group solves it, from the same numbers,
   * and so with the same result. Nodes that slid, or met a face they were not
   * paired with, are solved together on all ranks (`mobile`).
   */
  template <int dim>
  class Contact
  {
  public:
    Contact(const Scene<dim> &scene,
            const SplitMesh<dim> &split,
            const Blocks<dim> &blocks,
            const Numbering<dim> &numbering,
            const CellArrays<dim> &cells,
            Fields<dim> &fields);

    // parts refer to each other
    Contact(const Contact &)            = delete;
    Contact &operator=(const Contact &) = delete;

    /** Turn predicted velocities of all local nodes into final ones. */
    void solve(const ContactStep &step);

    /**
     * Prepare for stage @p number of the excavation: masses, supports and cells
     * may have changed, and pairs that rock excavated by then had welded are
     * let go.
     */
    void begin_stage(const unsigned int number);

    /** Let go of what only rock held together that is excavated in stage
     * @p number, with the forces in it. */
    void remove_ties(const unsigned int number);

    /** Let go of a block that is taken away, with the forces on it. */
    void remove_block(const unsigned int block);

    /** Replace all friction angles [deg]; negative: back to the scene's. */
    void
    override_friction(const double angle)
    {
      strength.override_friction(angle);
    }

    /** Divide strengths until further notice. */
    void
    reduce_strength(const StrengthReduction &reduction)
    {
      strength.reduction = reduction;
    }

    /** Whether all points stick from now on, whatever their strength. */
    void
    tie(const bool ties)
    {
      strength.is_tied = ties;
    }

    /**
     * Hold the points that, in the present state, only the mesh makes slide:
     * where it has bent a joint's faces, pressure has a part along the joint.
     * The next step is to be solved with tie(true) before, so that forces are
     * known. Not where a block is exposed (collective).
     * @return number of points held
     */
    unsigned int
    hold_bent_points(const std::vector<bool> &is_exposed)
    {
      return loans.hold_bent_points(is_exposed);
    }

    /** Let those go along the ramp of the stage that begins. */
    void
    release_bent_points()
    {
      loans.release_bent_points();
    }

    const ContactMemory<dim> &
    remember() const
    {
      return memory;
    }

    /** Go back to a state; surface contacts are searched anew. */
    void recall(const ContactMemory<dim> &past);

    /** Take up a state of another run, and what its last search found. */
    void resume(const ContactMemory<dim> &past);

    /** What monitors and safety factors ask. */
    const ContactReport<dim> &
    report() const
    {
      return sums;
    }

    /** How far blocks have gone, each by itself. */
    const BlockMotions<dim> &
    motions() const
    {
      return block_motions;
    }

    /** Pair states of all ranks, by index of the pair (collective). */
    std::vector<PairState<dim>>
    gather_pairs() const
    {
      return gather_pair_states(topology, memory);
    }

    /** Kick interval of the last step [s]. */
    double
    present_kick() const
    {
      return memory.present_kick();
    }

    /** Local nodes that are solved on all ranks: those that have slid, and
     * those that may meet a face. They change when tally.n_searches does. */
    std::vector<unsigned int> list_surface_contact_nodes() const;

    /** Energy in the springs of compliant joints on this rank [J]. */
    double
    spring_energy() const
    {
      return springs.energy();
    }

    ContactTally tally;

  private:
    void remove_pair(const unsigned int p);

    /** One for each pair, if a law remembers them. */
    void keep_histories();

    Fields<dim> &fields;
    ContactSurface<dim> surface;
    ContactSearch<dim> search;
    ContactMemory<dim> memory;
    PairTopology<dim> topology;
    ContactStrength<dim> strength;
    StrengthLoans<dim> loans;
    SurfaceNodes<dim> nodes;
    ContactAreas<dim> areas;
    ContactHistory<dim> history;
    PointSolver<dim> solver;
    JointSprings<dim> springs;
    PairContact<dim> pairs;
    MultiPairContact<dim> multi_pairs;
    ContactDetection<dim> detection;
    SurfaceContacts<dim> surfaces;
    ContactReport<dim> sums;
    BlockMotions<dim> block_motions;
  };
} // namespace Keyblock

#endif
