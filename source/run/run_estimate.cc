// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/delimited_text.h>
#include <keyblock/base/number_text.h>
#include <keyblock/run/progress_line.h>
#include <keyblock/run/run_estimate.h>
#include <keyblock/run/stage_runner.h>
#include <keyblock/run/static_stage.h>
#include <keyblock/scene/step_count.h>
#include <keyblock/step/equilibrium.h>

#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <ostream>

namespace Keyblock
{
  namespace
  {
    // for so long steps are made [s], not more of them, and the first ones are
    // not timed unless they take as long
    constexpr double timed_seconds    = 0.7;
    constexpr unsigned int most_timed = 2000, n_warm_up = 10;

    /** Models with more cells are not brought into balance first, which may
     * take longer than all the rest of the forecast. */
    constexpr unsigned long long most_cells_to_solve = 30000;

    // as measured on scenes of the project (doc/performance.md)
    /** Steps of a quasi-static stage over those of its ramp, in elastic rock
     * and where rock may yield, which slows the ramp down [-]. */
    constexpr double least_ramps = 1.2, most_ramps = 6.;
    constexpr double least_plastic_ramps = 3., most_plastic_ramps = 15.;

    /** Steps after which a stage that changes nothing is found in balance. */
    constexpr double least_steps = 25.;
    /** Trials of a factor, and length of one in periods of the block [-]. */
    constexpr double least_trials = 5., most_trials = 16.;
    constexpr double least_periods = 15., most_periods = 60.;

    /** Bytes of a row of a stiffness matrix and of its multigrid levels, for
     * each entry [-]. */
    constexpr double bytes_per_entry = 36.;

    /** Cells across what a stage excavates, at least. */
    constexpr double least_across = 4.;

    /** What is printed for a range of times, of at least 0.1 s. */
    std::string
    times_text(const EstimatedRange &seconds)
    {
      const auto text = [](const double exact) {
        const double s = std::max(0.1, exact);
        return s < 9.95 ? text_of(s, 2) + " s" : duration_text(s);
      };
      const std::string least = text(seconds.least), most = text(seconds.most);
      return least == most ? least : least + " to " + most;
    }

    /** A number with two digits that count, without an exponent. */
    std::string
    rounded(const double value)
    {
      if (value < 100.)
        return text_of(value, 2);
      const double unit = std::pow(10., std::floor(std::log10(value)) - 1.);
      return std::to_string(std::llround(unit * std::round(value / unit)));
    }

    std::string
    counts_text(const EstimatedRange &counts)
    {
      if (counts.least == counts.most)
        return std::to_string(std::llround(counts.least));
      return rounded(counts.least) + " to " + rounded(counts.most);
    }

    double
    peak_memory()
    {
      rusage usage;
      getrusage(RUSAGE_SELF, &usage);
      return 1024. * usage.ru_maxrss;
    }

    /** Steps that nobody looks at. */
    template <int dim>
    class NoObserver : public StageObserver<dim>
    {
    public:
      void
      save_point(StageProgress<dim> &) override
      {}
    };

    /** Time of a processor that this rank has had, which other programs on the
     * machine do not lengthen [s]. */
    double
    processor_seconds()
    {
      return double(std::clock()) / CLOCKS_PER_SEC;
    }

    template <typename T>
    double
    bytes_of(const std::vector<T> &list)
    {
      return sizeof(T) * double(list.size());
    }
  } // namespace



  template <int dim>
  RunEstimate<dim>::RunEstimate(Model<dim> &model, Run<dim> &run)
    : model(model)
    , run(run)
  {
    if (model.n_cells_global == 0 || model.scene.stages.empty())
      return;
    // what the run will say is not said here
    const bool is_active = model.out.is_active();
    model.out.set_condition(false);
    time_steps();
    model.out.set_condition(is_active);
    for (unsigned int s = 0; s < model.scene.stages.size(); ++s)
      {
        stages.push_back(forecast(s));
        add_trials(s);
      }
    memory = model.communicator.sum(peak_memory() + count_bytes_to_come());
  }



