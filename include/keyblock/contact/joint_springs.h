// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_contact_joint_springs_h
#define keyblock_contact_joint_springs_h

#include <keyblock/contact/point_solver.h>
#include <keyblock/contact/strength.h>
#include <keyblock/contact/surface_nodes.h>
#include <keyblock/law/joint_stiffness.h>

namespace Keyblock
{
  /**
   * The springs of points on compliant joints: of pairs, and once these have
   * slid of their nodes, with the area of the pairs that a node has had. Points
   * that are welded or tied, crossing edges, and what meets faces on no joint
   * stay rigid; what a rigid point bears when it is let go is the force that
   * its spring is born with.
   */
  template <int dim>
  class JointSprings
  {
  public:
    JointSprings(const PairTopology<dim> &topology,
                 const ContactStrength<dim> &strength,
                 const SurfaceNodes<dim> &nodes,
                 PointSolver<dim> &solver,
                 ContactMemory<dim> &memory);

    /** Whether some joint is compliant. */
    bool
    are_any() const
    {
      return is_any;
    }

    /** A step begins: its intervals; while bodies settle all is rigid. */
    void
    begin_step(const ContactStep &step)
    {
      present = step;
    }

    /** Whether a pair yields elastically now. */
    bool is_elastic(const unsigned int pair) const;

    /** Give a point that stands for a pair its spring, if it has one.
     * @param inverse_mass of the point [1/kg]
     * @param is_partly_held whether one of its nodes is */
    void put_into_pair(const unsigned int pair,
                       const double inverse_mass,
                       const bool is_partly_held,
                       ContactPoint<dim> &point) const;

    /** Take up what a step has done to a pair: to its spring, or, while it is
     * rigid, the force that its spring is to be born with.
     * @param velocity after the kick, of the plus side from the minus [m/s] */
    void take_up_pair(const unsigned int pair,
                      const ContactPoint<dim> &point,
                      const Vector<dim> &velocity);

    /** The same of a pair that is rigid, with its impulse [N s]. */
    void take_up_rigid(const unsigned int pair, const Vector<dim> &impulse);

    /** Leave a pair's spring, unless it has done so before, to its nodes, which
     * meet others from now on. */
    void pass_on(const unsigned int pair);

    /** Whether a contact on surfaces yields elastically when it is not held. */
    bool has_spring(const SurfaceContact<dim> &contact) const;

    /** Find the offsets of springs that pairs have just left to their nodes,
     * for those that do not touch now and may later. */
    void measure_offsets();

    /** How far apart faces may be that still press on each other [m]. */
    double largest_offset() const;

    /** The springs of surface contacts, before and after they are solved.
     * @param is_booked whether this rank keeps their ledger */
    void put_into_contacts(const bool is_booked);
    void take_up_contacts(const bool is_booked);

    /** Turn those of pairs from @p old_normals to the present ones. */
    void turn_pairs(const std::vector<Vector<dim>> &old_normals);

    /** Energy that is stored in those of this rank [J]. */
    double energy() const;

    /** One for each pair, if a joint is compliant. */
    void allocate();

  private:
    PointSpring<dim> make_spring(const unsigned int joint,
                                 const double area,
                                 const double inverse_mass,
                                 const bool is_partly_held,
                                 const SpringState<dim> &before) const;

    NodeSpring<dim> *find(const unsigned int node, const unsigned int joint);
    NodeSpring<dim> &at(const unsigned int node, const unsigned int joint);

    /** Area of a node's pairs on a joint that have slid, or if it has none
     * there, of that of its pairs which stands for most [m^(dim-1)]. */
    double area_of(const unsigned int node, const unsigned int joint) const;

    /** The spring of the node that was paired with a surface contact's slave,
     * or null. */
    NodeSpring<dim> *find_partner(const SurfaceContact<dim> &contact);

    /** Let a spring that did not bear in the step before take the place of its
     * partner, if that did and no longer does. */
    void replace_partner(const SurfaceContact<dim> &contact,
                         NodeSpring<dim> &spring);

    /** Stretch minus gap of a spring that bears for the first time: so that it
     * goes on as it was, or as its partner or their pair did, or without
     * force. */
    double first_offset(const NodeSpring<dim> &spring,
                        const SurfaceContact<dim> &contact);

    void put_into_contact(SurfaceContact<dim> &contact, const bool is_booked);
    /** The spring of a contact that was rigid, with the force that it bore. */
    void be_born(const SurfaceContact<dim> &contact,
                 NodeSpring<dim> &spring) const;

    const PairTopology<dim> &topology;
    const Interface<dim> &interface;
    const ContactSurface<dim> &surface;
    const ContactStrength<dim> &strength;
    const SurfaceNodes<dim> &nodes;
    PointSolver<dim> &solver;
    ContactMemory<dim> &memory;
    std::vector<JointStiffness> stiffness; ///< by joint
    bool is_any = false;
    ContactStep present;
  };
} // namespace Keyblock

#endif
