// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_run_simulation_h
#define keyblock_run_simulation_h

#include <keyblock/run/kept_states.h>
#include <keyblock/run/rank_group_study.h>
#include <keyblock/run/stage_recorder.h>
#include <keyblock/run/stage_runner.h>

namespace Keyblock
{
  /** A run from scene to summary: run() tells the story. */
  template <int dim>
  class Simulation
  {
  public:
    /** Read and check the scene; nothing is computed or written.
     * @param checkpoint file to continue from, or empty */
    Simulation(const Communicator &communicator,
               const std::string &scene_file,
               const std::vector<std::string> &overrides,
               const std::string &output_folder,
               const std::string &checkpoint = "");

    /** Mesh, blocks and set-up without output, and what a run will take, by a
     * second of its first steps. */
    void validate();

    /** From the start, or from the checkpoint, to the summary: start(), all
     * stages, finish(). A signal that is watched (base/stop_request.h) lets it,
     * or the part of it that runs, write a checkpoint and throw StopRequest. */
    void run();

    /** Safety factors that the scene asks for now, of states that a run of it
     * has kept; no stage is stepped.
     * @param source folder of that run, or file of a state */
    void find_factors(const std::string &source);
    /** Mesh, blocks, set-up and initial state, or that of the checkpoint. */
    void start();

    bool has_stage_left() const;

    /** Run the next stage to its end, with the factors that are wanted after
     * it; or go on with the one that was stopped. */
    void run_stage();

    /** The summary. */
    void finish();

    /** Factor of the block with this id after the last stage that was run. The
     * state is the same afterwards. Throws InputError. */
    SafetyFactor find_factor(const unsigned int block);

    /** Whatever the scene asks for, write no file; to be called before
     * start(). */
    void write_nothing();

    /** Keep what find_factor() needs of blocks that fail; before run_stage().
     */
    void
    keep_states_before_stages()
    {
      keeps_before = true;
    }

    /** See StageRecorder::watcher; after start(). */
    void
    watch(const std::function<void(const StageProgress<dim> &)> &watcher)
    {
      recorder->watcher = watcher;
    }

    /** Stages that were run, or are in the checkpoint; after start(). */
    const std::vector<StageReport> &
    stages_done() const
    {
      return parts->record.stage_reports;
    }

    /** Those so far: of the scene, its set-up and its stages; after validate()
     * or start(). */
    const std::vector<std::string> &
    all_warnings() const
    {
      return model.warnings.all();
    }

    /** What the run works on, for tests and tools that look at the result. */
    const Model<dim> &
    state() const
    {
      return model;
    }

    /** Say nothing on the screen from now on. */
    void
    be_silent()
    {
      model.out.set_condition(false);
    }

    /** Safety factors that run() has found. */
    const std::vector<SafetyFactor> &
    factors() const
    {
      return parts->record.safety_factors;
    }

    /** What the monitors measured (rank 0). */
    const History &
    measured() const
    {
      return parts->monitors.history;
    }

  private:
    void set_up();
    void tell_set_up();

    /** Time and memory of a run (collective). */
    void print_estimate();

    /** What mass scaling does in the present stage, if that is new. */
    void tell_mass_scaling();
    void open_output();
    void begin_stage(const unsigned int index);
    void complete_stage();
    void conclude();
    void write_results(const CheckValues &checks);

    /** Do a part of a run: if a signal stops it the state is saved; if the
     * computation fails the last checkpoint is named. */
    void do_part(const std::function<void()> &part);

    /** Factors of @p states, in the order of stages. */
    void find_factors(const std::vector<KeptState> &states);

    Model<dim> model;
    std::string scene_file;
    std::vector<std::string> overrides; ///< of its entries
    bool has_chosen_folder;             ///< for output, by its user
    std::string folder;  ///< of output, with '/' at its end; empty: no output
    std::string command; ///< that starts this run anew
    std::string checkpoint; ///< to continue from, or empty
    std::unique_ptr<Run<dim>> parts;
    std::unique_ptr<StageRecorder<dim>> recorder;
    std::unique_ptr<StageRunner<dim>> stages;
    std::unique_ptr<RankGroups> groups;
    std::unique_ptr<RankGroupStudy<dim>> group_study; ///< null: one group
    std::vector<std::string> warnings; ///< of the set-up, not told yet
    std::string mass_scaling_text;     ///< as it was last printed
    double wall_start;                 ///< [s]
    unsigned int next_stage = 0;       ///< or the one that is under way
    bool is_under_way       = false;
    bool keeps_before       = false; ///< states before stages, for factors
  };
} // namespace Keyblock

#endif
