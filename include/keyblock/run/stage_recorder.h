// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_run_stage_recorder_h
#define keyblock_run_stage_recorder_h

#include <keyblock/run/block_turns.h>
#include <keyblock/run/checkpointing.h>
#include <keyblock/run/progress_line.h>
#include <keyblock/run/stage_observer.h>

#include <functional>

namespace Keyblock
{
  /** Writes down what happens in a stage: histories, VTU, progress on the
   * screen, checkpoints, time spent. */
  template <int dim>
  class StageRecorder : public StageObserver<dim>
  {
  public:
    StageRecorder(const Model<dim> &model,
                  Monitors<dim> &monitors,
                  Output<dim> &output,
                  Checkpointing<dim> &checkpointing,
                  RunRecord<dim> &record,
                  const std::string &folder);

    void started() override;
    void sampled(const StageProgress<dim> &progress) override;
    void stepped(StageProgress<dim> &progress, const Stage &stage) override;
    void save_point(StageProgress<dim> &progress) override;
    void ended(StageProgress<dim> &progress, const Stage &stage) override;

    /** Called where the state could be saved, if it is set: whoever looks on
     * while a stage is run. What it throws breaks the stage off, which can go
     * on afterwards. */
    std::function<void(const StageProgress<dim> &)> watcher;

  private:
    bool writes_vtu() const;
    void write_state();
    void write_vtu(StageProgress<dim> &progress);
    void book_time();
    void print_progress(const StageProgress<dim> &progress);

    /** Whether a VTU is due within a stage: at even shares of its steps, or of
     * the ramp where it ends by its unbalanced ratio. */
    bool is_vtu_due(const StageProgress<dim> &progress,
                    const Stage &stage) const;

    StageAdvance advance_of(const StageProgress<dim> &progress) const;

    /** What the line of progress says, @p points of contact among it. */
    std::vector<ProgressField> fields_of(const StageProgress<dim> &progress,
                                         const StageAdvance &now,
                                         const JointSums<dim> &points) const;

    const Model<dim> &model;
    Monitors<dim> &monitors;
    Output<dim> &output;
    Checkpointing<dim> &checkpointing;
    RunRecord<dim> &record;
    BlockTurns<dim> turns;
    std::string folder;        ///< of output, with '/' at its end, or empty
    double loop_start   = 0.;  ///< wall time [s]
    double next_history = 0.;  ///< wall time of the next append_csv() [s]
    StageAdvance last_printed; ///< at the last line of progress
    unsigned int stage_printed = none; ///< its stage
  };
} // namespace Keyblock

#endif
