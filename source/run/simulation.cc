// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/run/earlier_results.h>
#include <keyblock/run/run_estimate.h>
#include <keyblock/run/set_up_report.h>
#include <keyblock/run/simulation.h>
#include <keyblock/run/stage_reporter.h>
#include <keyblock/run/static_stage.h>
#include <keyblock/run/water_check.h>
#include <keyblock/safety/block_statics.h>
#include <keyblock/scene/network_output.h>

#include <filesystem>

namespace Keyblock
{
  namespace
  {
    /** Limit equilibrium alone leaves no states; --factors reads them. */
    template <int dim>
    void
    check_kept_stages(const Scene<dim> &scene)
    {
      AssertThrow(!scene.safety.is_by_statics() || !scene.output.keeps_stages,
                  InputError("The entry 'Safety factor/Method' is limit "
                             "equilibrium, but 'Output/Keep stages' is true, "
                             "where no stage comes to rest; set one of them "
                             "otherwise."));
    }
  } // namespace



  template <int dim>
  Simulation<dim>::Simulation(const Communicator &communicator,
                              const std::string &scene_file,
                              const std::vector<std::string> &overrides,
                              const std::string &output_folder,
                              const std::string &checkpoint)
    : model(communicator, scene_file, overrides)
    , scene_file(scene_file)
    , overrides(overrides)
    , has_chosen_folder(!output_folder.empty())
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
    check_water(model.scene, model.split);
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
    report_stable_step(model, parts->record.report);
    warnings = warnings_of_set_up(model, parts->monitors, parts->record.report);
    parts->record.report.overrides = overrides;
  }



  template <int dim>
  void
  Simulation<dim>::tell_mass_scaling()
  {
    const auto &scaling    = model.conditions->active_cells.mass_scaling;
    const double step      = model.scene.time_stepping.least_step;
    const std::string text = describe_mass_scaling(scaling, model.blocks, step);
    if (text != mass_scaling_text)
      model.out << text << std::flush;
    mass_scaling_text = text;
    model.warnings.add(warnings_of_mass_scaling(scaling, model.blocks, step));
  }



  template <int dim>
  void
  Simulation<dim>::tell_set_up()
  {
    if (model.out.is_active())
      print_mesh(model.out.get_stream(), model, parts->record.report);
    model.warnings.add(warnings);
    tell_mass_scaling();
    if (model.out.is_active())
      print_blocks(model.out.get_stream(), model);
  }



  template <int dim>
  void
  Simulation<dim>::validate()
  {
    check_kept_stages(model.scene);
    model.warnings.add(model.scene.warnings());
    model.make_geometry();
    set_up();
    tell_set_up();
    if (model.out.is_active())
      print_block_statics(model.out.get_stream(),
                          model.scene,
                          model.split,
                          model.blocks);
    print_estimate();
    model.out << "The scene is valid." << std::endl;
  }



  template <int dim>
  void
  Simulation<dim>::print_estimate()
  {
    if (model.scene.safety.is_by_statics())
      return;
    try
      {
        const RunEstimate<dim> estimate(model, *parts);
        if (model.out.is_active())
          estimate.print(model.out.get_stream());
      }
    catch (const ComputationError &error)
      {
        model.warnings.add("The first steps fail, so that time and memory of "
                           "the run cannot be told: " +
                           error.message);
      }
  }



  template <int dim>
  void
  Simulation<dim>::write_nothing()
  {
    folder.clear();
    model.scene.output.write_vtu           = false;
    model.scene.output.checkpoint_interval = 0.;
  }



  template <int dim>
  void
  Simulation<dim>::run()
  {
    start();
    while (has_stage_left())
      run_stage();
    finish();
  }



  template <int dim>
  void
  Simulation<dim>::do_part(const std::function<void()> &part)
  {
    try
      {
        part();
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
  Simulation<dim>::start()
  {
    const bool is_by_statics = model.scene.safety.is_by_statics();
    AssertThrow(checkpoint.empty() || !is_by_statics,
                InputError("The entry 'Safety factor/Method' is limit "
                           "equilibrium, with which nothing is stepped that "
                           "--restart could go on with; leave --restart "
                           "out."));
    check_kept_stages(model.scene);
    if (is_by_statics)
      model.scene.output.checkpoint_interval = 0.;
    groups = std::make_unique<RankGroups>(model.communicator,
                                          model.scene.safety.rank_groups);
    std::unique_ptr<StateFile> file;
    if (!checkpoint.empty())
      {
        file = std::make_unique<StateFile>(model.communicator, checkpoint);
        check_origin(*file, checkpoint, model.scene, StateUse::restart);
      }
    model.warnings.add(model.scene.warnings());
    model.make_geometry();
    if (file)
      check_mesh(*file, checkpoint, model.split);
    set_up();
    if (groups->n() > 1 && !is_by_statics)
      group_study = std::make_unique<RankGroupStudy<dim>>(
        *groups, model, *parts, scene_file, overrides);
    open_output();
    do_part([&]() {
      if (file)
        {
          parts->checkpointing.resume(*file, checkpoint);
          next_stage   = parts->record.present.index;
          is_under_way = true;
          return;
        }
      if (!is_by_statics)
        establish_initial_state(model);
      model.step->sample_start();
      parts->finite_check.check_state();
      parts->monitors.sample_start(*model.step);
      if (model.scene.output.write_vtu)
        parts->output.write_vtu(model.step->time);
    });
  }



  template <int dim>
  bool
  Simulation<dim>::has_stage_left() const
  {
    return next_stage < model.scene.stages.size();
  }



  template <int dim>
  void
  Simulation<dim>::run_stage()
  {
    do_part([&]() {
      if (!is_under_way)
        begin_stage(next_stage);
      is_under_way = true;
      complete_stage();
      is_under_way = false;
      ++next_stage;
    });
  }



  template <int dim>
  SafetyFactor
  Simulation<dim>::find_factor(const unsigned int block)
  {
    AssertThrow(next_stage > 0 && !is_under_way,
                InputError("The factor of block " + std::to_string(block) +
                           " was asked for before a stage was run to its end; "
                           "run one first."));
    return parts->safety.find_factor_of(block);
  }



  template <int dim>
  void
  Simulation<dim>::open_output()
  {
    model.communicator.on_root([&]() {
      if (folder.empty())
        return;
      std::error_code error;
      std::filesystem::create_directories(folder, error);
      AssertThrow(!error,
                  InputError("The output folder '" + folder +
                             "' cannot be made (" + error.message() +
                             "); choose another by --output."));
      const auto earlier = checkpoint.empty()
                             ? list_earlier_results(folder, model.scene)
                             : std::vector<std::filesystem::path>();
      model.scene.write_used(folder + "used.prm");
      model.out << remove_earlier_results(earlier, folder) << std::flush;
      if (!model.scene.joints.empty())
        {
          write_joint_table(folder + "joints.csv", model.scene);
          write_joint_planes(folder + "joints.vtu",
                             model.scene,
                             model.split.mesh.vertices);
        }
      if (model.geostress)
        write_geostress(folder + "geostress.csv", *model.geostress);
    });
    tell_set_up();
    if (model.geostress && model.out.is_active())
      print_geostress(model.out.get_stream(), *model.geostress);
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
    parts->record.has_before =
      progress.wants_factors || keeps_before || model.scene.output.keeps_stages;
    parts->record.before =
      parts->record.has_before ? take_snapshot(model.parts()) : Snapshot<dim>();
    parts->output.stage = progress.number();
    stages->begin(progress);
    tell_mass_scaling();
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
        if (const std::string &warning = record.stage_reports.back().warning;
            !warning.empty())
          model.warnings.add("Stage " + stage.name + ": " + warning);
        present.is_reported = true;
        if (model.scene.output.keeps_stages)
          parts->checkpointing.keep_stage();
        parts->checkpointing.save_if_due();
      }
    if (present.wants_factors && group_study)
      group_study->find_factors();
    else if (present.wants_factors)
      parts->safety.find_remaining_factors(*groups);
    if (present.wants_factors && model.scene.output.write_vtu)
      parts->output.rewrite_rock(model.step->time);
  }

  template class Simulation<2>;
  template class Simulation<3>;
} // namespace Keyblock
