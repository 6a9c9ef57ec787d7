// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_run_stage_runner_h
#define keyblock_run_stage_runner_h

#include <keyblock/run/finite_check.h>
#include <keyblock/run/model.h>
#include <keyblock/run/stage_observer.h>

namespace Keyblock
{
  /**
   * Runs one stage: excavates, then steps until the stage's end, or solves for
   * equilibrium. Whoever wants to see more than the model's state afterwards
   * observes.
   */
  template <int dim>
  class StageRunner
  {
  public:
    StageRunner(Model<dim> &model,
                FiniteCheck<dim> &finite_check,
                StageObserver<dim> &observer);

    /** Take cells away, change loads and supports, as the stage asks for. */
    void begin(const StageProgress<dim> &progress);

    /** From begin(), or from where a checkpoint was written, to the end. */
    void complete(StageProgress<dim> &progress);

  private:
    void step_through(const Stage &stage, StageProgress<dim> &progress);

    /** Take blocks (by index) away; whether there were any. */
    bool remove_blocks(const std::vector<unsigned int> &failed,
                       const Stage &stage,
                       StageProgress<dim> &progress);

    /** Blocks that have moved too far, move at a steady speed, or have been
     * caught, and not where supports move them. */
    std::vector<unsigned int> list_failed_blocks(StageProgress<dim> &progress);

    /** Whether a block is there that can be taken away. */
    bool can_fail(const unsigned int block) const;

    /** Of the ways of all blocks [m], if they are to be recorded now, those
     * that go at a steady speed. */
    std::vector<bool>
    mark_steady_blocks(const std::vector<BlockMotion<dim>> &motions,
                       const std::vector<double> &ways,
                       StageProgress<dim> &progress) const;
    void pace_ramp(const Stage &stage);
    double ramp_duration_of(const Stage &stage) const;

    /** Whether a dynamic stage moves or loads anything. */
    bool is_shaken(const Stage &stage) const;

    /** Whether displacements of supports are still to be reached. */
    bool are_supports_to_move() const;

    Model<dim> &model;
    FiniteCheck<dim> &finite_check;
    StageObserver<dim> &observer;
  };
} // namespace Keyblock

#endif