  template <int dim>
  void
  RunEstimate<dim>::time_steps()
  {
    auto &all = model.scene.stages;
    const auto stepped =
      std::find_if(all.begin(), all.end(), [](const auto &s) {
        return !s->is_static();
      });
    const bool may_solve = model.n_cells_global <= most_cells_to_solve;
    const double start   = processor_seconds();
    if (may_solve)
      establish_initial_state(model);
    StageProgress<dim> progress;
    progress.index =
      (stepped == all.end() ? all.begin() : stepped) - all.begin();
    Stage &stage = *all[progress.index];
    // four periods of the whole model, whose waves cross a cell in a step
    ramp_steps =
      16. / model.scene.time_stepping.safety *
      std::max(least_across, std::pow(model.n_cells_global, 1. / dim));
    const double given = stage.ramp_duration;
    if (!may_solve && stage.is_quasi_static() && given == 0.)
      stage.ramp_duration = ramp_steps * model.step->longest_step(stage);
    NoObserver<dim> observer;
    StageRunner<dim>(model, run.finite_check, observer).begin(progress);
    stage.ramp_duration = given;
    static_seconds      = model.communicator.max(processor_seconds() - start);
    if (stage.is_static())
      return;
    if (const double duration =
          model.conditions->remember().loads.ramp.duration;
        may_solve && duration > 0. && given == 0.)
      ramp_steps = duration / model.step->dt;

    // waves have not reached all cells yet, which the run will step
    model.step->skips_resting = false;
    const unsigned int interval =
      stage.is_quasi_static()
        ? std::max(model.scene.output.history_interval, 25u)
        : model.scene.output.history_interval;
    const double first   = processor_seconds();
    double begin         = first;
    unsigned int n_steps = 0;
    for (unsigned int i = 0; i < most_timed; ++i)
      {
        if (i == n_warm_up)
          {
            begin   = processor_seconds();
            n_steps = 0;
          }
        model.step->advance(i % interval == 0);
        if (i % interval == 0)
          run.monitors.sample(*model.step, progress.index);
        ++n_steps;
        if (model.communicator.on_any(processor_seconds() - first >
                                      timed_seconds))
          break;
      }
    seconds_per_step =
      model.communicator.max(processor_seconds() - begin) / n_steps;
  }



  template <int dim>
  StageForecast
  RunEstimate<dim>::forecast(const unsigned int index) const
  {
    const Stage &stage = *model.scene.stages[index];
    StageForecast result;
    result.name      = stage.name;
    result.is_static = stage.is_static();
    if (stage.is_static())
      return result;
    if (stage.duration > 0.)
      {
        const double n = count_steps(stage, model.step->longest_step(stage));
        result.steps   = {n, n};
      }
    else
      {
        result.has_end = false;
        const bool is_ramped =
          model.conditions->changes(model.scene.stage_number(stage.name));
        const bool is_plastic =
          std::any_of(model.scene.materials.begin(),
                      model.scene.materials.end(),
                      [](const auto &m) { return m->is_plastic(); });
        const double ramp = stage.ramp_duration > 0.
                              ? stage.ramp_duration / model.step->dt
                              : ramp_steps;
        result.steps      = {!is_ramped
                               ? least_steps
                               : (is_plastic ? least_plastic_ramps : least_ramps) *
                                   ramp,
                        (is_plastic ? most_plastic_ramps : most_ramps) * ramp};
      }
    if (stage.maximum_steps > 0)
      {
        result.may_end_late = result.steps.most > stage.maximum_steps;
        result.steps.least =
          std::min<double>(result.steps.least, stage.maximum_steps);
        result.steps.most =
          std::min<double>(result.steps.most, stage.maximum_steps);
      }
    return result;
  }



