// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/run/simulation.h>

#include <keyblock/base/mpi.h>
#include <keyblock/base/teams.h>
#include <keyblock/blocks/block_resolution.h>
#include <keyblock/safety/block_statics.h>
#include <keyblock/safety/block_theory.h>
#include <keyblock/scene/network_output.h>
#include <keyblock/scene/step_count.h>
#include <keyblock/step/initial_tension.h>
#include <keyblock/step/step_spread.h>

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <set>
#include <tuple>

namespace Keyblock
{
  namespace
  {
    /** Least over median step of the cells that is not warned of [-]. */
    constexpr double least_step_ratio = 0.05;
  } // namespace



  template <int dim>
  Simulation<dim>::Simulation(const std::string &scene_file,
                              const std::vector<std::string> &overrides,
                              const std::string &output_folder,
                              const std::string &checkpoint)
    : scene_file(scene_file)
    , overrides(overrides)
    , checkpoint(checkpoint)
    , wall_start(MPI_Wtime())
    , last_saved(wall_start)
  {
    scene.read(scene_file, overrides);
    folder  = !output_folder.empty() ? output_folder
              : !scene.output.folder.empty()
                ? scene.output.folder
                : "output-" + std::filesystem::path(scene_file).stem().string();
    command = "keyblock " + scene_file + " --output " + folder;
    for (const std::string &assignment : overrides)
      command += " --set \"" + assignment + '"';
    folder += "/";
  }



  template <int dim>
  void
  Simulation<dim>::make_geometry()
  {
    std::tie(mesh, blocks) = make_mesh_for_blocks(scene);
    quality                = measure_quality(mesh);
    mesh_report            = mesh.report;
    split                  = split_mesh(mesh, blocks, scene);
    mesh                   = Mesh<dim>();
  }



  template <int dim>
  void
  Simulation<dim>::set_up()
  {
    numbering  = std::make_unique<Numbering<dim>>(scene, split);
    conditions = std::make_unique<Conditions<dim>>(
      scene, split, *numbering, cells, fields);
    if (scene.contact.method != "none")
      contact = std::make_unique<Contact<dim>>(
        scene, split, blocks, *numbering, cells, fields);
    step     = std::make_unique<ExplicitStep<dim>>(scene,
                                               split,
                                               blocks,
                                               *numbering,
                                               *conditions,
                                               cells,
                                               fields,
                                               contact.get());
    monitors = std::make_unique<Monitors<dim>>(
      scene, split, blocks, *numbering, cells, fields, contact.get());
    output = std::make_unique<Output<dim>>(
      scene, split, blocks, *numbering, cells, fields, contact.get(), folder);
    if (!scene.initial_state.measured_points.empty())
      geostress =
        invert_measured_stress(scene, split, *numbering, cells, fields);
    AssertThrow(scene.checks.closed_form != "value" ||
                  monitors->history.has(scene.checks.quantity),
                InputError("The entry 'Check/Quantity' is '" +
                           scene.checks.quantity +
                           "', which is no column of history.csv; name a "
                           "monitor and its quantity, for example tip.u_x."));
    remarks = monitors->warnings;
    if (const std::string tension = warning_of_tension(scene, split, cells);
        !tension.empty())
      remarks.push_back(tension);
    list_welded_joints();
    count_cells();
    check_durations();
    std::ostringstream place;
    for (unsigned int d = 0; d < dim; ++d)
      place << (d ? ", " : "") << conditions->stable_step.place[d];
    report.stable_step_place = place.str();
    const StepSpread<dim> spread =
      measure_step_spread(conditions->active_cells.frequency,
                          cells.mesh_cell,
                          split.mesh);
    report.step_ratio         = spread.ratio();
    report.stable_step_joints = names_of_joints_at(split.mesh, spread.cell);
  }



  template <int dim>
  void
  Simulation<dim>::list_welded_joints()
  {
    if (scene.joints.empty() || scene.contact.method == "none" ||
        !split.interface.pairs.empty())
      return;
    std::set<unsigned int> joints;
    for (const auto &of_cell : split.mesh.joint)
      for (const unsigned int j : of_cell)
        if (j != none)
          joints.insert(j);
    std::string names;
    unsigned int n = 0;
    for (const unsigned int j : joints)
      if (n++ < 8)
        names += (names.empty() ? "" : ", ") + scene.joints[j]->name;
    if (n == 0)
      return;
    remarks.push_back(
      "All joints stay welded, with 0 pairs, because the blocks beside them "
      "are infinite or not closed: " +
      names + (n > 8 ? ", ..." : "") +
      "; let joints and outer boundaries enclose blocks, name fewer of them in "
      "'Domain/Truncated boundaries', or set 'Contact/Weld infinite blocks' to "
      "false.");
  }



  template <int dim>
  void
  Simulation<dim>::count_cells()
  {
    n_cells_global = sum_over_ranks<unsigned long long>(cells.nodes.size());
  }



