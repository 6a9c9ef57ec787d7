// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/python/any_run.h>

#include <cmath>
#include <limits>

namespace Keyblock::Python
{
  namespace
  {
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

    template <int dim>
    std::shared_ptr<AnyRun>
    start_run(const std::shared_ptr<const SceneOf<dim>> &scene,
              const std::string &folder,
              const std::string &checkpoint,
              const bool is_verbose)
    {
      return std::make_shared<RunOf<dim>>(scene,
                                          folder,
                                          checkpoint,
                                          is_verbose);
    }

    template <int dim>
    std::vector<std::string>
    validate_scene(const std::shared_ptr<const SceneOf<dim>> &scene,
                   const bool is_verbose)
    {
      Simulation<dim> simulation(scene->source.communicator(),
                                 scene->source.file,
                                 scene->source.overrides,
                                 "");
      if (!is_verbose)
        simulation.be_silent();
      simulation.validate();
      return simulation.all_warnings();
    }

    /** Call @p action with the scene as what it is. */
    template <typename Action>
    auto
    with_dimension(const std::shared_ptr<const AnyScene> &scene,
                   const Action &action)
    {
      if (const auto plane = std::dynamic_pointer_cast<const SceneOf<2>>(scene))
        return action(plane);
      return action(std::dynamic_pointer_cast<const SceneOf<3>>(scene));
    }
  } // namespace



  std::shared_ptr<AnyRun>
  AnyRun::start(const std::shared_ptr<const AnyScene> &scene,
                const std::string &folder,
                const std::string &checkpoint,
                const bool is_verbose)
  {
    return with_dimension(scene, [&](const auto &known) {
      return start_run(known, folder, checkpoint, is_verbose);
    });
  }



  std::vector<std::string>
  AnyRun::validate(const std::shared_ptr<const AnyScene> &scene,
                   const bool is_verbose)
  {
    return with_dimension(scene, [&](const auto &known) {
      return validate_scene(known, is_verbose);
    });
  }



  template <int dim>
  RunOf<dim>::RunOf(const std::shared_ptr<const SceneOf<dim>> &scene,
                    const std::string &folder,
                    const std::string &checkpoint,
                    const bool is_verbose)
    : AnyRun(is_verbose)
    , scene(scene)
    , simulation(std::make_unique<Simulation<dim>>(scene->source.communicator(),
                                                   scene->source.file,
                                                   scene->source.overrides,
                                                   folder,
                                                   checkpoint))
  {
    if (!is_verbose)
      simulation->be_silent();
    if (folder.empty())
      simulation->write_nothing();
    simulation->keep_states_before_stages();
    simulation->start();
  }



  template <int dim>
  Simulation<dim> &
  RunOf<dim>::open() const
  {
    AssertThrow(simulation,
                InputError("The run of '" + scene->source.file +
                           "' is closed; start another one."));
    return *simulation;
  }



  template <int dim>
  void
  RunOf<dim>::close()
  {
    simulation = nullptr;
  }



  template <int dim>
  bool
  RunOf<dim>::has_stage_left() const
  {
    return open().has_stage_left();
  }



  template <int dim>
  StageResult
  RunOf<dim>::run_stage(const std::function<void(const Advance &)> &watcher,
                        const unsigned int interval)
  {
    std::uint64_t next = 0;
    if (watcher)
      open().watch([&](const StageProgress<dim> &progress) {
        if (progress.n_done < next)
          return;
        next                    = progress.n_done + interval;
        const Model<dim> &model = open().state();
        Advance advance;
        advance.stage     = model.scene.stages[progress.index]->name;
        advance.time      = model.step->time;
        advance.step      = progress.n_done;
        advance.unbalance = model.step->unbalanced_ratio;
        advance.ramp_left = model.conditions->loads.ramp_share_left();
        if (model.contact)
          {
            const JointSums<dim> points =
              model.contact->report().count_points();
            advance.n_sliding = points.n_sliding;
            advance.n_open    = points.n_open;
          }
        watcher(advance);
      });
    try
      {
        open().run_stage();
      }
    catch (...)
      {
        open().watch({});
        throw;
      }
    open().watch({});
    return {open().stages_done().back(), open().state().step->time};
  }



  template <int dim>
  void
  RunOf<dim>::finish()
  {
    open().finish();
    is_finished = true;
  }



