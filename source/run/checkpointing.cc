// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/run/checkpointing.h>
#include <keyblock/run/progress_line.h>

#include <cstring>
#include <iomanip>

namespace Keyblock
{
  template <int dim>
  Checkpointing<dim>::Checkpointing(Model<dim> &model,
                                    Monitors<dim> &monitors,
                                    Output<dim> &output,
                                    FiniteCheck<dim> &finite_check,
                                    RunRecord<dim> &record,
                                    const std::string &folder,
                                    const std::string &command,
                                    const double wall_start)
    : model(model)
    , monitors(monitors)
    , output(output)
    , finite_check(finite_check)
    , record(record)
    , folder(folder)
    , command(command)
    , last_saved(wall_start)
  {}



  template <int dim>
  void
  Checkpointing<dim>::save_if_due()
  {
    // rank 0's clock counts for all
    const double interval = model.scene.output.checkpoint_interval;
    const bool is_due     = model.communicator.is_root() && interval > 0. &&
                        MPI_Wtime() - last_saved > interval;
    std::vector<int> wishes = {signal_received(), is_due};
    model.communicator.max_lists(wishes);
    if (wishes[0] > 0)
      throw StopRequest{wishes[0]};
    if (wishes[1] > 0)
      save();
  }



  template <int dim>
  void
  Checkpointing<dim>::save()
  {
    if (folder.empty())
      return;
    finite_check.check_state();
    const std::string name    = folder + "checkpoint.h5";
    const std::string failure = write(name);
    last_saved                = MPI_Wtime();
    if (model.out.is_active())
      clear_progress(model.out.get_stream());
    if (!failure.empty())
      {
        model.warnings.add("The checkpoint '" + name + "' cannot be written (" +
                           failure + ")." + say_where_to_continue());
        return;
      }
    note_checkpoint(name);
    model.out << "Saved   " << last_checkpoint << std::endl;
  }



  template <int dim>
  void
  Checkpointing<dim>::keep_stage()
  {
    const std::string name =
      folder + name_of_kept_stage(record.present.index + 1);
    const std::string failure = write(name);
    if (!failure.empty())
      model.warnings.add("The state '" + name + "' cannot be kept (" + failure +
                         ").");
  }



  template <int dim>
  std::string
  Checkpointing<dim>::write(const std::string &name)
  {
    StateFile file(model.communicator);
    std::string entries        = model.scene.used_entries(),
                mesh_signature = signature(model.split);
    file.exchange("origin/entries", entries);
    file.exchange("origin/mesh", mesh_signature);
    put_state(file);
    return file.write(name);
  }



  template <int dim>
  void
  Checkpointing<dim>::put_state(StateFile &file)
  {
    exchange_progress(file);
    exchange_results(file);
    StateExchange<dim> state(file, model.split, *model.numbering);
    Snapshot<dim> now = take_snapshot(model.parts());
    state.save("state/", now);
    if (record.has_before)
      state.save("before/", record.before);
  }



  template <int dim>
  void
  Checkpointing<dim>::note_checkpoint(const std::string &name)
  {
    std::ostringstream text;
    text << name << " (stage " << model.scene.stages[record.present.index]->name
         << ", step " << model.step->n_steps << ", t = " << std::setprecision(6)
         << model.step->time << " s)";
    last_checkpoint = text.str();
    restart_command = command + " --restart " + name;
  }



  template <int dim>
  std::string
  Checkpointing<dim>::name_last_checkpoint() const
  {
    return last_checkpoint.empty()
             ? ""
             : " The last complete checkpoint is " + last_checkpoint +
                 "; continue by: " + restart_command;
  }



  template <int dim>
  std::string
  Checkpointing<dim>::say_where_to_continue() const
  {
    return last_checkpoint.empty() ? " There is no checkpoint of this run."
                                   : name_last_checkpoint();
  }



  template <int dim>
  void
  Checkpointing<dim>::save_and_stop(const StopRequest &request)
  {
    save();
    if (!folder.empty())
      monitors.write_csv(folder + "history.csv");
    model.out << "Stopped by a signal (" << strsignal(request.signal) << ")."
              << say_where_to_continue() << std::endl;
  }



  template <int dim>
  void
  Checkpointing<dim>::exchange_progress(StateFile &file)
  {
    file.exchange("run/stage", record.present.index);
    file.exchange("run/first_step", record.present.first_step);
    file.exchange("run/n_planned", record.present.n_planned);
    file.exchange("run/n_done", record.present.n_done);
    file.exchange("run/n_vtu", record.present.n_vtu);
    std::vector<double> overlap = {0., 0., 0., record.present.overlap.depth};
    std::copy_n(record.present.overlap.place.begin(), dim, overlap.begin());
    file.exchange("run/overlap", overlap);
    record.present.overlap.depth = overlap.back();
    std::copy_n(overlap.begin(), dim, record.present.overlap.place.begin());
    file.exchange("run/turns", record.present.turns);
    file.exchange("run/has_removed", record.present.has_removed);
    file.exchange("run/is_reported", record.present.is_reported);
    file.exchange("run/wants_factors", record.present.wants_factors);
    file.exchange("run/has_before", record.has_before);
    file.exchange("run/slip_begin", record.present.slips.begin);
    file.exchange("run/slip_steps", record.present.slips.steps);
    file.exchange("run/slips", record.present.slips.slips);
    file.exchange("run/support", record.present.support.numbers);
    file.exchange("run/is_converged", record.present.is_converged);
    file.exchange("run/removal_stage", record.present.removal_stage);
    StateExchange<dim> state(file, model.split, *model.numbering);
    state.exchange_nodes("run/stage_start_displacement",
                         record.present.start_displacement,
                         dim,
                         model.numbering->n_local());
    state.exchange_nodes("run/monitor_baseline",
                         monitors.baseline,
                         dim,
                         model.numbering->n_local());
  }



