// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_contact_multi_pair_contact_h
#define keyblock_contact_multi_pair_contact_h

#include <keyblock/contact/joint_springs.h>
#include <keyblock/contact/pair_cluster.h>
#include <keyblock/contact/traction_estimate.h>

namespace Keyblock
{

  /**
   * Contact of groups of several pairs that share nodes, or with partly held
   * nodes, none of which has slid: a group that stuck in the last step is
   * merged into one cluster, its forces recovered and tested; if a strength is
   * exceeded it is solved by projected Gauss-Seidel.
   */
  template <int dim>
  class MultiPairContact
  {
  public:
    MultiPairContact(const PairTopology<dim> &topology,
                     const ContactStrength<dim> &strength,
                     const CellArrays<dim> &cells,
                     SurfaceNodes<dim> &nodes,
                     PointSolver<dim> &solver,
                     JointSprings<dim> &springs,
                     Fields<dim> &fields,
                     ContactMemory<dim> &memory);

    /** Masses, supports or cells have changed. */
    void set_up();

    /** Blocks have been taken away or have come back: list the nodes of groups
     * and activate them, and those that are solved on all ranks. */
    void list_nodes();
    void activate_nodes();

    /** List those of groups that are solved on all ranks in the memory. */
    void list_surface_contact_groups();

    /** Force on their pairs from present stresses (collective). */
    void
    estimate_tractions()
    {
      if (!pairs.empty())
        tractions.update();
    }

    /** Solve the groups of this rank that are not solved on all. */
    void solve(const ContactStep &step);

    /**
     * Groups solved on all ranks: solve those of which no node @p is_touched by
     * a surface contact, and list the pairs of the others.
     */
    std::vector<unsigned int>
    solve_untouched(const std::vector<bool> &is_touched,
                    const ContactStep &step);

    /** A pair as a point on surface nodes. */
    ContactPoint<dim> as_point(const unsigned int pair,
                               const double kick) const;

  private:
    using Group = PairCluster<dim>;

    void solve_group(Group &group, const ContactStep &step);
    void iterate(Group &group, const ContactStep &step);
    bool try_cluster(Group &group, const ContactStep &step);
    bool may_be_cluster(const Group &group) const;
    bool bears(const Group &group, const ContactStep &step) const;

    void move_together(const Group &group,
                       const bool is_damped,
                       const ContactStep &step,
                       Vector<dim> common);

    /** Whether this rank books the work of a group. */
    bool books(const unsigned int group, const ContactStep &step) const;

    const PairTopology<dim> &topology;
    const Interface<dim> &interface;
    const ContactSurface<dim> &surface;
    const Scene<dim> &scene;
    const ContactStrength<dim> &strength;
    SurfaceNodes<dim> &nodes;
    PointSolver<dim> &solver;
    JointSprings<dim> &springs;
    Fields<dim> &fields;
    ContactMemory<dim> &memory;
    std::vector<Group> groups;
    std::vector<unsigned int> pairs; ///< of all of them
    TractionEstimate<dim> tractions;
  };
} // namespace Keyblock

#endif
