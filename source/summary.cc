// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/revision.h>
#include <deal.II/base/utilities.h>

#include <keyblock/block_theory.h>
#include <keyblock/mpi.h>
#include <keyblock/output.h>

#include <boost/property_tree/json_parser.hpp>

#include <sys/resource.h>

#include <fstream>
#include <regex>

namespace Keyblock
{
  namespace
  {
    using Tree = boost::property_tree::ptree;

    /** A number that the JSON writer is to leave unquoted. One that is not
     * finite is taken out again (take_out_not_finite). */
    std::string
    number(const double value)
    {
      std::ostringstream out;
      out << '#' << std::setprecision(17) << value;
      return out.str();
    }

    /** Take numbers that are not finite out of @p tree, and list their paths,
     * which begin with @p path. */
    void
    take_out_not_finite(Tree &tree,
                        const std::string &path,
                        std::vector<std::string> &found)
    {
      unsigned int index = 0;
      for (auto entry = tree.begin(); entry != tree.end(); ++index)
        {
          const std::string name =
            path + (path.empty() ? "" : "/") +
            (entry->first.empty() ? std::to_string(index) : entry->first);
          const std::string &text = entry->second.data();
          if (text == "#inf" || text == "#-inf" || text == "#nan" ||
              text == "#-nan")
            {
              found.push_back(name);
              entry = tree.erase(entry);
              continue;
            }
          take_out_not_finite(entry->second, name, found);
          ++entry;
        }
    }

    template <typename T>
    void
    put(Tree &tree, const std::string &key, const T &value)
    {
      std::string text;
      if constexpr (std::is_same<T, bool>::value)
        text = value ? "#true" : "#false";
      else if constexpr (std::is_arithmetic<T>::value)
        text = number(value);
      else
        text = value;
      tree.push_back({key, Tree(text)});
    }

    /** The factor of limit equilibrium, or that there is none that fails. */
    void
    put_limit_factor(const double factor, Tree &tree)
    {
      const bool is_stable = std::isinf(factor) && factor > 0.;
      put(tree, "outcome", std::string(is_stable ? "stable" : "factor"));
      if (!is_stable)
        put(tree, "value", factor);
    }

    template <int dim>
    Tree
    list_of(const Point<dim> &point)
    {
      Tree list;
      for (unsigned int d = 0; d < dim; ++d)
        list.push_back({"", Tree(number(point[d]))});
      return list;
    }

    template <int dim>
    Point<dim>
    make_point(const std::array<double, 3> &coordinates)
    {
      Point<dim> point;
      for (unsigned int d = 0; d < dim; ++d)
        point[d] = coordinates[d];
      return point;
    }

    Tree
    energies_as_tree(const Energies &e)
    {
      Tree tree;
      put(tree, "kinetic", e.kinetic);
      put(tree, "elastic", e.elastic);
      put(tree, "start", e.start);
      put(tree, "external", e.external);
      put(tree, "supports", e.supports);
      put(tree, "friction", e.friction);
      put(tree, "contact_closure", e.contact_closure);
      put(tree, "penetration", e.penetration);
      put(tree, "stiffness_damping", e.stiffness_damping);
      put(tree, "mass_damping", e.mass_damping);
      put(tree, "local_damping", e.local_damping);
      put(tree, "plastic", e.plastic);
      put(tree, "excavated", e.excavated);
      put(tree, "residual", e.residual());
      put(tree, "relative_residual", e.relative_residual());
      return tree;
    }

    double
    peak_memory()
    {
      rusage usage;
      getrusage(RUSAGE_SELF, &usage);
      return 1024. * usage.ru_maxrss;
    }

    Tree
    trials_as_tree(const std::vector<Trial> &trials)
    {
      Tree list;
      for (const Trial &trial : trials)
        {
          Tree tree;
          put(tree, "factor", trial.factor);
          put(tree, "start", trial.start);
          put(tree, "of_group", trial.is_of_group);
          put(tree, "stable", trial.is_stable);
          put(tree, "undecided", trial.is_undecided);
          put(tree, "broken_bonds", trial.n_broken);
          put(tree, "phase", trial.phase);
          put(tree, "slip", trial.slip);
          put(tree, "velocity", trial.velocity);
          put(tree, "acceleration", trial.acceleration);
          put(tree, "unbalanced", trial.unbalanced);
          put(tree, "steps", trial.n_steps);
          put(tree, "seconds", trial.seconds);
          put(tree, "phase_1_seconds", trial.phase_1_seconds);
          list.push_back({"", tree});
        }
      return list;
    }

    /** The blocks that move together, and their factor. */
    Tree
    group_as_tree(const SafetyFactor &factor)
    {
      Tree tree, ids;
      for (const std::string &id :
           dealii::Utilities::split_string_list(factor.group))
        ids.push_back({"", Tree("#" + id)});
      tree.add_child("blocks", ids);
      put(tree, "lower", factor.group_lower);
      put(tree, "upper", factor.group_upper);
      put(tree, "value", 0.5 * (factor.group_lower + factor.group_upper));
      return tree;
    }

    /** Factors of one block, in the order of the stages. */
    void
    put_factors(const std::vector<SafetyFactor> &factors,
                const unsigned int block,
                Tree &tree)
    {
      Tree strength, limit, ratio;
      for (const SafetyFactor &factor : factors)
        {
          if (factor.block != block)
            continue;
          Tree one, cheap, stress;
          put(one, "stage", factor.stage);
          put(one, "lower", factor.lower);
          if (factor.outcome != SafetyFactor::Outcome::clamped)
            {
              put(one, "upper", factor.upper);
              put(one, "value", factor.value());
            }
          if (factor.undecided_upper > 0.)
            {
              put(one, "undecided_lower", factor.undecided_lower);
              put(one, "undecided_upper", factor.undecided_upper);
            }
          put(one, "outcome", describe_outcome(factor));
          put(one, "failure_mode", factor.failure_mode);
          if (!factor.group.empty())
            one.add_child("group", group_as_tree(factor));
          one.add_child("trials", trials_as_tree(factor.trials));
          strength.push_back({"", one});
          put(cheap, "stage", factor.stage);
          put(cheap, "mode", factor.limit_mode);
          put(cheap, "remark", factor.limit_remark);
          put_limit_factor(factor.limit_factor, cheap);
          limit.push_back({"", cheap});
          put(stress, "stage", factor.stage);
          put(stress, "value", factor.stress_ratio);
          ratio.push_back({"", stress});
          tree.put("failure_mode", factor.failure_mode);
        }
      if (strength.empty())
        return;
      tree.add_child("safety_factor", strength);
      tree.add_child("limit_equilibrium", limit);
      tree.add_child("stress_ratio", ratio);
    }

    template <int dim>
    void
    put_exact_measures(const Block<dim> &block,
                       const Scene<dim> &scene,
                       Tree &tree)
    {
      Tree areas;
      put(tree, "exact_volume", block.exact.volume);
      put(tree, "exact_weight", 9.81 * block.exact_mass());
      for (const auto &[joint, area] : block.exact.joint_area)
        put(areas, scene.joints[joint]->name, area);
      if (!areas.empty())
        tree.add_child("exact_joint_areas", areas);
    }

    template <int dim>
    Tree
    mesh_report_as_tree(const MeshReport<dim> &report, const Scene<dim> &scene)
    {
      Tree tree, merged;
      put(tree, "way", report.way);
      put(tree, "reason", report.reason);
      put(tree, "largest_shift", report.largest_shift);
      put(tree, "largest_shift_in_cells", report.largest_shift_in_cells);
      put(tree, "percentile_99", report.percentile_99);
      put(tree, "percentile_99_in_cells", report.percentile_99_in_cells);
      put(tree, "area_ratio_of_finite_joints", report.area_ratio);
      put(tree, "area_ratio_of_large_joints", report.area_ratio_of_large);
      put(tree, "passes", report.n_passes);
      put(tree, "lost_blocks", report.n_lost_blocks);
      put(tree, "largest_lost_volume", report.largest_lost_volume);
      if (report.n_lost_blocks > 0)
        tree.add_child("largest_lost_place",
                       list_of<dim>(report.largest_lost_place));
      const auto names = [&scene](const std::vector<unsigned int> &joints) {
        std::string text;
        for (const unsigned int j : joints)
          text += (text.empty() ? "" : ", ") + scene.joints[j]->name;
        return text;
      };
      put(tree, "joints_lost", names(report.lost));
      put(tree, "joints_outside", names(report.outside));
      for (const auto &pair : report.merged)
        put(merged,
            scene.joints[pair.joint]->name + " " +
              scene.joints[pair.other]->name,
            pair.area);
      if (!merged.empty())
        tree.add_child("merged_areas", merged);
      Tree gaps;
      for (const auto &gap : report.gaps)
        gaps.push_back({"",
                        Tree(scene.joints[gap.joint]->name + " before " +
                             scene.joints[gap.other]->name)});
      if (!gaps.empty())
        tree.add_child("open_ends", gaps);
      return tree;
    }

    template <int dim>
    Tree
    blocks_as_tree(const Blocks<dim> &blocks,
                   const Scene<dim> &scene,
                   const std::vector<SafetyFactor> &factors,
                   const std::vector<unsigned int> &removal_stage,
                   const std::vector<MassScaling> &scaling)
    {
      Tree list;
      for (const Block<dim> &block : blocks.blocks)
        {
          Tree tree, classes, areas;
          const unsigned int b = &block - blocks.blocks.data();
          put(tree, "id", block.id);
          for (const BlockClass kind : block.class_of_stage)
            classes.push_back({"", Tree(to_string(kind))});
          tree.add_child("class", classes);
          put(tree, "removable", block.is_removable);
          put(tree, "cells", block.n_cells);
          put(tree, "volume", block.volume);
          if (!block.is_infinite)
            {
              put(tree, "width", block.width);
              put(tree, "cells_across", block.cells_across());
            }
          if (block.exact.is_known)
            put_exact_measures(block, scene, tree);
          put(tree, "mass", block.mass);
          put(tree, "weight", 9.81 * block.mass);
          put(tree,
              "added_mass",
              b < scaling.size() ? scaling[b].added_fraction() : 0.);
          tree.add_child("centroid", list_of<dim>(block.centroid));
          if (block.exposed_stage != none)
            put(tree, "exposed_stage", block.exposed_stage);
          for (const auto &[joint, area] : block.joint_area)
            put(areas, scene.joints[joint]->name, area);
          if (!areas.empty())
            tree.add_child("joint_areas", areas);
          if (b < removal_stage.size() && removal_stage[b] > 1)
            put(tree,
                "removed_in_stage",
                scene.stages[removal_stage[b] - 2]->name);
          put_factors(factors, b, tree);
          list.push_back({"", tree});
        }
      return list;
    }
    /** Throw ComputationError on all ranks if rank 0 has a @p message. */
    void
    assert_finite(const std::string &message)
    {
      const std::string text = text_of_root(message);
      AssertThrow(text.empty(), ComputationError(text));
    }
  } // namespace



