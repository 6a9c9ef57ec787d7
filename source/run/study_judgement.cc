// SPDX-License-Identifier: LGPL-2.1-or-later
// What a study says of a sample: limit equilibrium, and strength reduction.
#include <keyblock/base/errors.h>
#include <keyblock/base/number_text.h>
#include <keyblock/run/probability_study.h>
#include <keyblock/run/simulation.h>
#include <keyblock/safety/block_cascade.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>

namespace Keyblock
{
  namespace
  {
    /** Whether 'Safety factor/Stages' has a stage with a number from @p first
     * up to, and without, @p end, or none; stages have numbers from 2 on. */
    template <int dim>
    bool
    is_wanted(const Scene<dim> &scene,
              const unsigned int first,
              const unsigned int end)
    {
      const std::vector<std::string> &wanted = scene.safety.stages;
      for (unsigned int number = std::max(first, 2u); number < end; ++number)
        if (wanted.empty() || std::count(wanted.begin(),
                                         wanted.end(),
                                         scene.stages[number - 2]->name) > 0)
          return true;
      return scene.stages.empty();
    }
  } // namespace



  template <int dim>
  typename ProbabilityStudy<dim>::BlockFactors
  ProbabilityStudy<dim>::judge_blocks(const Scene<dim> &sample,
                                      const BlockGeometry<dim> &g) const
  {
    const auto &all = g.blocks.blocks;
    // by the numbers of the stages from which on they are so
    struct Factors
    {
      double least    = std::numeric_limits<double>::infinity(),
             first    = std::numeric_limits<double>::infinity();
      bool is_exposed = false;
    };
    std::map<unsigned int, std::vector<Factors>> factors;
    for_each_changed_ground<dim>(
      sample,
      g.split,
      [&](const Ground<dim> &ground, const FreeFaces<dim> &free) {
        auto &now = factors[ground.stage_number];
        now.resize(all.size());
        // what falls once others have gone falls, too
        for (const JudgedBlock<dim> &one :
             judge_exposed_blocks(ground, free, g.blocks, 0.))
          {
            AssertThrow(!std::isnan(one.statics.limit.factor) &&
                          !std::isnan(one.least_factor),
                        InputError("Block " +
                                   std::to_string(all[one.block].id) +
                                   " of a sample of 'Study' has no factor, "
                                   "as a formula for its water or loads "
                                   "has no value there; correct the "
                                   "formula, or the range of what it "
                                   "depends on."));
            now[one.block].least      = one.least_factor;
            now[one.block].is_exposed = !one.is_uncovered;
            if (!one.is_uncovered)
              now[one.block].first = one.statics.limit.factor;
          }
      });
    BlockFactors found{
      std::vector<double>(all.size(), std::numeric_limits<double>::infinity()),
      std::vector<double>(all.size(), std::numeric_limits<double>::infinity()),
      std::vector<unsigned int>(all.size(), 0),
      std::vector<bool>(all.size(), false)};
    for (auto now = factors.begin(); now != factors.end(); ++now)
      {
        const auto next = std::next(now);
        if (!is_wanted(sample,
                       now->first,
                       next == factors.end() ? sample.stages.size() + 2
                                             : next->first))
          continue;
        for (unsigned int b = 0; b < all.size(); ++b)
          {
            const Factors &own = now->second[b];
            found.factor[b]    = std::min(found.factor[b], own.least);
            if (own.is_exposed)
              found.is_exposed[b] = true;
            if (own.first < found.first[b])
              {
                found.first[b] = own.first;
                found.stage[b] = now->first;
              }
          }
      }
    return found;
  }



  template <int dim>
  void
  ProbabilityStudy<dim>::run_sample(const unsigned int index,
                                    BlockFactors &factors) const
  {
    std::vector<std::string> list = overrides_of(index);
    list.insert(list.end(),
                {"Safety factor/Blocks=critical",
                 "Safety factor/Wanted=0",
                 "Safety factor/Wanted by=limit equilibrium",
                 "Safety factor/Rank groups=1",
                 "Output/Write VTU=false",
                 "Output/Checkpoint interval=0"});
    Simulation<dim> simulation(Communicator(MPI_COMM_SELF),
                               scene_file,
                               list,
                               folder + "samples/" + std::to_string(index + 1));
    simulation.be_silent();
    simulation.run();
    // of several stages the least counts
    std::vector<bool> is_new(factors.factor.size(), true);
    const auto offer =
      [&](const unsigned int b, const double value, const std::string &stage) {
        if (is_new[b] || value < factors.first[b])
          {
            factors.factor[b] = factors.first[b] = value;
            factors.stage[b]                     = scene.stage_number(stage);
          }
        is_new[b] = false;
      };
    for (const SafetyFactor &found : simulation.factors())
      {
        using Outcome = SafetyFactor::Outcome;
        // the factor of one that is carried along is its group's
        if (found.outcome == Outcome::carried)
          continue;
        offer(found.block,
              found.outcome == Outcome::by_statics     ? found.limit_factor
              : found.outcome == Outcome::falls_freely ? 0.
              : found.outcome == Outcome::bracketed    ? found.value()
                                                       : found.lower,
              found.stage);
      }
    // all blocks of a group fail with it, those that were not asked for, too
    for (const SafetyFactor &found : simulation.factors())
      for (const unsigned int id : found.group)
        if (id <= is_new.size()) // else the mesh of the run alone has it
          {
            is_new[id - 1] = false;
            offer(id - 1, found.value_of_group(), found.stage);
          }
  }



  template <int dim>
  bool
  ProbabilityStudy<dim>::draws_joints_alone() const
  {
    return std::all_of(scene.study_variables.begin(),
                       scene.study_variables.end(),
                       [](const auto &v) {
                         return v->entry.rfind("Joint sets/", 0) == 0;
                       });
  }



  template <int dim>
  const Scene<dim> &
  ProbabilityStudy<dim>::scene_of(const unsigned int index) const
  {
    const Communicator own(MPI_COMM_SELF);
    if (strengths->are_all())
      {
        strengths->set(index);
        return scene;
      }
    if (sample && draws_joints_alone())
      {
        std::vector<std::string> drawn = overrides_of(index);
        drawn.erase(drawn.begin(), drawn.begin() + overrides.size());
        sample->redraw(own, drawn);
        return *sample;
      }
    sample = std::make_unique<Scene<dim>>();
    sample->read(own, scene_file, overrides_of(index));
    return *sample;
  }



  template <int dim>
  SampleResult
  ProbabilityStudy<dim>::judge(const unsigned int index,
                               const bool may_run) const
  {
    const Scene<dim> &sample = scene_of(index);
    BlockGeometry<dim> own;
    if (!geometry)
      own = make_geometry(sample);
    const BlockGeometry<dim> &g = geometry ? *geometry : own;
    const auto &all             = g.blocks.blocks;

    BlockFactors found = judge_blocks(sample, g);
    // that of the block which goes first: what comes after it falls on nothing
    const auto least = [&]() {
      return std::min_element(found.first.begin(), found.first.end()) -
             found.first.begin();
    };
    SampleResult result;
    result.is_coarse = !g.warnings.empty();
    result.factor    = result.rigid_factor =
      all.empty() ? std::numeric_limits<double>::infinity()
                     : found.first[least()];
    if (may_run && scene.study.level == StudyLevel::full &&
        result.rigid_factor < sample.safety.critical_factor)
      run_sample(index, found);
    if (!all.empty() && std::isfinite(found.first[least()]))
      {
        result.factor = found.first[least()];
        result.block  = all[least()].id;
        result.stage  = found.stage[least()];
      }
    for (unsigned int b = 0; b < all.size(); ++b)
      result.n_exposed += found.is_exposed[b];
    count_failed(g.blocks, found.factor, scene.study.threshold, result);
    result.factors = found.factor;
    if (!geometry)
      result.factors.clear();
    return result;
  }



  template <int dim>
  SampleResult
  ProbabilityStudy<dim>::judge_named(const unsigned int index,
                                     const bool may_run) const
  {
    try
      {
        return judge(index, may_run);
      }
    catch (const InputError &error)
      {
        std::string text =
          "Sample " + std::to_string(index + 1) + " of the study (";
        for (unsigned int v = 0; v < values.size(); ++v)
          text += (v ? ", " : "") + scene.study_variables[v]->name + " = " +
                  text_of(values[v][index]);
        AssertThrow(false,
                    InputError(text + ") cannot be judged: " + error.message));
        throw;
      }
  }

#define INSTANTIATE(dim)                                                       \
  template const Scene<dim> &ProbabilityStudy<dim>::scene_of(                  \
    const unsigned int) const;                                                 \
  template SampleResult ProbabilityStudy<dim>::judge(const unsigned int,       \
                                                     const bool) const;        \
  template SampleResult ProbabilityStudy<dim>::judge_named(const unsigned int, \
                                                           const bool) const;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock
