// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/run/set_up_report.h>
#include <keyblock/run/simulation.h>
#include <keyblock/run/stage_reporter.h>
#include <keyblock/run/static_stage.h>
#include <keyblock/safety/block_statics.h>
#include <keyblock/scene/network_output.h>
#include <keyblock/verification/checks.h>

#include <algorithm>
#include <filesystem>
#include <iomanip>

namespace Keyblock
{
  template <int dim>
  Simulation<dim>::Simulation(const Communicator &communicator,
                              const std::string &scene_file,
                              const std::vector<std::string> &overrides,
                              const std::string &output_folder,
                              const std::string &checkpoint)
    : model(communicator, scene_file, overrides)
    , scene_file(scene_file)
    , overrides(overrides)
    , checkpoint(checkpoint)
    , wall_start(MPI_Wtime())
  {
    folder  = !output_folder.empty() ? output_folder
              : !model.scene.output.folder.empty()
                ? model.scene.output.folder
                : "output-" + std::filesystem::path(scene_file).stem().string();
    command = "keyblock " + scene_file + " --output " + folder;
    for (const std::string &assignment : overrides)
      command += " --set \"" + assignment + '"';
    folder += "/";
  }



  template <int dim>
  void
  Simulation<dim>::set_up()
  {
    model.set_up();
    parts    = std::make_unique<Run<dim>>(model, folder, command, wall_start);
    recorder = std::make_unique<StageRecorder<dim>>(model,
                                                    parts->monitors,
                                                    parts->output,
                                                    parts->checkpointing,
                                                    parts->record,
                                                    folder);
    stages =
      std::make_unique<StageRunner<dim>>(model, parts->finite_check, *recorder);
    warnings = warnings_of_set_up(model, parts->monitors);
    report_stable_step(model, parts->record.report);
    parts->record.report.overrides = overrides;
    parts->record.report.warnings  = model.scene.warnings();
    parts->record.report.warnings.insert(parts->record.report.warnings.end(),
                                         warnings.begin(),
                                         warnings.end());
  }



  template <int dim>
  std::string
  Simulation<dim>::mass_scaling_of_stage() const
  {
    return describe_mass_scaling(model.conditions->active_cells.mass_scaling,
                                 model.blocks,
                                 model.scene.time_stepping.least_step);
  }



  template <int dim>
  void
  Simulation<dim>::print_head(std::ostream &out)
  {
    for (const std::string &warning : model.scene.warnings())
      out << "Warning: " << warning << '\n';
    mass_scaling_text = mass_scaling_of_stage();
    print_set_up(out, model, parts->record.report, warnings, mass_scaling_text);
  }



  template <int dim>
  void
  Simulation<dim>::validate()
  {
    model.make_geometry();
    set_up();
    if (model.out.is_active())
      {
        std::ostream &out = model.out.get_stream();
        print_head(out);
        print_block_statics(out, model.scene, model.split, model.blocks);
        out << "The scene is valid.\n";
      }
  }



  template <int dim>
  void
  Simulation<dim>::run()
  {
    watch_signals();
    groups = std::make_unique<RankGroups>(model.communicator,
                                          model.scene.safety.rank_groups);
    std::unique_ptr<StateFile> file;
    if (!checkpoint.empty())
      {
        file = std::make_unique<StateFile>(model.communicator, checkpoint);
        check_origin(*file, checkpoint, model.scene);
      }
    model.make_geometry();
    if (file)
      check_mesh(*file, checkpoint, model.split);
    set_up();
    if (groups->n() > 1)
      group_study = std::make_unique<RankGroupStudy<dim>>(
        *groups, model, *parts, scene_file, overrides);
    open_output();
    try
      {
        if (file)
          parts->checkpointing.resume(*file, checkpoint);
        file.reset();
        run_stages();
        finish();
      }
    catch (const StopRequest &request)
      {
        parts->checkpointing.save_and_stop(request);
        throw;
      }
    catch (const ComputationError &error)
      {
        AssertThrow(false,
                    ComputationError(
                      error.message +
                      parts->checkpointing.name_last_checkpoint()));
      }
  }



