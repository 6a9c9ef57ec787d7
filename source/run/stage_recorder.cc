// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/number_text.h>
#include <keyblock/run/stage_recorder.h>
#include <keyblock/run/stage_reporter.h>

#include <algorithm>
#include <cmath>

namespace Keyblock
{
  namespace
  {
    /** Time from one look at the growing history.csv to the next [s]. */
    constexpr double history_interval = 5.;

    /** Steps from look to look at how far blocks have turned. */
    constexpr unsigned int turn_interval = 50;
  } // namespace



  template <int dim>
  StageRecorder<dim>::StageRecorder(const Model<dim> &model,
                                    Monitors<dim> &monitors,
                                    Output<dim> &output,
                                    Checkpointing<dim> &checkpointing,
                                    RunRecord<dim> &record,
                                    const std::string &folder)
    : model(model)
    , monitors(monitors)
    , output(output)
    , checkpointing(checkpointing)
    , record(record)
    , turns(model)
    , folder(folder)
  {}



  template <int dim>
  void
  StageRecorder<dim>::started()
  {
    loop_start = MPI_Wtime();
  }



  template <int dim>
  void
  StageRecorder<dim>::sampled(const StageProgress<dim> &progress)
  {
    monitors.sample(*model.step, progress.index);
    if (folder.empty() || MPI_Wtime() < next_history)
      return;
    monitors.append_csv(folder + "history.csv");
    next_history = MPI_Wtime() + history_interval;
  }



  template <int dim>
  void
  StageRecorder<dim>::stepped(StageProgress<dim> &progress, const Stage &stage)
  {
    if (progress.n_done % turn_interval == 0)
      turns.note(progress);
    if (is_vtu_due(progress, stage))
      write_vtu(progress);
    print_progress(progress);
  }



  template <int dim>
  void
  StageRecorder<dim>::save_point(StageProgress<dim> &progress)
  {
    book_time();
    if (watcher)
      {
        watcher(progress);
        loop_start = MPI_Wtime();
      }
    checkpointing.save_if_due();
  }



  template <int dim>
  void
  StageRecorder<dim>::ended(StageProgress<dim> &progress, const Stage &stage)
  {
    turns.note(progress);
    // what follows does not stand behind the line of progress
    if (model.out.is_active())
      clear_progress(model.out.get_stream());
    if (stage.is_static())
      {
        sampled(progress);
        if (writes_vtu())
          write_state();
        return;
      }
    if (writes_vtu() && stage.is_quasi_static())
      write_vtu(progress);
    book_time();
  }



  template <int dim>
  bool
  StageRecorder<dim>::is_vtu_due(const StageProgress<dim> &progress,
                                 const Stage &stage) const
  {
    const double share =
      (progress.n_vtu + 1.) / std::max(1u, model.scene.output.vtu_count);
    if (!writes_vtu())
      return false;
    if (!stage.is_quasi_static())
      return progress.n_done >= share * progress.n_planned;
    // the last one is that of its end
    const Loads<dim> &loads = model.conditions->loads;
    return loads.is_ramping() && share < 1. &&
           1. - loads.ramp_share_left() >= share;
  }



  template <int dim>
  bool
  StageRecorder<dim>::writes_vtu() const
  {
    return model.scene.output.write_vtu && model.scene.output.vtu_count > 0;
  }



  template <int dim>
  void
  StageRecorder<dim>::write_vtu(StageProgress<dim> &progress)
  {
    book_time();
    write_state();
    ++progress.n_vtu;
    note_overlap(model, progress);
    loop_start = MPI_Wtime();
  }



  template <int dim>
  void
  StageRecorder<dim>::write_state()
  {
    output.write_vtu(model.step->time);
    model.communicator.on_root([&]() {
      write_bolts(folder,
                  output.records,
                  model.conditions->report_bolts(),
                  model.scene);
      write_liners(folder,
                   output.records,
                   model.conditions->report_structural_liners(),
                   model.scene);
    });
  }



  template <int dim>
  void
  StageRecorder<dim>::book_time()
  {
    const double now = MPI_Wtime();
    record.report.loop_time += now - loop_start;
    loop_start = now;
  }



  template <int dim>
  StageAdvance
  StageRecorder<dim>::advance_of(const StageProgress<dim> &progress) const
  {
    const Stage &stage = *model.scene.stages[progress.index];
    StageAdvance now;
    now.time          = MPI_Wtime();
    now.steps         = progress.n_done;
    now.largest_steps = progress.n_planned;
    now.ratio         = model.step->unbalanced_ratio;
    now.target        = stage.duration > 0. ? 0. : stage.unbalanced_ratio;
    now.planned       = now.target > 0. ? 0. : progress.n_planned;
    now.ramp_left     = model.conditions->loads.ramp_share_left();
    return now;
  }



  template <int dim>
  std::vector<ProgressField>
  StageRecorder<dim>::fields_of(const StageProgress<dim> &progress,
                                const StageAdvance &now,
                                const JointSums<dim> &points) const
  {
    const std::string n_done          = std::to_string(progress.n_done);
    std::vector<ProgressField> fields = {
      {"Stage " + std::to_string(progress.index + 1) + " of " +
         std::to_string(model.scene.stages.size()),
       0},
      {" (" + model.scene.stages[progress.index]->name + ")", 4}};
    if (now.planned > 0.)
      fields.push_back(
        {"  step " + n_done + " of " + std::to_string(progress.n_planned), 1});
    else
      fields.push_back({"  step " + n_done, 3});
    if (now.planned == 0. && now.ramp_left > 0.)
      fields.push_back(
        {"  ramp " + std::to_string(std::lround(100. * (1. - now.ramp_left))) +
           " %",
         1});
    if (now.target > 0.)
      fields.push_back({"  unbalanced " + text_of(now.ratio, 3) + " of " +
                          text_of(now.target, 3),
                        1});
    fields.push_back(
      {"  open/sliding/sticking " + std::to_string(points.n_open) + "/" +
         std::to_string(points.n_sliding) + "/" +
         std::to_string(points.n_sticking) +
         (points.n_intact > 0 ? ", bonded " + std::to_string(points.n_intact)
                              : ""),
       5});
    const double left = time_left(last_printed, now);
    if (left >= 0.)
      fields.push_back({"  left " + duration_text(left), 2});
    fields.push_back({"  " +
                        text_of(1e-6 * model.n_cells_global *
                                  (now.steps - last_printed.steps) /
                                  (now.time - last_printed.time),
                                3) +
                        " M element-steps/s",
                      6});
    return fields;
  }



  template <int dim>
  void
  StageRecorder<dim>::print_progress(const StageProgress<dim> &progress)
  {
    const unsigned int width = terminal_width();
    const double interval    = progress_interval(width);
    if (stage_printed != progress.index)
      {
        last_printed  = advance_of(progress);
        stage_printed = progress.index;
      }
    // all ranks must agree on taking part in the sums
    if (model.step->n_steps % 50 != 0 ||
        !model.communicator.on_any(MPI_Wtime() - last_printed.time > interval))
      return;
    const StageAdvance now = advance_of(progress);
    JointSums<dim> points;
    if (model.contact)
      points = model.contact->report().count_points();
    if (model.out.is_active())
      print_fields(model.out.get_stream(),
                   fields_of(progress, now, points),
                   width);
    last_printed = now;
  }

  template class StageRecorder<2>;
  template class StageRecorder<3>;
} // namespace Keyblock
