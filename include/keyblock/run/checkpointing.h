// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_run_checkpointing_h
#define keyblock_run_checkpointing_h

#include <keyblock/base/stop_request.h>
#include <keyblock/checkpoint/checkpoint.h>
#include <keyblock/run/finite_check.h>
#include <keyblock/run/run_record.h>

namespace Keyblock
{
  /** When a run is saved, what a checkpoint contains, and how it is taken up
   * (all collective). */
  template <int dim>
  class Checkpointing
  {
  public:
    /** @param folder of output, with '/' at its end; empty: nothing is saved
     * @param command that starts the run anew
     * @param wall_start from which the interval of checkpoints counts [s] */
    Checkpointing(Model<dim> &model,
                  Monitors<dim> &monitors,
                  Output<dim> &output,
                  FiniteCheck<dim> &finite_check,
                  RunRecord<dim> &record,
                  const std::string &folder,
                  const std::string &command,
                  const double wall_start);

    /** Save the run if that is due. Throws StopRequest if a signal asks for an
     * end. */
    void save_if_due();
    void save_and_stop(const StopRequest &request);

    /** Keep the present state, the end of a stage (name_of_kept_stage()). */
    void keep_stage();

    /** Go on from @p file, called @p name. */
    void resume(StateFile &file, const std::string &name);

    /** Add all that restore() needs to @p file. */
    void put_state(StateFile &file);
    void restore(StateFile &file);

    /** A sentence about where the last complete checkpoint is; empty if there
     * is none. */
    std::string name_last_checkpoint() const;

  private:
    void save();

    /** Write the run to the file @p name; why that failed, or empty. */
    std::string write(const std::string &name);

    /** name_last_checkpoint(), or that there is none. */
    std::string say_where_to_continue() const;
    void exchange_progress(StateFile &file);
    void exchange_results(StateFile &file);

    /** Remember the checkpoint called @p name as the last complete one. */
    void note_checkpoint(const std::string &name);

    Model<dim> &model;
    Monitors<dim> &monitors;
    Output<dim> &output;
    FiniteCheck<dim> &finite_check;
    RunRecord<dim> &record;
    std::string folder, command;
    std::string last_checkpoint, restart_command; ///< of the run, if any
    double last_saved = 0.; ///< wall time of the last checkpoint [s]
  };

  /** File in the output folder with the end of a stage, @p number from 1. */
  std::string name_of_kept_stage(const unsigned int number);

  /** What a state is read for: to go on, or to find factors in it. */
  enum class StateUse
  {
    restart,
    factors
  };

  /** Throw InputError unless a @p file called @p name was written by a run of
   * the same scene, as far as it had come, but for entries that do not matter
   * to its @p use. */
  template <int dim>
  void check_origin(StateFile &file,
                    const std::string &name,
                    const Scene<dim> &scene,
                    const StateUse use);

  /** The same for the mesh. */
  template <int dim>
  void check_mesh(StateFile &file,
                  const std::string &name,
                  const SplitMesh<dim> &split);
} // namespace Keyblock

#endif
