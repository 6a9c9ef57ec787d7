// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_contact_pair_contact_h
#define keyblock_contact_pair_contact_h

#include <keyblock/contact/joint_springs.h>
#include <keyblock/rock/fields.h>

namespace Keyblock
{

  /** Contact of groups of one pair that has not slid, solved on the fields
   * themselves. */
  template <int dim>
  class PairContact
  {
  public:
    PairContact(const PairTopology<dim> &topology,
                const ContactStrength<dim> &strength,
                const std::vector<const double *> &projection,
                PointSolver<dim> &solver,
                JointSprings<dim> &springs,
                Fields<dim> &fields,
                ContactMemory<dim> &memory);

    /** Solve them all; predicted velocities become final ones. */
    void solve(const ContactStep &step);

  private:
    struct SinglePair
    {
      unsigned int pair, minus, plus; ///< local nodes
    };

    /** One velocity for both nodes, if the pair stuck and bears it. */
    bool stick(const SinglePair &single,
               const PointStrength &strength_now,
               const ContactStep &step);

    void solve_alone(const SinglePair &single,
                     const PointStrength &strength_now,
                     const ContactStep &step);

    const PairTopology<dim> &topology;
    const Interface<dim> &interface;
    const Scene<dim> &scene;
    const ContactStrength<dim> &strength;
    PointSolver<dim> &solver;
    JointSprings<dim> &springs;
    Fields<dim> &fields;
    ContactMemory<dim> &memory;
    std::vector<SinglePair> single_pairs;
    std::vector<ContactPoint<dim>> point; ///< of the present pair
    std::vector<PointStrength> broken;
  };
} // namespace Keyblock

#endif
