// SPDX-License-Identifier: LGPL-2.1-or-later
// The end of a run: what it has come to.
#include <keyblock/base/number_text.h>
#include <keyblock/output/liner_output.h>
#include <keyblock/run/simulation.h>
#include <keyblock/verification/checks.h>

#include <iomanip>

namespace Keyblock
{
  template <int dim>
  void
  Simulation<dim>::finish()
  {
    do_part([&]() { conclude(); });
  }



  template <int dim>
  void
  Simulation<dim>::conclude()
  {
    RunRecord<dim> &record = parts->record;
    RunReport &report      = record.report;
    const History &history = parts->monitors.history;
    CheckValues checks;
    RockState<dim> rock;
    if (model.scene.checks.needs_rock())
      rock =
        gather_rock(model.split, *model.numbering, model.cells, model.fields);
    model.communicator.on_root([&]() {
      if (!model.scene.stages.empty())
        checks = evaluate_checks<dim>({model.scene,
                                       model.blocks,
                                       history,
                                       parts->monitors.block_of_monitor,
                                       record.stage_reports,
                                       rock});
    });
    report.steps          = model.step->n_steps;
    report.time_step      = model.step->dt;
    report.simulated_time = model.step->time;
    report.wall_time      = MPI_Wtime() - record.wall_start;
    report.contact_time   = model.step->contact_seconds;
    report.force_time     = model.step->force_seconds;
    report.mass_scaling   = model.conditions->active_cells.mass_scaling;
    report.bolts  = list_figures(model.conditions->report_bolts(), model.scene);
    report.liners = model.conditions->report_liners();
    for (const LinerLoads<dim> &loads :
         model.conditions->report_structural_liners())
      report.structural.push_back(list_figures(loads));
    report.skipped_steps = model.communicator.sum(model.step->n_skipped);
    report.capped_groups =
      model.communicator.sum(model.contact ? model.contact->tally.n_capped : 0);
    report.solved_groups = model.communicator.sum(
      model.contact ? model.contact->tally.n_solved : 0.);
    if (report.capped_groups > 0)
      model.warnings.add(
        std::to_string(report.capped_groups) + " contact groups of " +
        text_of(report.solved_groups) +
        " in this run were left at 'Contact/Maximum iterations', not solved "
        "to 'Contact/Tolerance'.");
    report.warnings = model.warnings.all();
    if (!folder.empty())
      write_results(checks);
    parts->finite_check.check_history();
    for (const auto &[name, value] : checks)
      model.out << "Check   " << name << " = " << std::setprecision(9) << value
                << '\n';
    model.out << "Output  " << (folder.empty() ? "none" : folder) << "  ("
              << std::setprecision(3) << report.wall_time << " s)" << std::endl;
  }



  template <int dim>
  void
  Simulation<dim>::write_results(const CheckValues &checks)
  {
    const RunRecord<dim> &record = parts->record;
    parts->monitors.write_csv(folder + "history.csv");
    parts->output.write_summary(model.quality,
                                model.mesh_report,
                                record.report,
                                record.stage_reports,
                                parts->monitors.history,
                                checks,
                                record.safety_factors,
                                record.present.removal_stage,
                                model.geostress.get());
    parts->output.write_tables(record.present.removal_stage);
  }

#define INSTANTIATE(dim)                                                       \
  template void Simulation<dim>::finish();                                     \
  template void Simulation<dim>::conclude();                                   \
  template void Simulation<dim>::write_results(const CheckValues &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock
