// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/revision.h>
#include <deal.II/base/utilities.h>

#include <keyblock/base/digest.h>
#include <keyblock/blocks/exact_blocks.h>
#include <keyblock/output/bolt_output.h>
#include <keyblock/output/factor_json.h>
#include <keyblock/output/mesh_json.h>
#include <keyblock/output/output.h>
#include <keyblock/safety/block_theory.h>

#include <keyblock_commit.h>

#include <sys/resource.h>

#include <cmath>
#include <fstream>
#include <sstream>

namespace Keyblock
{
  namespace
  {
    /** Take numbers that are not finite out of @p json, and list their paths,
     * which begin with @p path. */
    void
    take_out_not_finite(Json &json,
                        const std::string &path,
                        std::vector<std::string> &found)
    {
      if (!json.is_structured())
        return;
      const bool is_list = json.is_array();
      unsigned int index = 0;
      for (auto entry = json.begin(); entry != json.end(); ++index)
        {
          const std::string name =
            path + (path.empty() ? "" : "/") +
            (is_list ? std::to_string(index) : entry.key());
          if (entry->is_number_float() && !std::isfinite(entry->get<double>()))
            {
              found.push_back(name);
              entry = json.erase(entry);
              continue;
            }
          take_out_not_finite(*entry, name, found);
          ++entry;
        }
    }

    Json
    energies_as_json(const Energies &energies)
    {
      Json json = Json::object();
      for (const Energies::Term &term : Energies::terms())
        json[term.name] = energies.*term.value;
      json["residual"]          = energies.residual();
      json["relative_residual"] = energies.relative_residual();
      return json;
    }

    double
    peak_memory()
    {
      rusage usage;
      getrusage(RUSAGE_SELF, &usage);
      return 1024. * usage.ru_maxrss;
    }

    /** Areas by name of the joint. */
    template <int dim, typename Areas>
    Json
    areas_as_json(const Areas &areas, const Scene<dim> &scene)
    {
      Json json = Json::object();
      for (const auto &[joint, area] : areas)
        json[scene.joints[joint]->name] = area;
      return json;
    }

    template <int dim>
    void
    put_exact_measures(const Block<dim> &block,
                       const Scene<dim> &scene,
                       Json &json)
    {
      json["exact_volume"] = block.exact.volume;
      json["exact_weight"] = weight_per_mass(scene) * block.best_mass();
      if (!block.exact.joint_area.empty())
        json["exact_joint_areas"] =
          areas_as_json(block.exact.joint_area, scene);
    }

    template <int dim>
    Json
    blocks_as_json(const Blocks<dim> &blocks,
                   const Scene<dim> &scene,
                   const std::vector<SafetyFactor> &factors,
                   const std::vector<unsigned int> &removal_stage,
                   const std::vector<MassScaling> &scaling)
    {
      Json list = Json::array();
      for (const Block<dim> &block : blocks.blocks)
        {
          const unsigned int b = &block - blocks.blocks.data();
          Json json            = {{"id", block.id}, {"class", Json::array()}};
          for (const BlockClass kind : block.class_of_stage)
            json["class"].push_back(to_string(kind));
          json["removable"] = block.is_removable;
          json["cells"]     = block.n_cells;
          json["volume"]    = block.volume;
          if (!block.is_infinite)
            {
              json["width"] = block.width;
              if (block.n_cells > 0)
                json["cells_across"] = block.cells_across();
            }
          if (block.exact.is_known)
            put_exact_measures(block, scene, json);
          json["mass"]   = block.mass;
          json["weight"] = weight_per_mass(scene) * block.mass;
          json["added_mass"] =
            b < scaling.size() ? scaling[b].added_fraction() : 0.;
          json["centroid"] = list_of<dim>(block.centroid);
          if (block.exposed_stage != none)
            json["exposed_stage"] = block.exposed_stage;
          if (!block.joint_area.empty())
            json["joint_areas"] = areas_as_json(block.joint_area, scene);
          if (b < removal_stage.size() && removal_stage[b] > 1)
            json["removed_in_stage"] = scene.stages[removal_stage[b] - 2]->name;
          put_factors(factors, b, json);
          list.push_back(json);
        }
      return list;
    }

    template <int dim>
    Json
    stage_as_json(const StageReport &stage)
    {
      Json json = {{"name", stage.name},
                   {"steps", stage.steps},
                   {"time_step", stage.time_step},
                   {"unbalanced_ratio", stage.unbalanced_ratio},
                   {"largest_nodal_ratio", stage.largest_nodal_ratio}};
      if (stage.is_timed)
        json["ended"] = "after its duration";
      else
        json["converged"] = stage.is_converged;
      if (!stage.remark.empty())
        json["remark"] = stage.remark;
      if (!stage.warning.empty())
        json["warning"] = stage.warning;
      json["max_displacement"]      = stage.max_displacement;
      json["cells"]                 = stage.cells;
      json["plastic_cells"]         = stage.plastic_cells;
      json["yielding_points"]       = stage.yielding_points;
      json["open_points"]           = stage.points.open;
      json["sliding_points"]        = stage.points.sliding;
      json["sticking_points"]       = stage.points.sticking;
      json["contacts_through_rock"] = stage.through_rock;
      json["largest_overlap"]       = stage.largest_overlap;
      if (stage.largest_overlap > 0.)
        json["largest_overlap_at"] =
          std::vector<double>(stage.overlap_place.begin(),
                              stage.overlap_place.begin() + dim);
      if (stage.turned_block != none)
        json["turned_most"] = {{"block", stage.turned_block},
                               {"rotation", stage.turned_by},
                               {"arm_error", stage.arm_error}};
      json["energy"] = energies_as_json(stage.energies);
      return json;
    }