  template <int dim>
  void
  Output<dim>::write_summary(const MeshQuality &quality,
                             const MeshReport<dim> &mesh_report,
                             const RunReport &run,
                             const std::vector<StageReport> &stages,
                             const History &history,
                             const CheckValues &checks,
                             const std::vector<SafetyFactor> &factors,
                             const std::vector<unsigned int> &removal_stage,
                             const Geostress *geostress) const
  {
    const double memory         = sum_over_ranks(peak_memory());
    const std::string file_name = folder + "summary.json";
    if (!is_root())
      {
        assert_written(true, file_name);
        assert_finite("");
        return;
      }
    Tree root, program, scene_tree, run_tree, stage_list, monitors, check_tree;
    put(program, "version", std::string(KEYBLOCK_VERSION));
    put(program, "deal_ii_version", std::string(DEAL_II_PACKAGE_VERSION));
    put(program, "ranks", n_ranks());
#ifdef DEBUG
    put(program, "build_type", std::string("Debug"));
#else
    put(program, "build_type", std::string("Release"));
#endif
    put(scene_tree, "name", scene.file);
    put(scene_tree, "title", scene.title);
    put(scene_tree, "dimension", dim);
    put(scene_tree, "cells", split.mesh.n_cells());
    put(scene_tree, "nodes", numbering.n_global());
    put(scene_tree, "joints", scene.joints.size());
    put(scene_tree, "sign_codes", blocks.n_sign_codes);
    put(scene_tree, "pairs", split.interface.pairs.size());
    put(scene_tree, "minimum_scaled_jacobian", quality.minimum_scaled_jacobian);
    put(run_tree, "steps", run.steps);
    put(run_tree, "time_step", run.time_step);
    put(run_tree, "time_step_set_at", run.stable_step_place);
    put(run_tree, "step_ratio", run.step_ratio);
    put(run_tree, "time_step_set_beside", run.stable_step_joints);
    put(run_tree, "added_mass", total_added_fraction(run.mass_scaling));
    put(run_tree, "simulated_time", run.simulated_time);
    put(run_tree, "wall_time", run.wall_time);
    put(run_tree, "loop_time", run.loop_time);
    put(run_tree, "contact_time", run.contact_time);
    put(run_tree, "force_time", run.force_time);
    put(run_tree, "skipped_element_steps", run.skipped_steps);
    put(run_tree,
        "million_element_steps_per_second",
        run.loop_time > 0. ? 1e-6 * run.element_steps / run.loop_time : 0.);
    put(run_tree, "peak_memory_bytes", memory);
    put(run_tree, "capped_contact_groups", run.capped_groups);
    for (const StageReport &stage : stages)
      {
        Tree tree;
        put(tree, "name", stage.name);
        put(tree, "steps", stage.steps);
        put(tree, "time_step", stage.time_step);
        put(tree, "unbalanced_ratio", stage.unbalanced_ratio);
        put(tree, "largest_nodal_ratio", stage.largest_nodal_ratio);
        put(tree, "converged", stage.is_converged);
        if (!stage.remark.empty())
          put(tree, "remark", stage.remark);
        put(tree, "max_displacement", stage.max_displacement);
        put(tree, "cells", stage.cells);
        put(tree, "plastic_cells", stage.plastic_cells);
        put(tree, "yielding_points", stage.yielding_points);
        put(tree, "open_points", stage.points.open);
        put(tree, "sliding_points", stage.points.sliding);
        put(tree, "sticking_points", stage.points.sticking);
        put(tree, "contacts_through_rock", stage.through_rock);
        put(tree, "largest_overlap", stage.largest_overlap);
        if (stage.largest_overlap > 0.)
          tree.add_child("largest_overlap_at",
                         list_of(make_point<dim>(stage.overlap_place)));
        tree.add_child("energy", energies_as_tree(stage.energies));
        stage_list.push_back({"", tree});
      }
    if (!history.rows.empty())
      for (unsigned int c = 3; c < history.columns.size(); ++c)
        put(monitors, history.columns[c], history.rows.back()[c]);
    for (const auto &[name, value] : checks)
      put(check_tree, name, value);

    if (geostress != nullptr)
      {
        Tree fit, coefficients, errors;
        for (unsigned int j = 0; j < geostress->names.size(); ++j)
          {
            put(coefficients,
                geostress->names[j],
                geostress->fit.coefficients[j]);
            put(errors, geostress->names[j], geostress->fit.standard_errors[j]);
          }
        fit.add_child("coefficients", coefficients);
        fit.add_child("standard_errors", errors);
        put(fit, "r_squared", geostress->fit.r_squared);
        put(fit, "condition_number", geostress->fit.condition_number);
        root.add_child("geostress", fit);
      }
    root.add_child("program", program);
    root.add_child("scene", scene_tree);
    if (!mesh_report.way.empty())
      root.add_child("mesh", mesh_report_as_tree(mesh_report, scene));
    root.add_child("run", run_tree);
    root.add_child("energy",
                   energies_as_tree(stages.empty() ? Energies()
                                                   : stages.back().energies));
    root.add_child("blocks",
                   blocks_as_tree<dim>(
                     blocks, scene, factors, removal_stage, run.mass_scaling));
    if (scene.block_theory.report)
      root.add_child("block_theory",
                     block_theory_as_tree(
                       find_block_theory(scene, scene.block_theory)));
    root.add_child("stages", stage_list);
    root.add_child("monitors", monitors);
    root.add_child("checks", check_tree);

    std::vector<std::string> not_finite;
    take_out_not_finite(root, "", not_finite);
    if (!not_finite.empty())
      {
        Tree list;
        for (const std::string &name : not_finite)
          list.push_back({"", Tree(name)});
        root.add_child("not_finite", list);
      }
    std::ostringstream json;
    boost::property_tree::write_json(json, root);
    // property trees write all values as strings; ours marked theirs
    std::string text =
      std::regex_replace(json.str(), std::regex("\"#([^\"]*)\""), "$1");
    text = std::regex_replace(text,
                              std::regex("\"(checks|monitors)\": \"\""),
                              "\"$1\": {}");
    text = std::regex_replace(text,
                              std::regex("\"(stages|blocks|trials)\": \"\""),
                              "\"$1\": []");
    std::ofstream out(file_name);
    out << text;
    assert_written(bool(out.flush()), file_name);
    assert_finite(
      not_finite.empty()
        ? ""
        : "The value '" + not_finite.front() + "' of '" + file_name +
            "' is not finite" +
            (not_finite.size() > 1
               ? ", nor are " + std::to_string(not_finite.size() - 1) +
                   " others"
               : "") +
            "; the file lists them under 'not_finite' and leaves them out.");
  }

  template void Output<2>::write_summary(const MeshQuality &,
                                         const MeshReport<2> &,
                                         const RunReport &,
                                         const std::vector<StageReport> &,
                                         const History &,
                                         const CheckValues &,
                                         const std::vector<SafetyFactor> &,
                                         const std::vector<unsigned int> &,
                                         const Geostress *) const;
  template void Output<3>::write_summary(const MeshQuality &,
                                         const MeshReport<3> &,
                                         const RunReport &,
                                         const std::vector<StageReport> &,
                                         const History &,
                                         const CheckValues &,
                                         const std::vector<SafetyFactor> &,
                                         const std::vector<unsigned int> &,
                                         const Geostress *) const;
} // namespace Keyblock
