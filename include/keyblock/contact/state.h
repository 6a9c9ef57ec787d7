// SPDX-License-Identifier: LGPL-2.1-or-later
// What contact knows of its pairs, remembers, and reports.
#ifndef keyblock_contact_state_h
#define keyblock_contact_state_h

#include <keyblock/contact/surface_contact.h>
#include <keyblock/law/joint_history.h>

namespace Keyblock
{
  /** State of a pair of the interface, the same index as Interface::pairs. */
  template <int dim>
  struct PairState
  {
    Vector<dim> impulse{}; ///< on the plus side, last step [N s]
    ContactStatus status = ContactStatus::sticking;
    bool is_intact       = false;
    bool is_converted    = false; ///< point-to-surface from now on
    bool is_welded       = false; ///< by rock that is excavated later
    bool is_removed      = false; ///< with one of its blocks
    bool has_opened      = false; ///< so that cohesion is gone

    // shear and tension that pressure on faces bent by the mesh asks for [N]
    double bend_shear   = 0.;
    double bend_tension = 0.;

    // what a weld bore beyond the joint's strength when it was let go [N]
    double weld_shear   = 0.;
    double weld_tension = 0.;
  };

  /** What a joint's law remembers of a surface node that has met others than
   * its partners. */
  struct NodeHistory
  {
    unsigned int node, joint;
    JointHistory history;
  };

  /** The spring of a surface node that slides on a compliant joint. */
  template <int dim>
  struct NodeSpring
  {
    unsigned int node, joint;
    SpringState<dim> state; ///< as a slave
    Vector<dim> normal{};   ///< that state is for, out of the other side

    /** Stretch along the normal minus gap [m], once that is known. */
    double offset   = 0.;
    bool has_offset = false;

    double stored          = 0.; ///< energy in the ledger [J]
    unsigned int last_step = 0;  ///< that it bore in
  };

  /** Which strengths are divided by a trial's reduction factor. */
  struct StrengthReduction
  {
    std::vector<unsigned int> blocks; ///< only their joints; empty: all
    std::vector<bool> joints;         ///< by joint; empty: all of them
    double share = 1.; ///< of the strength that is left, 1 / F [-]

    /** Share of strength between two blocks (`none`: no block) on a joint. */
    double
    share_between(const unsigned int a,
                  const unsigned int b,
                  const unsigned int joint) const
    {
      bool is_meant = blocks.empty();
      for (const unsigned int block : blocks)
        is_meant = is_meant || a == block || b == block;
      is_meant =
        is_meant && (joints.empty() || (joint != none && joints[joint]));
      return is_meant ? share : 1.;
    }
  };

  /** All that contact remembers from one step to the next. */
  template <int dim>
  struct ContactMemory
  {
    std::vector<PairState<dim>> state;
    std::vector<Vector<dim>> normal; ///< of each pair, present
    std::vector<bool> is_removed_block, is_surface_contact_group,
      is_surface_contact_node;
    std::vector<unsigned int> surface_contact_nodes;
    std::vector<unsigned int>
      surface_contact_groups;                  ///< of the list of corners
    std::vector<SurfaceContact<dim>> contacts; ///< of the last step

    /** What joints' laws remember, if one does: of each pair, and of nodes that
     * have met others than their partners, by surface node and joint, sorted.
     */
    std::vector<JointHistory> pair_histories;
    std::vector<NodeHistory> node_histories;

    /** The same of springs, if a joint is compliant. */
    std::vector<SpringState<dim>> pair_springs;
    std::vector<NodeSpring<dim>> node_springs;
    unsigned int n_steps = 0;
    double last_kick     = 0.; ///< [s]

    // when surface contacts were searched, and when they are to be again
    std::vector<double> searched_position;

    /** Gap over which something pressed on each other then [m]. */
    double searched_gap            = 0.;
    bool is_search_due             = true;
    unsigned int next_motion_check = 0; ///< step at which motion is measured

    /** How far a pair's slip has opened it [m]. */
    double
    dilation_of(const unsigned int pair) const
    {
      return pair_histories.empty() ? 0. : pair_histories[pair].dilation;
    }

    /** Kick interval of the last step [s]. */
    double
    present_kick() const
    {
      return last_kick > 0. ? last_kick : 1.;
    }
  };

  /** Sums over the contact points of one joint. */
  template <int dim>
  struct JointSums
  {
    Vector<dim> force{};  ///< on the plus (slave) side [N]
    double normal = 0.;   ///< sum of pressures times areas [N]
    double shear  = 0.;   ///< norm of the tangential part of force [N]
    Vector<dim> center{}; ///< centre of the normal force [m]
    unsigned int n_open = 0, n_sliding = 0, n_sticking = 0, n_intact = 0;
  };

  /** Relative motion of the sides of a joint. */
  struct JointMotion
  {
    double slip    = 0.; ///< in its plane [m]
    double opening = 0.; ///< along its normal [m]
  };

  /** Energy that contact took in one step, by kind [J]. */
  struct ContactWork
  {
    double friction    = 0.;
    double closure     = 0.;
    double penetration = 0.;
    double dilation    = 0.; ///< negative: it pushes the sides apart
    double elastic     = 0.; ///< what springs of compliant joints took up
  };

  /** What contact has done since the start, on this rank. */
  struct ContactTally
  {
    ContactWork work;
    unsigned int n_capped     = 0; ///< groups that reached the cap
    double n_solved           = 0; ///< groups solved by iteration
    unsigned int n_iterations = 0; ///< largest of the last step
    unsigned int n_searches   = 0;
  };

  /** What the contact solver needs to know of the present step. */
  struct ContactStep
  {
    double kick          = 0.; ///< h [s]
    double step          = 0.; ///< dt [s]
    double local_damping = 0.;
    bool is_large        = false;
    bool keeps_ledger    = true;
    double weld_share    = 0.; ///< of the stage's former welds that is left [-]
    bool is_settling = false;  ///< bodies are at rest and stay where they are
    bool seeks_rest  = false;  ///< so that springs need not keep energy
  };
} // namespace Keyblock

#endif