  template <int dim>
  void
  Simulation<dim>::open_output()
  {
    model.communicator.on_root([&]() {
      std::error_code error;
      std::filesystem::create_directories(folder, error);
      AssertThrow(!error,
                  InputError("The output folder '" + folder +
                             "' cannot be made (" + error.message() +
                             "); choose another by --output."));
      model.scene.write_used(folder + "used.prm");
      if (!model.scene.joints.empty())
        {
          write_joint_table(folder + "joints.csv", model.scene);
          write_joint_planes(folder + "joints.vtu",
                             model.scene,
                             model.split.mesh.vertices);
        }
      if (model.geostress)
        write_geostress(folder + "geostress.csv", *model.geostress);
      if (!model.out.is_active())
        return;
      print_head(model.out.get_stream());
      if (model.geostress)
        print_geostress(model.out.get_stream(), *model.geostress);
    });
  }



  template <int dim>
  void
  Simulation<dim>::run_stages()
  {
    unsigned int next = 0;
    if (checkpoint.empty())
      {
        establish_initial_state(model);
        model.step->sample_start();
        parts->finite_check.check_state();
        parts->monitors.sample_start(*model.step);
        if (model.scene.output.write_vtu)
          parts->output.write_vtu(model.step->time);
      }
    else
      {
        complete_stage();
        next = parts->record.present.index + 1;
      }
    for (; next < model.scene.stages.size(); ++next)
      {
        begin_stage(next);
        complete_stage();
      }
  }



  template <int dim>
  void
  Simulation<dim>::begin_stage(const unsigned int index)
  {
    const Stage &stage = *model.scene.stages[index];
    if (stage.reset_motion)
      parts->monitors.reset_baseline();
    StageProgress<dim> progress;
    progress.index              = index;
    progress.start_displacement = model.fields.displacement;
    progress.removal_stage      = parts->record.present.removal_stage;
    progress.removal_stage.resize(model.blocks.blocks.size(), 0);
    progress.wants_factors =
      model.contact != nullptr && model.scene.safety.wants_stage(stage.name);
    parts->record.before =
      progress.wants_factors ? take_snapshot(model.parts()) : Snapshot<dim>();
    parts->output.stage = progress.number();
    stages->begin(progress);
    const std::string text = mass_scaling_of_stage();
    if (text != mass_scaling_text)
      model.out << text << std::flush;
    mass_scaling_text     = text;
    progress.first_step   = model.step->n_steps;
    parts->record.present = progress;
  }



  template <int dim>
  void
  Simulation<dim>::complete_stage()
  {
    RunRecord<dim> &record      = parts->record;
    StageProgress<dim> &present = record.present;
    const Stage &stage          = *model.scene.stages[present.index];
    if (!present.is_reported)
      {
        stages->complete(present);
        record.report.element_steps +=
          double(model.step->n_steps - present.first_step) *
          model.n_cells_global;
        parts->finite_check.check_state();
        record.stage_reports.push_back(report_stage(model, present));
        if (model.out.is_active())
          print_stage(model.out.get_stream(),
                      model,
                      stage,
                      record.stage_reports.back());
        present.is_reported = true;
        parts->checkpointing.save_if_due();
      }
    if (present.wants_factors && group_study)
      group_study->find_factors();
    else if (present.wants_factors)
      parts->safety.find_remaining_factors(*groups);
    if (present.wants_factors && model.scene.output.write_vtu)
      parts->output.rewrite_rock(model.step->time);
  }



  template <int dim>
  void
  Simulation<dim>::finish()
  {
    RunRecord<dim> &record = parts->record;
    RunReport &report      = record.report;
    const History &history = parts->monitors.history;
    CheckValues checks;
    RockState<dim> rock;
    if (model.scene.checks.needs_rock())
      rock = gather_rock(
        model.scene, model.split, *model.numbering, model.cells, model.fields);
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
    parts->monitors.write_csv(folder + "history.csv");
    parts->output.write_summary(model.quality,
                                model.mesh_report,
                                report,
                                record.stage_reports,
                                history,
                                checks,
                                record.safety_factors,
                                record.present.removal_stage,
                                model.geostress.get());
    parts->finite_check.check_history();
    if (report.capped_groups > 0)
      model.out << "Warning: " << report.capped_groups << " contact groups of "
                << report.solved_groups
                << " in this run were left at 'Contact/Maximum iterations', "
                   "not solved to "
                   "'Contact/Tolerance'.\n";
    for (const auto &[name, value] : checks)
      model.out << "Check   " << name << " = " << std::setprecision(9) << value
                << '\n';
    model.out << "Output  " << folder << "  (" << std::setprecision(3)
              << report.wall_time << " s)" << std::endl;
  }

  template class Simulation<2>;
  template class Simulation<3>;
} // namespace Keyblock