  template <int dim>
  void
  Checkpointing<dim>::exchange_results(StateFile &file)
  {
    exchange(file, "stages/", record.stage_reports);
    exchange(file, "factors/", record.safety_factors);
    exchange(file, "history/", monitors.history);
    std::vector<std::string> warnings = model.warnings.all();
    file.exchange("run/warnings", warnings);
    model.warnings.recall(warnings);
    std::vector<double> times;
    std::vector<std::string> names, stages;
    for (const VtuRecord &r : output.records)
      {
        times.push_back(r.time);
        names.push_back(r.file);
        stages.push_back(r.stage);
      }
    file.exchange("output/times", times);
    file.exchange("output/names", names);
    file.exchange("output/stages", stages);
    output.records.clear();
    for (unsigned int i = 0; i < names.size(); ++i)
      output.records.push_back({times.at(i),
                                names[i],
                                i % 2 == 0 ? "rock" : "interface",
                                stages.at(i)});
    output.stage = record.present.number();

    double wall_time = MPI_Wtime() - record.wall_start;
    file.exchange("run/wall_time", wall_time);
    record.wall_start = MPI_Wtime() - wall_time;
    file.exchange("run/loop_time", record.report.loop_time);
    file.exchange("run/element_steps", record.report.element_steps);
    file.exchange("run/contact_time", model.step->contact_seconds);
    file.exchange("run/force_time", model.step->force_seconds);
    file.exchange_shares("run/skipped_steps", {&model.step->n_skipped});
    if (!model.contact)
      return;
    double n_capped = model.contact->tally.n_capped;
    file.exchange_shares("run/contact_work",
                         {&model.contact->tally.work.friction,
                          &model.contact->tally.work.closure,
                          &model.contact->tally.work.penetration,
                          &model.contact->tally.work.dilation,
                          &model.contact->tally.work.elastic,
                          &n_capped});
    model.contact->tally.n_capped = n_capped;
  }



  template <int dim>
  void
  Checkpointing<dim>::restore(StateFile &file)
  {
    exchange_progress(file);
    exchange_results(file);
    StateExchange<dim> state(file, model.split, *model.numbering);
    if (record.has_before)
      {
        state.restore("before/", model.parts());
        record.before = take_snapshot(model.parts());
      }
    state.restore("state/", model.parts());
    model.step->resume(*model.scene.stages[record.present.index],
                       record.present.index + 2);
    model.count_cells();
    last_saved = MPI_Wtime();
  }



  template <int dim>
  void
  Checkpointing<dim>::resume(StateFile &file, const std::string &name)
  {
    restore(file);
    note_checkpoint(name);
    model.out << "Resumed " << last_checkpoint << std::endl;
  }



  std::string
  name_of_kept_stage(const unsigned int number)
  {
    return "stage_" + std::to_string(number) + ".h5";
  }



  template <int dim>
  void
  check_origin(StateFile &file,
               const std::string &name,
               const Scene<dim> &scene,
               const StateUse use)
  {
    std::string entries;
    file.exchange("origin/entries", entries);
    unsigned int index = 0;
    file.exchange("run/stage", index);
    std::vector<std::string> changeable = {"Title",
                                           "Output/",
                                           "Check/",
                                           "Safety factor/Rank groups"};
    for (unsigned int s = index + 1; s < scene.stages.size(); ++s)
      changeable.push_back("Stages/" + scene.stages[s]->name + "/");
    std::vector<std::string> fixed;
    if (use == StateUse::factors)
      {
        changeable.insert(changeable.end(),
                          {"Safety factor/", "Block theory/", "Study/"});
        // by it stages take blocks away
        fixed.emplace_back("Safety factor/Removal slip");
      }
    const auto [entry, there, here] =
      find_difference(entries, scene.used_entries(), changeable, fixed);
    std::string remedy = "use the scene it was made with";
    if (use == StateUse::factors)
      remedy += "; --factors lets the other entries of 'Safety factor' be "
                "changed, and those of 'Output'.";
    else if (entry.compare(0, 14, "Safety factor/") == 0)
      remedy += ", find factors alone by --factors instead of --restart, or "
                "leave --restart out to start anew.";
    else
      remedy += ", or leave --restart out to start anew.";
    AssertThrow(entry.empty(),
                InputError("The checkpoint '" + name +
                           "' is of another scene: the entry '" + entry +
                           "' is " + there + " there and " + here + " here; " +
                           remedy));
  }



  template <int dim>
  void
  check_mesh(StateFile &file,
             const std::string &name,
             const SplitMesh<dim> &split)
  {
    std::string mesh_signature;
    file.exchange("origin/mesh", mesh_signature);
    AssertThrow(mesh_signature == signature(split),
                InputError(
                  "The checkpoint '" + name +
                  "' is of another mesh, though the scene is the same; use the "
                  "mesh file or the version of Gmsh that it was made with, or "
                  "leave --restart out to start anew."));
  }

  template class Checkpointing<2>;
  template class Checkpointing<3>;
  template void check_origin(StateFile &,
                             const std::string &,
                             const Scene<2> &,
                             const StateUse);
  template void check_origin(StateFile &,
                             const std::string &,
                             const Scene<3> &,
                             const StateUse);
  template void
  check_mesh(StateFile &, const std::string &, const SplitMesh<2> &);
  template void
  check_mesh(StateFile &, const std::string &, const SplitMesh<3> &);
} // namespace Keyblock
