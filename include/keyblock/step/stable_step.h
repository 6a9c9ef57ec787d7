// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_step_stable_step_h
#define keyblock_step_stable_step_h

#include <keyblock/scene/scene.h>

namespace Keyblock
{
  /** What springs and dashpots at nodes do to the stable step, besides the
   * cells. */
  struct StepBound
  {
    double squared_frequency = 0.; ///< highest that is added [rad^2/s^2]
    double damping_rate      = 0.; ///< highest, as mass damping [1/s]
  };

  /** Cell that sets the time step, and the step it allows. */
  template <int dim>
  struct StableStep
  {
    double frequency = 0.; ///< highest of all cells and springs [rad/s]
    Point<dim> place;      ///< centre of that cell [m]

    /** Of dashpots at nodes, besides the mass damping of a stage [1/s]. */
    double damping_rate = 0.;

    /** Take in what acts besides the cells. */
    void add(const StepBound &bound);

    /**
     * Stable step under a stage's damping: y = omega dt / 2 of the velocity
     * that alternates from step to step obeys (1 + alpha) (y^2 + 2 c y) <= 1
     * with c = zeta + a / (2 omega); stiffness damping zeta, mass damping a,
     * local damping alpha. Without mass and local damping that is 2 / omega
     * (sqrt(1 + zeta^2) - zeta) [s].
     */
    double limit(const Stage &stage) const;

    /** Mass damping besides that of the stage with which steps of @p dt are
     * still stable [1/s]. */
    double mass_damping_left(const Stage &stage, const double dt) const;

  private:
    /** Ratio of all viscous damping at the highest frequency [-]. */
    double damping_ratio(const Stage &stage) const;
  };
} // namespace Keyblock

#endif