  template <int dim>
  void
  Simulation<dim>::print_set_up(std::ostream &out)
  {
    out << "Mesh    " << split.mesh.n_cells() << " cells (" << n_cells_global
        << " deformable), " << numbering->n_global() << " nodes, "
        << split.interface.pairs.size() << " pairs; least scaled Jacobian "
        << std::setprecision(3) << quality.minimum_scaled_jacobian << "\n";
    if (n_cells_global > 0)
      print_stable_step(out);
    print_mesh_report(out, mesh_report, scene);
    for (const std::string &remark : remarks)
      out << "Warning: " << remark << '\n';
    print_mass_scaling(out);
    print_block_table(out, blocks, scene);
    if (scene.block_theory.report)
      print_block_theory(out, find_block_theory(scene, scene.block_theory));
    out << std::flush;
  }



  /** Names of the joints that touch the vertices of a cell, or empty. */
  template <int dim>
  std::string
  Simulation<dim>::names_of_joints_at(const Mesh<dim> &mesh,
                                      const unsigned int cell) const
  {
    std::set<unsigned int> joints;
    const auto touches = [&](const unsigned int vertex) {
      const auto &corners = mesh.cells[cell];
      return std::any_of(corners.begin(), corners.end(), [&](const auto v) {
        return mesh.vertices[v] == mesh.vertices[vertex];
      });
    };
    if (cell != none)
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        for (unsigned int f = 0; f < Mesh<dim>::n_cell_faces; ++f)
          if (mesh.joint[c][f] != none && joints.count(mesh.joint[c][f]) == 0)
            {
              const auto vertices = mesh.face_vertices(c, f);
              if (std::any_of(vertices.begin(), vertices.end(), touches))
                joints.insert(mesh.joint[c][f]);
            }
    std::string names;
    for (const unsigned int j : joints)
      names += (names.empty() ? "" : ", ") + scene.joints[j]->name;
    return names;
  }



  template <int dim>
  void
  Simulation<dim>::print_stable_step(std::ostream &out) const
  {
    const TimeStepping &stepping = scene.time_stepping;
    out << "        stable time step " << conditions->stable_step.limit(Stage())
        << " s, set by the cell at (" << report.stable_step_place << ")"
        << (report.stable_step_joints.empty()
              ? ""
              : " beside " + report.stable_step_joints)
        << "\n        least over median step of "
        << "the cells " << report.step_ratio << '\n';
    if (report.step_ratio < least_step_ratio)
      out << "Warning: The least stable step of a cell is " << report.step_ratio
          << " times the median one, and sets the time step; improve the mesh "
             "there"
          << (stepping.least_step == 0. ? ", or set 'Time stepping/Least step'"
                                        : "")
          << ".\n";
  }



  template <int dim>
  void
  Simulation<dim>::print_mass_scaling(std::ostream &out)
  {
    const std::string text =
      describe_mass_scaling(conditions->active_cells.mass_scaling,
                            blocks,
                            scene.time_stepping.least_step);
    if (text != mass_scaling_text)
      out << text << std::flush;
    mass_scaling_text = text;
  }



  template <int dim>
  void
  Simulation<dim>::validate()
  {
    make_geometry();
    set_up();
    if (is_root())
      {
        for (const std::string &warning : scene.warnings())
          std::cout << "Warning: " << warning << '\n';
        print_set_up(std::cout);
        print_block_statics(std::cout, scene, split, blocks);
        std::cout << "The scene is valid.\n";
      }
  }



  template <int dim>
  void
  Simulation<dim>::run()
  {
    watch_signals();
    form_teams(scene.safety.teams);
    std::unique_ptr<StateFile> file;
    if (!checkpoint.empty())
      {
        file = std::make_unique<StateFile>(checkpoint);
        check_origin(*file);
      }
    make_geometry();
    if (file)
      check_mesh(*file);
    set_up();
    open_output();
    try
      {
        if (file)
          {
            restore(*file);
            note_checkpoint(checkpoint);
            if (is_root())
              std::cout << "Resumed " << last_checkpoint << std::endl;
          }
        file.reset();
        run_stages();
        finish();
      }
    catch (const StopRequest &request)
      {
        save_and_stop(request);
        throw;
      }
    catch (const ComputationError &error)
      {
        AssertThrow(false,
                    ComputationError(
                      error.message +
                      (last_checkpoint.empty() ? "" : name_last_checkpoint())));
      }
  }



  template <int dim>
  void
  Simulation<dim>::open_output()
  {
    on_root([&]() {
      std::error_code error;
      std::filesystem::create_directories(folder, error);
      AssertThrow(!error,
                  InputError("The output folder '" + folder +
                             "' cannot be made (" + error.message() +
                             "); choose another by --output."));
      scene.write_used(folder + "used.prm");
      if (!scene.joints.empty())
        {
          write_joint_table(folder + "joints.csv", scene);
          write_joint_planes(folder + "joints.vtu", scene, split.mesh.vertices);
        }
      for (const std::string &warning : scene.warnings())
        std::cout << "Warning: " << warning << '\n';
      print_set_up(std::cout);
      if (geostress)
        {
          write_geostress(folder + "geostress.csv", *geostress);
          print_geostress(std::cout, *geostress);
        }
    });
  }



