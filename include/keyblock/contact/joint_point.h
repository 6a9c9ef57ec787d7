// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_contact_joint_point_h
#define keyblock_contact_joint_point_h

#include <keyblock/blocks/interface.h>
#include <keyblock/contact/state.h>

namespace Keyblock
{
  /** A contact point of a joint as results show it. */
  template <int dim>
  struct JointPoint
  {
    enum class State
    {
      bonded,
      sticking,
      sliding,
      open,
      welded, ///< by rock that is excavated later
      none    ///< no pair, as where a joint ends
    };

    Vector<dim> normal{}; ///< unit, from minus to plus
    Vector<dim> jump{};   ///< displacement of plus less that of minus [m]
    Vector<dim> stress{}; ///< on the plus side [Pa]
    State state = State::none;

    JointPoint() = default;

    /** That of a pair.
     * @param jump displacement of its plus vertex less that of its minus [m]
     * @param kick interval that impulses are collected over [s] */
    JointPoint(const Pair<dim> &pair,
               const PairState<dim> &at,
               const Vector<dim> &jump,
               const double kick);

    double gap() const;        ///< along the normal, positive when open [m]
    Vector<dim> slip() const;  ///< the rest of the jump [m]
    double pressure() const;   ///< compression positive [Pa]
    Vector<dim> shear() const; ///< the rest of the stress [Pa]
  };

  /** Names of JointPoint::State, in its order. */
  const std::vector<std::string> &joint_state_names();
} // namespace Keyblock

#endif
