// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/number_text.h>
#include <keyblock/law/joint_stiffness.h>
#include <keyblock/mesh/place_digits.h>
#include <keyblock/output/liner_output.h>
#include <keyblock/run/block_turns.h>
#include <keyblock/run/bolt_warnings.h>
#include <keyblock/run/moving_blocks.h>
#include <keyblock/run/stage_reporter.h>
#include <keyblock/run/static_stage.h>
#include <keyblock/safety/block_stiffness.h>
#include <keyblock/step/guided_blocks.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace Keyblock
{
  namespace
  {
    /** Way over the size of a block since about half of the stage with which
     * it is on its way, however slow [-]. */
    constexpr double least_creep = 1e-5;

    /** Way over the size of a block from which on it moves off, if it goes on,
     * and from which on it is told wherever it ended [-]. */
    constexpr double notable_way = 1e-3, long_way = 0.05;

    /** Overlaps from this share of the largest displacement on are told [-]. */
    constexpr double notable_overlap = 0.02;

    /** Frequency with liners over that without them from which on it is told
     * [-]. */
    constexpr double notable_frequency_ratio = 1.01;



    /** By how much liners shorten the step, and what their springs along traces
     * of joints do alone, from highest frequencies with and without. */
    std::string
    text_of_shortening(const double of_all, const double of_traces)
    {
      std::ostringstream text;
      text << std::setprecision(3) << 100. - 100. / of_all << " per cent";
      if (of_traces > notable_frequency_ratio)
        text << " (springs along traces of joints, whose stiffness is their "
                "'Shear modulus': "
             << 100. - 100. / of_traces << " per cent)";
      return text.str();
    }



    /** How far a block has moved in a stage, by itself. */
    struct Mover
    {
      unsigned int block;
      double way; ///< root mean square [m]
      bool is_moving;
      double speed; ///< of a steady motion [m/s]; 0: not measured
    };

    /** Whether cells of each block are left that are not excavated. */
    template <int dim>
    std::vector<bool>
    find_present_blocks(const Model<dim> &model)
    {
      std::vector<double> n_cells(model.blocks.blocks.size(), 0.);
      for (const unsigned int cell : model.cells.mesh_cell)
        if (const unsigned int b = model.split.block_of_cell[cell]; b != none)
          n_cells[b] += 1.;
      model.communicator.sum_lists(n_cells);
      std::vector<bool> is_there;
      for (const double n : n_cells)
        is_there.push_back(n > 0.);
      return is_there;
    }

    /** Finite blocks that have gone far, or are going on, by themselves; those
     * that went farthest first. Rock that moves as a whole takes its blocks
     * along, which is no motion of theirs. */
    template <int dim>
    std::vector<Mover>
    choose_movers(const Model<dim> &model, const StageProgress<dim> &progress)
    {
      std::vector<Mover> movers;
      if (model.contact == nullptr)
        return movers;
      const BlockMotions<dim> &motions = model.contact->motions();
      const auto in_stage =
        motions.measure(progress.way_in_stage(model.fields));
      const auto velocities            = motions.measure(model.fields.velocity);
      const std::vector<bool> is_there = find_present_blocks(model);
      const auto nodes =
        owned_nodes_of_blocks(model.split, *model.numbering, is_there.size());
      const std::vector<bool> is_guided =
        mark_guided_blocks(model.fields, nodes, model.communicator);
      for (unsigned int b = 0; b < is_there.size(); ++b)
        {
          const Block<dim> &block = model.blocks.blocks[b];
          if (block.is_infinite || !is_there[b] || is_guided[b])
            continue;
          const double way = in_stage[b].way();
          const bool goes_off =
            way > notable_way * block.size &&
            dot<dim>(in_stage[b].shift, velocities[b].shift) > 0. &&
            !progress.is_converged;
          // or slowly, but as fast as ever
          const auto motion =
            progress.slips.motion_since(b, progress.n_done, way);
          const bool creeps =
            !progress.is_converged && motion.way > least_creep * block.size;
          // or has only begun to, farther than its load deforms it
          bool begins = false;
          if (!progress.is_converged && !goes_off && !creeps)
            {
              const BlockBalance<dim> balance =
                measure_balance(model.fields, nodes[b], model.communicator);
              begins =
                is_driven<dim>(balance, velocities[b].shift) &&
                way >
                  compression_of_block(model.conditions->active_cells.ground(),
                                       b,
                                       block,
                                       balance.load);
            }
          if (goes_off || creeps || begins || way > long_way * block.size)
            movers.push_back({b,
                              way,
                              goes_off || creeps || begins,
                              creeps
                                ? motion.way / (motion.n_steps * model.step->dt)
                              : begins ? norm<dim>(velocities[b].shift)
                                       : 0.});
        }
      std::stable_sort(movers.begin(),
                       movers.end(),
                       [](const Mover &a, const Mover &b) {
                         return a.way > b.way;
                       });
      return movers;
    }

    template <int dim>
    std::string
    name_what_moves(const Model<dim> &model, const StageProgress<dim> &progress)
    {
      constexpr unsigned int n_named  = 8;
      const std::vector<Mover> movers = choose_movers(model, progress);
      std::ostringstream text;
      for (unsigned int i = 0; i < movers.size() && i < n_named; ++i)
        text << (i == 0 ? "" : "; ") << "block "
             << model.blocks.blocks[movers[i].block].id
             << (movers[i].is_moving ? " is moving off (" : " moved off (")
             << std::setprecision(3) << movers[i].way << " m"
             << (movers[i].speed > 0.
                   ? ", " + text_of(movers[i].speed, 2) + " m/s)"
                   : ")");
      if (movers.size() > n_named)
        text << "; and " << movers.size() - n_named << " more";
      return text.str();
    }
  } // namespace



  template <int dim>
  void
  note_overlap(const Model<dim> &model, StageProgress<dim> &progress)
  {
    if (!model.contact)
      return;
    const Overlap<dim> overlap = model.contact->report().largest_overlap();
    if (overlap.depth > progress.overlap.depth)
      progress.overlap = overlap;
  }



  namespace
  {
    /** What a stage warns of, as sentences. */
    template <int dim>
    std::string
    warning_of_stage(const Model<dim> &model,
                     const StageProgress<dim> &progress,
                     const StageReport &report)
    {
      std::string text;
      const auto add = [&text](const std::string &sentence) {
        text += (text.empty() || sentence.empty() ? "" : " ") + sentence;
      };
      for (const LinerLoads<dim> &loads :
           model.conditions->report_structural_liners())
        add(warning_of(list_figures(loads), *model.scene.liners[loads.liner]));
      const std::vector<bool> is_removed = progress.removed_before();
      for (const std::string &sentence : warnings_of_bolts_in_void(Ground<dim>{
             model.scene, model.split, progress.number(), &is_removed}))
        add(sentence);
      if (report.through_rock > 0)
        add(std::to_string(report.through_rock) +
            (report.through_rock == 1 ? " contact acts" : " contacts act") +
            " through the rock of a block.");
      return text;
    }
  } // namespace



  template <int dim>
  StageReport
  report_stage(const Model<dim> &model, StageProgress<dim> &progress)
  {
    const Stage &stage = *model.scene.stages[progress.index];
    StageReport result;
    result.name                = stage.name;
    result.steps               = progress.n_done;
    result.time_step           = model.step->dt;
    result.unbalanced_ratio    = model.step->unbalanced_ratio;
    result.largest_nodal_ratio = model.step->largest_nodal_ratio;
    result.energies            = model.step->energies;
    result.is_converged        = progress.is_converged;
    result.is_timed            = progress.is_converged && !stage.is_static() &&
                      !(result.unbalanced_ratio < stage.unbalanced_ratio);
    result.cells         = model.n_cells_global;
    result.plastic_cells = model.communicator.sum(
      static_cast<unsigned int>(model.cells.strength.size()));
    result.yielding_points = model.communicator.sum(model.cells.n_yielding);
    if (model.contact)
      {
        const JointSums<dim> points = model.contact->report().count_points();
        result.points               = {points.n_open,
                                       points.n_sliding,
                                       points.n_sticking,
                                       points.n_intact};
        result.through_rock = model.contact->report().count_through_rock();
        note_overlap(model, progress);
        result.largest_overlap = progress.overlap.depth;
        std::copy_n(progress.overlap.place.begin(),
                    dim,
                    result.overlap_place.begin());
      }
    result.remark = name_what_moves(model, progress);
    for (unsigned int b = 0; b < progress.removal_stage.size(); ++b)
      if (progress.removal_stage[b] == model.scene.stage_number(stage.name))
        result.remark += (result.remark.empty() ? "" : "; ") +
                         std::string("block ") +
                         std::to_string(model.blocks.blocks[b].id) +
                         " failed and was taken away";
    if (result.remark.empty() && !progress.is_converged)
      result.remark = "no block is moving off; more steps may do";
    double largest = 0.;
    for (unsigned int node = 0; node < model.numbering->n_owned(); ++node)
      {
        double square = 0.;
        for (unsigned int d = 0; d < dim; ++d)
          square += std::pow(model.fields.displacement[dim * node + d], 2);
        if (model.fields.mass[node] > 0.) // else its cells are gone
          largest = std::max(largest, square);
      }
    result.max_displacement = std::sqrt(model.communicator.max(largest));
    result.warning          = warning_of_stage(model, progress, result);
    report_turns(model, progress, result);
    return result;
  }



  template <int dim>
  void
  print_stage(std::ostream &out,
              const Model<dim> &model,
              const Stage &stage,
              const StageReport &report)
  {
    out << "Stage   " << stage.name << ": " << report.steps << " steps, "
        << std::setprecision(6) << model.step->time << " s, unbalanced ratio "
        << report.unbalanced_ratio << ", largest displacement "
        << report.max_displacement << " m, energy residual "
        << report.energies.relative_residual() << '\n';
    if (!report.is_converged)
      out << "        not in balance ("
          << (stage.is_static() ? static_tolerance : stage.unbalanced_ratio)
          << " wanted) after " << report.steps << " steps: " << report.remark
          << '\n';
    else if (!report.remark.empty())
      out << "        " << report.remark << '\n';
    if (report.largest_overlap > notable_overlap * report.max_displacement)
      {
        out << "        a node was up to " << std::setprecision(3)
            << report.largest_overlap << " m inside another block, at ("
            << std::setprecision(digits_of_place(model.split.mesh, 3));
        for (unsigned int d = 0; d < dim; ++d)
          out << (d ? ", " : "") << report.overlap_place[d];
        out << ')'
            << (are_any_compliant(model.scene.joints)
                  ? ", as compliant joints close"
                  : "")
            << '\n';
      }
    for (const LinerLoads<dim> &loads :
         model.conditions->report_structural_liners())
      out << describe(list_figures(loads), *model.scene.liners[loads.liner]);
    if (model.conditions->frequency_ratio_of_liners > notable_frequency_ratio)
      out
        << "        shotcrete and structural liners shorten the stable step by "
        << text_of_shortening(model.conditions->frequency_ratio_of_liners,
                              model.conditions->frequency_ratio_of_traces)
        << '\n';
    out << std::flush;
  }

  template void note_overlap(const Model<2> &, StageProgress<2> &);
  template void note_overlap(const Model<3> &, StageProgress<3> &);
  template StageReport report_stage(const Model<2> &, StageProgress<2> &);
  template StageReport report_stage(const Model<3> &, StageProgress<3> &);
  template void print_stage(std::ostream &,
                            const Model<2> &,
                            const Stage &,
                            const StageReport &);
  template void print_stage(std::ostream &,
                            const Model<3> &,
                            const Stage &,
                            const StageReport &);
} // namespace Keyblock
