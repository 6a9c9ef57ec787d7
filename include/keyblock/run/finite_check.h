// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_run_finite_check_h
#define keyblock_run_finite_check_h

#include <keyblock/output/output.h>
#include <keyblock/run/model.h>

namespace Keyblock
{
  /**
   * Numbers that are not finite, found while it can be told where: they end the
   * run with a ComputationError that says which and where, after the state has
   * been written (all collective).
   */
  template <int dim>
  class FiniteCheck
  {
  public:
    FiniteCheck(const Model<dim> &model,
                Monitors<dim> &monitors,
                Output<dim> &output,
                const std::string &folder);

    /** Displacements and velocities of all nodes. */
    void check_motion();

    /** The same, stresses, and what was measured of the last step. */
    void check_state();

    /** Energies and the unbalanced force, as last sampled. */
    void check_sample();
    void check_factor(const SafetyFactor &factor);
    void check_history() const;

  private:
    /** The block and the step where the quantity @p what is at fault. */
    [[noreturn]] void fail(const std::string &what, const unsigned int block);

    const Model<dim> &model;
    Monitors<dim> &monitors;
    Output<dim> &output;
    std::string folder; ///< of output, with '/' at its end, or empty
  };
} // namespace Keyblock

#endif
