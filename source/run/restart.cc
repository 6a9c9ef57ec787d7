// SPDX-License-Identifier: LGPL-2.1-or-later
// When a run is saved, what a checkpoint contains, and how it is taken up.
#include <keyblock/base/mpi.h>
#include <keyblock/run/simulation.h>

#include <cstring>
#include <iomanip>
#include <iostream>

namespace Keyblock
{
  template <int dim>
  void
  Simulation<dim>::save_if_due()
  {
    // rank 0's clock counts for all
    const double interval = scene.output.checkpoint_interval;
    const bool is_due     = is_root() && !is_trial && interval > 0. &&
                        MPI_Wtime() - last_saved > interval;
    std::vector<int> wishes = {signal_received(), is_due};
    max_lists(wishes);
    if (wishes[0] > 0)
      throw StopRequest{wishes[0]};
    if (wishes[1] > 0)
      save();
  }



  template <int dim>
  void
  Simulation<dim>::save()
  {
    check_state();
    StateFile file;
    std::string entries        = scene.used_entries(),
                mesh_signature = signature(split);
    file.exchange("origin/entries", entries);
    file.exchange("origin/mesh", mesh_signature);
    put_state(file);
    const std::string name    = folder + "checkpoint.h5";
    const std::string failure = file.write(name);
    last_saved                = MPI_Wtime();
    if (failure.empty())
      note_checkpoint(name);
    if (!is_root())
      return;
    if (failure.empty())
      std::cout << "Saved   " << last_checkpoint << std::endl;
    else
      std::cerr << "Warning: The checkpoint '" << name
                << "' cannot be written (" << failure << ")."
                << name_last_checkpoint() << std::endl;
  }



  template <int dim>
  void
  Simulation<dim>::put_state(StateFile &file)
  {
    exchange_progress(file);
    exchange_results(file);
    StateExchange<dim> state(file, split, *numbering);
    Snapshot<dim> now = take_snapshot(parts());
    state.save("state/", now);
    if (present.wants_factors)
      state.save("before/", present.before);
  }



  template <int dim>
  void
  Simulation<dim>::note_checkpoint(const std::string &name)
  {
    std::ostringstream text;
    text << name << " (stage " << scene.stages[present.index]->name << ", step "
         << step->n_steps << ", t = " << std::setprecision(6) << step->time
         << " s)";
    last_checkpoint = text.str();
    restart_command = command + " --restart " + name;
  }



  template <int dim>
  std::string
  Simulation<dim>::name_last_checkpoint() const
  {
    return last_checkpoint.empty()
             ? " There is no checkpoint of this run."
             : " The last complete checkpoint is " + last_checkpoint +
                 "; continue by: " + restart_command;
  }



  template <int dim>
  void
  Simulation<dim>::save_and_stop(const StopRequest &request)
  {
    save();
    monitors->write_csv(folder + "history.csv");
    if (is_root())
      std::cout << "Stopped by a signal (" << strsignal(request.signal) << ")."
                << name_last_checkpoint() << std::endl;
  }



  template <int dim>
  void
  Simulation<dim>::check_origin(StateFile &file) const
  {
    const std::string anew = ", or leave --restart out to start anew.";
    std::string entries;
    file.exchange("origin/entries", entries);
    unsigned int index = 0;
    file.exchange("run/stage", index);
    std::vector<std::string> changeable = {"Title",
                                           "Output/",
                                           "Check/",
                                           "Safety factor/Teams"};
    for (unsigned int s = index + 1; s < scene.stages.size(); ++s)
      changeable.push_back("Stages/" + scene.stages[s]->name + "/");
    const auto [entry, there, here] =
      find_difference(entries, scene.used_entries(), changeable);
    AssertThrow(entry.empty(),
                InputError("The checkpoint '" + checkpoint +
                           "' is of another scene: the entry '" + entry +
                           "' is " + there + " there and " + here +
                           " here; use the scene it was made with" + anew));
  }



  template <int dim>
  void
  Simulation<dim>::check_mesh(StateFile &file) const
  {
    std::string mesh_signature;
    file.exchange("origin/mesh", mesh_signature);
    AssertThrow(mesh_signature == signature(split),
                InputError(
                  "The checkpoint '" + checkpoint +
                  "' is of another mesh, though the scene is the same; use the "
                  "mesh file or the version of Gmsh that it was made with, or "
                  "leave --restart out to start anew."));
  }



