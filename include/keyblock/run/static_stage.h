// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_run_static_stage_h
#define keyblock_run_static_stage_h

#include <keyblock/run/model.h>

namespace Keyblock
{
  /** Unbalanced ratio of a static stage that is in balance; rock that yields is
   * not, after elastic solves [-]. */
  constexpr double static_tolerance = 1e-8;

  /** Bring the rock, with joints that stick, into balance by elastic solves
   * that refine each other, with this share of the displacements of supports
   * (collective). */
  template <int dim>
  void solve_for_equilibrium(Model<dim> &model,
                             const double share_of_displacements);

  /** The state before the first stage: in balance if the scene asks for it,
   * joints bearing the rock's stress (collective). */
  template <int dim>
  void establish_initial_state(Model<dim> &model);
} // namespace Keyblock

#endif
