// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/run/stage_recorder.h>
#include <keyblock/run/stage_reporter.h>

#include <unistd.h>

#include <cmath>
#include <iomanip>

namespace Keyblock
{
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
  }



  template <int dim>
  void
  StageRecorder<dim>::stepped(StageProgress<dim> &progress, const Stage &stage)
  {
    if (writes_vtu() && !stage.is_quasi_static() &&
        progress.n_done >= double(progress.n_vtu + 1) * progress.n_planned /
                             model.scene.output.vtu_count)
      write_vtu(progress);
    print_progress(progress);
  }



  template <int dim>
  void
  StageRecorder<dim>::save_point(StageProgress<dim> &)
  {
    book_time();
    checkpointing.save_if_due();
  }



  template <int dim>
  void
  StageRecorder<dim>::ended(StageProgress<dim> &progress, const Stage &stage)
  {
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
      write_bolts(folder, output.records, model.conditions->report_bolts());
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
  void
  StageRecorder<dim>::print_progress(const StageProgress<dim> &progress)
  {
    const double fraction = double(progress.n_done) / progress.n_planned;
    const double time     = MPI_Wtime();
    const bool is_live    = isatty(STDOUT_FILENO);
    const double interval = is_live ? 0.5 : 30.;
    if (last_printed == 0.)
      last_printed = time;
    // all ranks must agree on taking part in the sums
    if (model.step->n_steps % 50 != 0 ||
        !model.communicator.on_any(time - last_printed > interval))
      return;
    last_printed = time;
    JointSums<dim> points;
    if (model.contact)
      points = model.contact->report().count_points();
    const double elapsed = time - record.wall_start;
    model.out << (is_live ? "\r" : "")
              << model.scene.stages[progress.index]->name << "  step "
              << model.step->n_steps << "  t = " << std::setprecision(4)
              << model.step->time << " s  "
              << 1e-6 * model.n_cells_global * model.step->n_steps / elapsed
              << " M element-steps/s  kinetic " << model.step->energies.kinetic
              << " J  open/sliding/bonded " << points.n_open << "/"
              << points.n_sliding << "/" << points.n_sticking << "  left "
              << std::lround(elapsed / fraction * (1. - fraction)) << " s"
              << (is_live ? "   " : "\n") << std::flush;
  }

  template class StageRecorder<2>;
  template class StageRecorder<3>;
} // namespace Keyblock
