// SPDX-License-Identifier: LGPL-2.1-or-later
// The initial state, and what happens in one stage.
#include <keyblock/base/mpi.h>
#include <keyblock/base/teams.h>
#include <keyblock/geostress/geostress.h>
#include <keyblock/run/simulation.h>
#include <keyblock/scene/step_count.h>
#include <keyblock/step/equilibrium.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>

namespace Keyblock
{
  namespace
  {
    /** Steps between looks for numbers that are not finite. */
    constexpr unsigned int finite_check_interval = 50;

    /** Steps between measurements while forces are brought into balance. */
    constexpr unsigned int quasi_static_interval = 25;

    /** Steps between adjustments of the pace of a ramp. */
    constexpr unsigned int pace_interval = 10;

    /** Steps between looks for blocks that have failed. */
    constexpr unsigned int removal_interval = 100;

    /** Steps between looks whether the run is to be saved or stopped. */
    constexpr unsigned int save_interval = 10;

    /** Unbalanced ratio of a static stage that is in balance; rock that yields
     * is not, after elastic solves. */
    constexpr double static_tolerance = 1e-8;

    /** Static solves that refine each other, at most. */
    constexpr unsigned int maximum_refinements = 4;

    /** Slip over the size of a block since about half of the stage with which
     * it is on its way, however slow [-]. */
    constexpr double least_creep = 1e-5;

    /** Overlaps from this share of the largest displacement on are told [-]. */
    constexpr double notable_overlap = 0.02;

    std::string
    short_number(const double value)
    {
      std::ostringstream text;
      text << std::setprecision(2) << value;
      return text.str();
    }
  } // namespace



  template <int dim>
  void
  Simulation<dim>::establish_initial_state()
  {
    bool changes_later = false;
    for (unsigned int s = 0; s < scene.stages.size(); ++s)
      changes_later = changes_later || conditions->changes(s + 2);
    const bool is_static = scene.initial_state.equilibrium == "static";
    if (!is_static && !changes_later && !conditions->has_far_field())
      return;
    step->begin_stage(Stage(), 1);
    step->update_forces();
    if (is_static)
      {
        const double start = MPI_Wtime();
        solve_stage();
        step->zero_displacements();
        if (is_root())
          std::cout << "Static  initial equilibrium in " << std::setprecision(3)
                    << MPI_Wtime() - start << " s, unbalanced ratio "
                    << step->unbalanced_ratio << std::endl;
      }
    conditions->release_far_field();
    step->choose_step(1);
    if (contact == nullptr)
      return;
    // the second time all stick, and the forces of points that meet are the
    // nearest to the rock's stress
    contact->tie(true);
    step->settle_contact();
    step->settle_contact();
    contact->tie(false);
    std::vector<bool> is_exposed;
    for (const Block<dim> &block : blocks.blocks)
      is_exposed.push_back(block.class_of_stage[std::min<std::size_t>(
                             1, block.class_of_stage.size() - 1)] ==
                           BlockClass::exposed);
    const unsigned int n_held = contact->hold_bent_points(is_exposed);
    if (is_root() && n_held > 0)
      std::cout << "Joints  " << n_held
                << " points whose faces the mesh has bent are held until rock "
                   "is excavated or shaken"
                << std::endl;
    step->settle_contact();
    const JointSums<dim> points = contact->report().count_pairs();
    if (is_root() && points.n_open + points.n_sliding > 0)
      std::cout << "Joints  " << points.n_open + points.n_sliding
                << " points cannot bear the initial stress: " << points.n_open
                << " open, " << points.n_sliding << " slide" << std::endl;
  }



  template <int dim>
  void
  Simulation<dim>::begin_stage(const unsigned int index)
  {
    const Stage &stage        = *scene.stages[index];
    const unsigned int number = index + 2;
    if (stage.reset_motion)
      monitors->reset_baseline();
    stage_start_displacement = fields.displacement;
    is_converged             = true;
    removal_stage.resize(blocks.blocks.size(), 0);
    present       = StageProgress<dim>();
    present.index = index;
    present.wants_factors =
      contact != nullptr && scene.safety.wants_stage(stage.name);
    if (present.wants_factors)
      present.before = take_snapshot(parts());
    dig_stage(stage, number);
    if (is_root())
      print_mass_scaling(std::cout);
    present.first_step = step->n_steps;
  }