  template <int dim>
  FactorResult
  RunOf<dim>::describe(const SafetyFactor &factor) const
  {
    FactorResult result;
    result.block        = open().state().blocks.blocks[factor.block].id;
    result.stage        = factor.stage;
    result.outcome      = describe_outcome(factor);
    result.value        = factor.outcome == SafetyFactor::Outcome::bracketed
                            ? factor.value()
                            : unknown;
    result.lower        = factor.lower;
    result.upper        = factor.upper > 0. ? factor.upper
                                            : std::numeric_limits<double>::infinity();
    result.failure_mode = factor.failure_mode.text();
    result.group        = factor.group;
    result.limit_factor = factor.limit_factor;
    result.limit_mode   = factor.limit_mode.text();
    result.stress_ratio =
      factor.stress_ratio > 0. ? factor.stress_ratio : unknown;
    result.n_trials = factor.trials.size();
    for (const Trial &trial : factor.trials)
      result.seconds += trial.seconds;
    return result;
  }



  template <int dim>
  FactorResult
  RunOf<dim>::find_factor(const unsigned int block)
  {
    return describe(open().find_factor(block));
  }



  template <int dim>
  std::vector<FactorResult>
  RunOf<dim>::factors() const
  {
    std::vector<FactorResult> list;
    for (const SafetyFactor &factor : open().factors())
      list.push_back(describe(factor));
    return list;
  }



  template <int dim>
  std::vector<std::string>
  RunOf<dim>::warnings() const
  {
    return open().all_warnings();
  }



  template <int dim>
  std::shared_ptr<const AnyBlocks>
  RunOf<dim>::blocks() const
  {
    const Model<dim> &model = open().state();
    BlockGeometry<dim> geometry;
    geometry.quality = model.quality;
    geometry.report  = model.mesh_report;
    geometry.blocks  = model.blocks;
    geometry.split   = model.split;
    return std::make_shared<BlocksOf<dim>>(scene, std::move(geometry));
  }



  template <int dim>
  double
  RunOf<dim>::time() const
  {
    return open().state().step->time;
  }



  template <int dim>
  Array<double>
  RunOf<dim>::by_vertex(const std::vector<double> &field) const
  {
    const Model<dim> &model = open().state();
    return {{model.split.mesh.vertices.size(), dim},
            model.values_by_vertex(field)};
  }



  template <int dim>
  Array<double>
  RunOf<dim>::displacement() const
  {
    return by_vertex(open().state().fields.displacement);
  }



  template <int dim>
  Array<double>
  RunOf<dim>::velocity() const
  {
    return by_vertex(open().state().fields.velocity);
  }



  template <int dim>
  Array<double>
  RunOf<dim>::stress() const
  {
    const Model<dim> &model         = open().state();
    const unsigned int n            = model.split.mesh.n_cells();
    constexpr unsigned int n_values = n_stress<dim> + 1; // and presence
    std::vector<double> mean(n_values * n, 0.);
    for (unsigned int c = 0; c < model.cells.nodes.size(); ++c)
      {
        double *const value = mean.data() + n_values * model.cells.mesh_cell[c];
        for (unsigned int q = 0; q < (1 << dim); ++q)
          {
            const auto at_point = model.cells.stress_at(c, q);
            for (int k = 0; k < n_stress<dim>; ++k)
              value[k] += at_point[k] / (1 << dim);
          }
        value[n_stress<dim>] = 1.;
      }
    model.communicator.sum_lists(mean);
    Array<double> result{{n, 3, 3}, {}};
    for (unsigned int c = 0; c < n; ++c)
      {
        const double *const s = mean.data() + n_values * c;
        const double yz       = dim == 3 ? s[3] : 0.,
                     xz       = dim == 3 ? s[n_stress<dim> - 2] : 0.,
                     xy       = s[n_stress<dim> - 1];
        for (const double component :
             {s[0], xy, xz, xy, s[1], yz, xz, yz, s[2]})
          result.values.push_back(s[n_stress<dim>] > 0. ? component : unknown);
      }
    return result;
  }



  template <int dim>
  std::pair<std::vector<std::string>, Array<double>>
  RunOf<dim>::history()
  {
    const History &history = open().measured();
    Array<double> table{{history.rows.size(), history.columns.size()}, {}};
    for (const std::vector<double> &row : history.rows)
      table.values.insert(table.values.end(), row.begin(), row.end());
    return {history.columns, table};
  }

  template class RunOf<2>;
  template class RunOf<3>;
} // namespace Keyblock::Python