  template <int dim>
  void
  RunEstimate<dim>::add_trials(const unsigned int index)
  {
    const SafetySettings &safety = model.scene.safety;
    if (!model.contact || !safety.wants_stage(model.scene.stages[index]->name))
      return;
    StageProgress<dim> &present = run.record.present;
    present.index               = index;
    present.removal_stage.assign(model.blocks.blocks.size(), 0);
    const bool moves_all = safety.reach == 0. || safety.reduces_rock ||
                           safety.reduced_joints == ReducedJoints::all;
    for (const unsigned int b : run.safety.list_wanted_blocks())
      {
        const Block<dim> &block = model.blocks.blocks[b];
        ++n_factors;
        unsigned int n_near = 0;
        for (unsigned int c = 0; c < model.split.mesh.n_cells(); ++c)
          n_near += moves_all || model.split.block_of_cell[c] == b ||
                    model.split.mesh.cell_center(c).distance(block.centroid) <=
                      (0.5 + safety.reach) * block.size;
        const double across =
          std::max(least_across,
                   block.size /
                     std::pow(block.volume / block.n_cells, 1. / dim));
        const double period = 4. * across / model.scene.time_stepping.safety;
        const double seconds =
          seconds_per_step * period * n_near / model.split.mesh.n_cells();
        trial_seconds.add(least_trials * least_periods * seconds,
                          most_trials * most_periods * seconds);
      }
  }



  template <int dim>
  double
  RunEstimate<dim>::count_bytes_to_come() const
  {
    const Fields<dim> &fields = model.fields;
    const double n_nodes      = model.numbering->n_local(),
                 n_cells      = model.cells.nodes.size();
    // fields and stresses, contact with its pairs and nodes
    const double snapshot =
      7. * bytes_of(fields.displacement) +
      n_cells * (1 << dim) * (n_stress<dim> + 1.) * sizeof(double) +
      32. * sizeof(double) * model.split.interface.pairs.size();
    double bytes = 0.;
    if (n_factors > 0 || model.scene.output.keeps_stages)
      bytes += 4. * snapshot;
    // the grid that is written, and its compressed arrays
    if (model.scene.output.write_vtu)
      bytes += sizeof(double) * (60. * n_nodes + 40. * n_cells);
    const bool solves =
      model.scene.initial_state.equilibrium != InitialEquilibrium::none ||
      std::any_of(model.scene.stages.begin(),
                  model.scene.stages.end(),
                  [](const auto &stage) {
                    return stage->is_static() || (stage->is_quasi_static() &&
                                                  stage->ramp_duration == 0.);
                  });
    if (solves && model.n_cells_global > most_cells_to_solve)
      bytes += bytes_per_entry * n_nodes * dim * dim * std::pow(3., dim);
    return bytes;
  }



  template <int dim>
  EstimatedRange
  RunEstimate<dim>::step_seconds() const
  {
    EstimatedRange seconds;
    for (const StageForecast &stage : stages)
      seconds.add(seconds_per_step * stage.steps.least,
                  seconds_per_step * stage.steps.most);
    return seconds;
  }



  template <int dim>
  void
  RunEstimate<dim>::print(std::ostream &out) const
  {
    if (stages.empty())
      return;
    constexpr unsigned int most_stages = 4;
    out << "Estimate ";
    for (unsigned int s = 0; s < stages.size() && s < most_stages; ++s)
      out << (s ? "; " : "") << stages[s].name << ": "
          << (stages[s].is_static ? "static solves"
                                  : counts_text(stages[s].steps) + " steps")
          << (stages[s].is_static || stages[s].has_end ? ""
                                                       : " until in balance")
          << (stages[s].may_end_late ? ", at most" : "");
    if (stages.size() > most_stages)
      out << "; and " << count_text(stages.size() - most_stages, "more stage");
    if (seconds_per_step > 0.)
      out << "; " << text_of(1e3 * seconds_per_step, 2) << " ms each here on "
          << model.communicator.size()
          << (model.communicator.size() > 1 ? " ranks: " : " rank: ")
          << times_text(step_seconds());
    out << '\n';
    if (static_seconds > 1.)
      out << "        static solves before the first step: "
          << times_text({static_seconds, static_seconds}) << '\n';
    if (n_factors > 0)
      out << "        " << n_factors
          << (n_factors > 1 ? " safety factors: " : " safety factor: ")
          << times_text(trial_seconds) << " of trials\n";
    out << "        memory at most about " << rounded(1e-6 * memory) << " MB\n";
  }

  template class RunEstimate<2>;
  template class RunEstimate<3>;
} // namespace Keyblock