  template <int dim>
  void
  Simulation<dim>::complete_stage()
  {
    const Stage &stage = *scene.stages[present.index];
    if (!present.is_reported)
      {
        if (stage.is_static())
          {
            solve_stage();
            is_converged = step->unbalanced_ratio < static_tolerance;
            step->settle_contact();
            monitors->sample(*step, present.index);
            if (scene.output.write_vtu && scene.output.vtu_count > 0)
              output->write_vtu(step->time);
          }
        else
          step_through(stage, present);
        report.element_steps +=
          double(step->n_steps - present.first_step) * n_cells_global;
        check_state();
        report_stage(stage, present.n_done);
        present.is_reported = true;
        save_if_due();
      }
    if (present.wants_factors && n_teams() > 1)
      find_factors_in_teams();
    else if (present.wants_factors)
      find_remaining_factors();
  }



  template <int dim>
  void
  Simulation<dim>::dig_stage(const Stage &stage, const unsigned int number)
  {
    std::vector<double> carried;
    const bool changes = conditions->changes(number);
    step->forget_dug_cells();
    if (changes)
      {
        carried = step->dig(number);
        count_cells();
      }
    step->begin_stage(stage, number);
    if (contact && (changes || !(stage.is_quasi_static() || stage.is_static())))
      contact->release_bent_points();
    bool is_ramped = changes;
    for (const auto &support : scene.supports)
      is_ramped = is_ramped || (!support->displacement.empty() && number == 2);
    if (!is_ramped || stage.is_static())
      {
        conditions->loads.start_ramp({}, 0.);
        return;
      }
    conditions->loads.start_ramp(carried, ramp_duration_of(stage));
  }



  template <int dim>
  double
  Simulation<dim>::ramp_duration_of(const Stage &stage) const
  {
    if (stage.ramp_duration > 0. || !stage.is_quasi_static())
      return stage.ramp_duration;
    StaticSolver<dim> solver(
      split, *numbering, cells, fields, fields.supports, conditions->elements);
    return 4. * solver.lowest_period();
  }



  template <int dim>
  void
  Simulation<dim>::solve_stage()
  {
    StaticSolver<dim> solver(
      split, *numbering, cells, fields, fields.supports, conditions->elements);
    double share = 1.;
    for (unsigned int i = 0; i < maximum_refinements; ++i)
      {
        step->update_forces();
        std::vector<double> force(fields.load.size(), 0.);
        for (unsigned int k = 0; k < dim * numbering->n_owned(); ++k)
          force[k] = fields.load[k] - fields.internal_force[k];
        const double ratio     = solver.residual_ratio(force);
        step->unbalanced_ratio = ratio;
        if (ratio < 1e-14 && share == 0.)
          break;
        step->add_displacement(
          solver.solve(force, [&](const NodeSupport<dim> &support) {
            return share *
                   conditions->supports.prescribed_displacement(support);
          }));
        share = 0.;
      }
    step->update_forces();
    std::vector<double> force(fields.load.size(), 0.);
    for (unsigned int k = 0; k < dim * numbering->n_owned(); ++k)
      force[k] = fields.load[k] - fields.internal_force[k];
    step->unbalanced_ratio = solver.residual_ratio(force);
  }



  template <int dim>
  void
  Simulation<dim>::step_through(const Stage &stage,
                                StageProgress<dim> &progress)
  {
    const unsigned int index = progress.index;
    double loop_start        = MPI_Wtime();
    if (progress.n_done == 0)
      progress.n_planned = plan_steps(stage, step->dt);
    const std::uint64_t n_steps = progress.n_planned;
    const unsigned int interval =
      stage.is_quasi_static()
        ? std::max(scene.output.history_interval, quasi_static_interval)
        : scene.output.history_interval;
    const auto book_time = [&]() {
      const double now = MPI_Wtime();
      report.loop_time += now - loop_start;
      loop_start = now;
    };
    const auto write_vtu = [&]() {
      book_time();
      output->write_vtu(step->time);
      ++progress.n_vtu;
      look_for_overlap(progress);
      loop_start = MPI_Wtime();
    };
    const bool writes =
      scene.output.write_vtu && scene.output.vtu_count > 0 && !is_trial;
    is_converged = stage.unbalanced_ratio == 0. || stage.duration > 0.;
    while (progress.n_done < n_steps)
      {
        const std::uint64_t i = ++progress.n_done;
        const bool is_last    = i == n_steps;
        const bool is_sample =
          i % interval == 0 || is_last || i == 1 || progress.has_removed;
        step->advance(is_sample);
        if (is_sample)
          check_sample();
        if (is_sample && !is_trial)
          monitors->sample(*step, index);
        // the ledger starts anew when a block is taken away
        progress.has_removed = stage.is_quasi_static() &&
                               i % removal_interval == 0 &&
                               remove_failed_blocks(stage, progress);
        if (stage.is_quasi_static() && i % pace_interval == 0 &&
            conditions->loads.is_ramping())
          pace_ramp(stage);
        if (i % finite_check_interval == 0 || is_last)
          check_finite();
        if (writes && !stage.is_quasi_static() &&
            i >= double(progress.n_vtu + 1) * n_steps / scene.output.vtu_count)
          write_vtu();
        if (!is_trial)
          report_progress(index, double(i) / n_steps);
        if (is_sample && i > 10 && stage.unbalanced_ratio > 0. &&
            !conditions->loads.is_ramping() &&
            step->unbalanced_ratio < stage.unbalanced_ratio)
          {
            is_converged = true;
            break;
          }
        if (i % save_interval == 0)
          {
            book_time();
            save_if_due();
          }
      }
    if (writes && stage.is_quasi_static())
      write_vtu();
    book_time();
  }