  template <int dim>
  void
  Simulation<dim>::run_stages()
  {
    unsigned int next = 0;
    if (checkpoint.empty())
      {
        establish_initial_state();
        step->sample_start();
        check_state();
        monitors->sample_start(*step);
        if (scene.output.write_vtu)
          output->write_vtu(step->time);
      }
    else
      {
        complete_stage();
        next = present.index + 1;
      }
    for (; next < scene.stages.size(); ++next)
      {
        begin_stage(next);
        complete_stage();
      }
  }



  template <int dim>
  void
  Simulation<dim>::check_durations() const
  {
    for (const auto &stage : scene.stages)
      if (stage->duration > 0. && n_cells_global > 0)
        count_steps(*stage, step->longest_step(*stage));
  }



  template <int dim>
  void
  Simulation<dim>::report_progress(const unsigned int stage,
                                   const double fraction)
  {
    const double time     = MPI_Wtime();
    const bool is_live    = isatty(STDOUT_FILENO);
    const double interval = is_live ? 0.5 : 30.;
    if (last_progress == 0.)
      last_progress = time;
    // all ranks must agree on taking part in the sums
    bool is_due = step->n_steps % 50 == 0 && time - last_progress > interval;
    if (step->n_steps % 50 != 0)
      return;
    is_due = on_any_rank(is_due);
    if (!is_due)
      return;
    last_progress = time;
    JointSums<dim> points;
    if (contact)
      points = contact->report().count_points();
    if (!is_root())
      return;
    const double elapsed = time - wall_start;
    std::cout << (is_live ? "\r" : "") << scene.stages[stage]->name << "  step "
              << step->n_steps << "  t = " << std::setprecision(4) << step->time
              << " s  " << 1e-6 * n_cells_global * step->n_steps / elapsed
              << " M element-steps/s  kinetic " << step->energies.kinetic
              << " J  open/sliding/bonded " << points.n_open << "/"
              << points.n_sliding << "/" << points.n_sticking << "  left "
              << std::lround(elapsed / fraction * (1. - fraction)) << " s"
              << (is_live ? "   " : "\n") << std::flush;
  }



  template <int dim>
  void
  Simulation<dim>::finish()
  {
    CheckValues checks;
    RockState<dim> rock;
    if (scene.checks.needs_rock())
      rock = gather_rock(scene, split, *numbering, cells, fields);
    on_root([&]() {
      if (!scene.stages.empty())
        checks = evaluate_checks<dim>({scene,
                                       blocks,
                                       monitors->history,
                                       monitors->block_of_monitor,
                                       stage_reports,
                                       rock});
    });
    report.steps          = step->n_steps;
    report.time_step      = step->dt;
    report.simulated_time = step->time;
    report.wall_time      = MPI_Wtime() - wall_start;
    report.contact_time   = step->contact_seconds;
    report.force_time     = step->force_seconds;
    report.mass_scaling   = conditions->active_cells.mass_scaling;
    report.skipped_steps  = sum_over_ranks(step->n_skipped);
    report.capped_groups =
      sum_over_ranks(contact ? contact->tally.n_capped : 0);
    report.solved_groups =
      sum_over_ranks(contact ? contact->tally.n_solved : 0.);
    monitors->write_csv(folder + "history.csv");
    output->write_summary(quality,
                          mesh_report,
                          report,
                          stage_reports,
                          monitors->history,
                          checks,
                          safety_factors,
                          removal_stage,
                          geostress.get());
    check_history();
    if (!is_root())
      return;
    if (report.capped_groups > 0)
      std::cout << "Warning: " << report.capped_groups << " contact groups of "
                << report.solved_groups
                << " in this run were left at 'Contact/Maximum iterations', "
                   "not solved to "
                   "'Contact/Tolerance'.\n";
    for (const auto &[name, value] : checks)
      std::cout << "Check   " << name << " = " << std::setprecision(9) << value
                << '\n';
    std::cout << "Output  " << folder << "  (" << std::setprecision(3)
              << report.wall_time << " s)" << std::endl;
  }

  template <int dim>
  std::vector<double>
  Simulation<dim>::gather_by_vertex(const std::vector<double> &field) const
  {
    std::vector<double> values(dim * split.mesh.vertices.size(), 0.);
    for (unsigned int node = 0; node < numbering->n_owned(); ++node)
      for (unsigned int d = 0; d < dim; ++d)
        values[dim * numbering->vertex_of_node[node] + d] =
          field[dim * node + d];
    sum_lists(values);
    return values;
  }



  template <int dim>
  std::vector<double>
  Simulation<dim>::vertex_displacements() const
  {
    return gather_by_vertex(fields.displacement);
  }



  template <int dim>
  std::vector<double>
  Simulation<dim>::vertex_velocities() const
  {
    return gather_by_vertex(fields.velocity);
  }

  template class Simulation<2>;
  template class Simulation<3>;
} // namespace Keyblock
