// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_step_trial_pressure_h
#define keyblock_step_trial_pressure_h

#include <keyblock/blocks/ground.h>
#include <keyblock/rock/dofs.h>

#include <utility>
#include <vector>

namespace Keyblock
{
  /**
   * A uniform pressure with which a trial supports a block: a dead load on
   * faces as they are undeformed. What a block weighs does not contain it, so
   * that it counts with the internal forces.
   */
  template <int dim>
  class TrialPressure
  {
  public:
    TrialPressure(const SplitMesh<dim> &split, const Numbering<dim> &numbering);

    /** Act on @p faces, and on no others any more. */
    void press_on(const std::vector<CellFace> &faces);

    /** Add it to the internal force of owned degrees of freedom: against what
     * it does to the rock [N]. */
    void add_force(std::vector<double> &force) const;

    double value = 0.; ///< [Pa]

  private:
    const SplitMesh<dim> &split;
    const Numbering<dim> &numbering;

    /** Areas, outwards, by owned degree of freedom [m^(dim-1)]. */
    std::vector<std::pair<unsigned int, double>> areas;
  };
} // namespace Keyblock

#endif