  template <int dim>
  void
  Simulation<dim>::pace_ramp(const Stage &stage)
  {
    // plastic rock answers more slowly than its lowest elastic mode; a ramp
    // that outruns it overshoots for good
    step->sample_unbalanced_force();
    conditions->loads.set_ramp_pace(
      std::min(1., stage.ramp_unbalance / step->unbalanced_ratio));
  }



  template <int dim>
  std::string
  Simulation<dim>::name_what_moves(const StageProgress<dim> &progress) const
  {
    // mean displacement and velocity of each block in this stage
    const unsigned int n_blocks = blocks.blocks.size();
    std::vector<double> sums(n_blocks * (1 + 2 * dim), 0.);
    for (unsigned int c = 0; c < cells.nodes.size(); ++c)
      {
        const unsigned int b = split.block_of_cell[cells.mesh_cell[c]];
        if (b == none)
          continue;
        double *const sum = sums.data() + b * (1 + 2 * dim);
        for (const unsigned int node : cells.nodes[c])
          {
            sum[0] += 1.;
            for (unsigned int d = 0; d < dim; ++d)
              {
                const unsigned int i = dim * node + d;
                sum[1 + d] +=
                  fields.displacement[i] - stage_start_displacement[i];
                sum[1 + dim + d] += fields.velocity[i];
              }
          }
      }
    sum_lists(sums);
    struct Mover
    {
      double way;
      unsigned int id;
      bool is_moving;
      double speed; ///< of a steady slip [m/s]; 0: not measured
    };
    std::vector<Mover> movers;
    for (unsigned int b = 0; b < n_blocks; ++b)
      {
        const double *const sum = sums.data() + b * (1 + 2 * dim);
        if (sum[0] == 0. || blocks.blocks[b].is_infinite)
          continue;
        double way = 0., along = 0.;
        for (unsigned int d = 0; d < dim; ++d)
          {
            way += sum[1 + d] * sum[1 + d];
            along += sum[1 + d] * sum[1 + dim + d];
          }
        way = std::sqrt(way) / sum[0];
        // a thousandth of its size and still going, or far, and come to rest
        const double size    = blocks.blocks[b].size;
        const bool is_moving = way > 1e-3 * size && along > 0. && !is_converged;
        // or slowly, but as fast as ever
        const auto motion =
          contact == nullptr
            ? SlipRecord::Motion{0., 0}
            : progress.slips.motion_since(
                b, progress.n_done, norm<dim>(contact->report().mean_slip(b)));
        const bool creeps = !is_converged && motion.way > least_creep * size;
        const double speed =
          creeps ? motion.way / (motion.n_steps * step->dt) : 0.;
        if (is_moving || creeps || way > 0.05 * size)
          movers.push_back(
            {way, blocks.blocks[b].id, is_moving || creeps, speed});
      }
    // those that went farthest
    std::stable_sort(movers.begin(),
                     movers.end(),
                     [](const Mover &a, const Mover &b) {
                       return a.way > b.way;
                     });
    constexpr unsigned int n_named = 8;
    std::ostringstream text;
    for (unsigned int i = 0; i < movers.size() && i < n_named; ++i)
      text << (i == 0 ? "" : "; ") << "block " << movers[i].id
           << (movers[i].is_moving ? " is moving off (" : " moved off (")
           << std::setprecision(3) << movers[i].way << " m"
           << (movers[i].speed > 0.
                 ? ", " + short_number(movers[i].speed) + " m/s)"
                 : ")");
    if (movers.size() > n_named)
      text << "; and " << movers.size() - n_named << " more";
    return text.str();
  }