    Json
    run_as_json(const RunReport &run)
    {
      return {{"steps", run.steps},
              {"time_step", run.time_step},
              {"time_step_set_at", run.stable_step_place},
              {"step_ratio", run.step_ratio},
              {"time_step_set_beside", run.stable_step_joints},
              {"added_mass", total_added_fraction(run.mass_scaling)},
              {"simulated_time", run.simulated_time},
              {"wall_time", run.wall_time},
              {"loop_time", run.loop_time},
              {"contact_time", run.contact_time},
              {"force_time", run.force_time},
              {"skipped_element_steps", run.skipped_steps},
              {"million_element_steps_per_second",
               run.loop_time > 0. ? 1e-6 * run.element_steps / run.loop_time
                                  : 0.},
              {"capped_contact_groups", run.capped_groups}};
    }

    Json
    program_as_json(const Communicator &communicator)
    {
      return {{"version", KEYBLOCK_VERSION},
              {"commit", KEYBLOCK_COMMIT},
              {"compiler", KEYBLOCK_COMPILER},
              {"deal_ii_version", DEAL_II_PACKAGE_VERSION},
              {"ranks", communicator.size()},
#ifdef DEBUG
              {"build_type", "Debug"}};
#else
              {"build_type", "Release"}};
#endif
    }

    /** Joint sets that are made at random, with their seeds. */
    template <int dim>
    Json
    seeds_as_json(const Scene<dim> &scene)
    {
      Json json = Json::object();
      for (const auto &set : scene.joint_sets)
        if (set->is_made())
          json[set->name] = set->seed;
      return json;
    }

    Json
    geostress_as_json(const Geostress &geostress)
    {
      Json json = {{"coefficients", Json::object()},
                   {"standard_errors", Json::object()}};
      for (unsigned int j = 0; j < geostress.names.size(); ++j)
        {
          const std::string &name       = geostress.names[j];
          json["coefficients"][name]    = geostress.fit.coefficients[j];
          json["standard_errors"][name] = geostress.fit.standard_errors[j];
        }
      json["r_squared"]        = geostress.fit.r_squared;
      json["condition_number"] = geostress.fit.condition_number;
      return json;
    }

    /** Throw ComputationError on all ranks if rank 0 has a @p message. */
    void
    assert_finite(const Communicator &communicator, const std::string &message)
    {
      const std::string text = communicator.text_of_root(message);
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
    const double memory         = numbering.communicator.sum(peak_memory());
    const std::string file_name = folder + "summary.json";
    if (!numbering.communicator.is_root())
      {
        numbering.communicator.assert_written(true, file_name);
        assert_finite(numbering.communicator, "");
        return;
      }
    Json root = Json::object();
    if (geostress != nullptr)
      root["geostress"] = geostress_as_json(*geostress);
    root["program"] = program_as_json(numbering.communicator);
    if (!run.liners.empty())
      root["shotcrete"] = liners_as_json(run.liners, run.structural, scene);
    if (!run.bolts.empty())
      root["bolts"] = bolts_as_json(run.bolts);
    root["scene"] = {{"name", scene.file},
                     {"title", scene.title},
                     {"digest", digest_of(scene.used_entries())},
                     {"overrides", run.overrides},
                     {"seeds", seeds_as_json(scene)},
                     {"dimension", dim},
                     {"cells", split.mesh.n_cells()},
                     {"nodes", numbering.n_global()},
                     {"joints", scene.joints.size()},
                     {"sign_codes", blocks.n_sign_codes},
                     {"pairs", split.interface.pairs.size()},
                     {"minimum_scaled_jacobian",
                      quality.minimum_scaled_jacobian}};
    if (!mesh_report.way.empty())
      root["mesh"] = mesh_report_as_json(mesh_report, scene);
    if (blocks.comparison.is_known)
      root["between_planes"] = comparison_as_json(blocks, scene);
    root["run"]                      = run_as_json(run);
    root["run"]["peak_memory_bytes"] = memory;
    root["warnings"]                 = run.warnings;
    root["energy"] =
      energies_as_json(stages.empty() ? Energies() : stages.back().energies);
    root["blocks"] = blocks_as_json<dim>(
      blocks, scene, factors, removal_stage, run.mass_scaling);
    if (scene.block_theory.report)
      root["block_theory"] =
        block_theory_as_json(find_block_theory(scene, scene.block_theory));
    root["stages"] = Json::array();
    for (const StageReport &stage : stages)
      root["stages"].push_back(stage_as_json<dim>(stage));
    root["monitors"] = Json::object();
    if (!history.rows.empty())
      for (unsigned int c = 3; c < history.columns.size(); ++c)
        root["monitors"][history.columns[c]] = history.rows.back()[c];
    root["checks"] = Json::object();
    for (const auto &[name, value] : checks)
      root["checks"][name] = value;

    std::vector<std::string> not_finite;
    take_out_not_finite(root, "", not_finite);
    if (!not_finite.empty())
      root["not_finite"] = not_finite;
    std::ofstream out(file_name);
    out << root.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
    numbering.communicator.assert_written(bool(out.flush()), file_name);
    assert_finite(
      numbering.communicator,
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