  template <int dim>
  void
  Simulation<dim>::exchange_progress(StateFile &file)
  {
    file.exchange("run/stage", present.index);
    file.exchange("run/first_step", present.first_step);
    file.exchange("run/n_planned", present.n_planned);
    file.exchange("run/n_done", present.n_done);
    file.exchange("run/n_vtu", present.n_vtu);
    std::vector<double> overlap = {0., 0., 0., present.overlap.depth};
    std::copy_n(present.overlap.place.begin(), dim, overlap.begin());
    file.exchange("run/overlap", overlap);
    present.overlap.depth = overlap.back();
    std::copy_n(overlap.begin(), dim, present.overlap.place.begin());
    file.exchange("run/has_removed", present.has_removed);
    file.exchange("run/is_reported", present.is_reported);
    file.exchange("run/wants_factors", present.wants_factors);
    file.exchange("run/slip_begin", present.slips.begin);
    file.exchange("run/slip_steps", present.slips.steps);
    file.exchange("run/slips", present.slips.slips);
    file.exchange("run/is_converged", is_converged);
    file.exchange("run/removal_stage", removal_stage);
    StateExchange<dim> state(file, split, *numbering);
    state.exchange_nodes("run/stage_start_displacement",
                         stage_start_displacement,
                         dim,
                         numbering->n_local());
    state.exchange_nodes("run/monitor_baseline",
                         monitors->baseline,
                         dim,
                         numbering->n_local());
  }



  template <int dim>
  void
  Simulation<dim>::exchange_results(StateFile &file)
  {
    exchange(file, "stages/", stage_reports);
    exchange(file, "factors/", safety_factors);
    exchange(file, "history/", monitors->history);
    std::vector<double> times;
    std::vector<std::string> names;
    for (const auto &[time, name] : output->records)
      {
        times.push_back(time);
        names.push_back(name);
      }
    file.exchange("output/times", times);
    file.exchange("output/names", names);
    output->records.clear();
    for (unsigned int i = 0; i < names.size(); ++i)
      output->records.emplace_back(times.at(i), names[i]);

    double wall_time = MPI_Wtime() - wall_start;
    file.exchange("run/wall_time", wall_time);
    wall_start = MPI_Wtime() - wall_time;
    file.exchange("run/loop_time", report.loop_time);
    file.exchange("run/element_steps", report.element_steps);
    file.exchange("run/contact_time", step->contact_seconds);
    file.exchange("run/force_time", step->force_seconds);
    file.exchange_shares("run/skipped_steps", {&step->n_skipped});
    if (!contact)
      return;
    double n_capped = contact->tally.n_capped;
    file.exchange_shares("run/contact_work",
                         {&contact->tally.work.friction,
                          &contact->tally.work.closure,
                          &contact->tally.work.penetration,
                          &contact->tally.work.dilation,
                          &n_capped});
    contact->tally.n_capped = n_capped;
  }



  template <int dim>
  void
  Simulation<dim>::restore(StateFile &file)
  {
    exchange_progress(file);
    exchange_results(file);
    StateExchange<dim> state(file, split, *numbering);
    if (present.wants_factors)
      {
        state.restore("before/", parts());
        present.before = take_snapshot(parts());
      }
    state.restore("state/", parts());
    step->resume(*scene.stages[present.index], present.index + 2);
    count_cells();
    last_saved = MPI_Wtime();
  }

  template void Simulation<2>::save_if_due();
  template void Simulation<3>::save_if_due();
  template std::string Simulation<2>::name_last_checkpoint() const;
  template std::string Simulation<3>::name_last_checkpoint() const;
  template void Simulation<2>::save_and_stop(const StopRequest &);
  template void Simulation<3>::save_and_stop(const StopRequest &);
  template void Simulation<2>::check_origin(StateFile &) const;
  template void Simulation<3>::check_origin(StateFile &) const;
  template void Simulation<2>::check_mesh(StateFile &) const;
  template void Simulation<3>::check_mesh(StateFile &) const;
  template void Simulation<2>::put_state(StateFile &);
  template void Simulation<3>::put_state(StateFile &);
  template void Simulation<2>::note_checkpoint(const std::string &);
  template void Simulation<3>::note_checkpoint(const std::string &);
  template void Simulation<2>::restore(StateFile &);
  template void Simulation<3>::restore(StateFile &);
} // namespace Keyblock