  template <int dim>
  void
  Simulation<dim>::look_for_overlap(StageProgress<dim> &progress) const
  {
    if (!contact)
      return;
    const Overlap<dim> overlap = contact->report().largest_overlap();
    if (overlap.depth > progress.overlap.depth)
      progress.overlap = overlap;
  }



  template <int dim>
  void
  Simulation<dim>::report_stage(const Stage &stage, const std::uint64_t n_steps)
  {
    StageReport result;
    result.name                = stage.name;
    result.steps               = n_steps;
    result.time_step           = step->dt;
    result.unbalanced_ratio    = step->unbalanced_ratio;
    result.largest_nodal_ratio = step->largest_nodal_ratio;
    result.energies            = step->energies;
    result.is_converged        = is_converged;
    result.cells               = n_cells_global;
    result.plastic_cells = sum_over_ranks<unsigned int>(cells.strength.size());
    result.yielding_points = sum_over_ranks(cells.n_yielding);
    if (contact)
      {
        const JointSums<dim> points = contact->report().count_points();
        result.points               = {points.n_open,
                                       points.n_sliding,
                                       points.n_sticking,
                                       points.n_intact};
        result.through_rock         = contact->report().count_through_rock();
        look_for_overlap(present);
        result.largest_overlap = present.overlap.depth;
        std::copy_n(present.overlap.place.begin(),
                    dim,
                    result.overlap_place.begin());
      }
    result.remark = name_what_moves(present);
    for (unsigned int b = 0; b < removal_stage.size(); ++b)
      if (removal_stage[b] == scene.stage_number(stage.name))
        result.remark +=
          (result.remark.empty() ? "" : "; ") + std::string("block ") +
          std::to_string(blocks.blocks[b].id) + " failed and was taken away";
    if (result.remark.empty() && !is_converged)
      result.remark = "no block is moving off; more steps may do";
    double largest = 0.;
    for (unsigned int node = 0; node < numbering->n_owned(); ++node)
      {
        double square = 0.;
        for (unsigned int d = 0; d < dim; ++d)
          square += std::pow(fields.displacement[dim * node + d], 2);
        if (fields.mass[node] > 0.) // else its cells are gone
          largest = std::max(largest, square);
      }
    result.max_displacement = std::sqrt(max_over_ranks(largest));
    stage_reports.push_back(result);
    if (!is_root())
      return;
    std::cout << "Stage   " << stage.name << ": " << result.steps << " steps, "
              << std::setprecision(6) << step->time << " s, unbalanced ratio "
              << result.unbalanced_ratio << ", largest displacement "
              << result.max_displacement << " m, energy residual "
              << result.energies.relative_residual() << std::endl;
    if (!is_converged)
      std::cout << "        not in balance ("
                << (stage.is_static() ? static_tolerance
                                      : stage.unbalanced_ratio)
                << " wanted) after " << n_steps << " steps: " << result.remark
                << std::endl;
    else if (!result.remark.empty())
      std::cout << "        " << result.remark << std::endl;
    if (result.largest_overlap > notable_overlap * result.max_displacement)
      {
        std::cout << "        a node was up to " << std::setprecision(3)
                  << result.largest_overlap << " m inside another block, at (";
        for (unsigned int d = 0; d < dim; ++d)
          std::cout << (d ? ", " : "") << result.overlap_place[d];
        std::cout << ')' << std::endl;
      }
    if (result.through_rock > 0)
      std::cout << "Warning: " << result.through_rock
                << " contacts act through the rock of a block." << std::endl;
  }

  template void Simulation<2>::establish_initial_state();
  template void Simulation<3>::establish_initial_state();
  template void Simulation<2>::dig_stage(const Stage &, const unsigned int);
  template double Simulation<2>::ramp_duration_of(const Stage &) const;
  template void Simulation<2>::step_through(const Stage &, StageProgress<2> &);
  template void Simulation<3>::dig_stage(const Stage &, const unsigned int);
  template double Simulation<3>::ramp_duration_of(const Stage &) const;
  template void Simulation<3>::step_through(const Stage &, StageProgress<3> &);
  template void Simulation<2>::begin_stage(const unsigned int);
  template void Simulation<3>::begin_stage(const unsigned int);
  template void Simulation<2>::complete_stage();
  template void Simulation<3>::complete_stage();
} // namespace Keyblock
