// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/run/factor_progress.h>
#include <keyblock/run/safety_study.h>
#include <keyblock/run/wanted_blocks.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace Keyblock
{
  template <int dim>
  SafetyStudy<dim>::SafetyStudy(Model<dim> &model,
                                FiniteCheck<dim> &finite_check,
                                Checkpointing<dim> &checkpointing,
                                RunRecord<dim> &record)
    : model(model)
    , finite_check(finite_check)
    , checkpointing(checkpointing)
    , record(record)
  {
    check_wanted_blocks(model.scene.safety.blocks, model.blocks);
  }



  template <int dim>
  bool
  SafetyStudy<dim>::is_uncovered(const unsigned int block) const
  {
    const SplitMesh<dim> &split = model.split;
    const auto has_gone         = [&](const unsigned int b) {
      return b != none && b != block && record.present.removal_stage[b] > 0;
    };
    return std::any_of(split.interface.joint_faces.begin(),
                       split.interface.joint_faces.end(),
                       [&](const JointFace &face) {
                         const unsigned int minus =
                           split.block_of_cell[face.minus_cell];
                         const unsigned int plus =
                           split.block_of_cell[face.plus_cell];
                         return (minus == block && has_gone(plus)) ||
                                (plus == block && has_gone(minus));
                       });
  }



  template <int dim>
  bool
  SafetyStudy<dim>::is_class_wanted(const unsigned int block) const
  {
    const Block<dim> &b = model.blocks.blocks[block];
    if (!model.scene.safety.wants_block(b.id) || b.is_infinite || b.is_rigid ||
        (b.n_cells == 0 && !model.scene.safety.is_by_statics()) ||
        model.blocks.is_unlike(block))
      return false;
    const BlockClass now =
      b.class_of_stage[std::min<std::size_t>(record.present.number(),
                                             b.class_of_stage.size() - 1)];
    // (limit equilibrium lists by itself what others uncover that fail)
    return now == BlockClass::exposed ||
           (now == BlockClass::hidden &&
            (!model.scene.safety.wants_exposed_only() ||
             model.scene.safety.is_by_statics() || is_uncovered(block)));
  }



  template <int dim>
  std::vector<unsigned int>
  SafetyStudy<dim>::list_wanted_blocks() const
  {
    std::vector<unsigned int> wanted;
    for (unsigned int b = 0; b < model.blocks.blocks.size(); ++b)
      {
        const bool is_known =
          std::any_of(record.safety_factors.begin(),
                      record.safety_factors.end(),
                      [&](const SafetyFactor &factor) {
                        return factor.block == b &&
                               factor.stage ==
                                 model.scene.stages[record.present.index]->name;
                      });
        if (is_class_wanted(b) && !is_known &&
            (record.present.removal_stage[b] == 0 ||
             record.present.removal_stage[b] >= record.present.number()))
          wanted.push_back(b);
      }
    return select_critical(wanted);
  }



  template <int dim>
  std::vector<unsigned int>
  SafetyStudy<dim>::list_blocks_of_rank_group(const RankGroups &groups) const
  {
    // a block costs what it did last time; one never tried, as much as any
    const std::vector<unsigned int> wanted = list_wanted_blocks();
    std::map<unsigned int, double> steps;
    double most = 1.;
    for (const SafetyFactor &earlier : record.safety_factors)
      {
        double &sum = steps[earlier.block];
        sum         = 0.;
        for (const auto &trials : {earlier.trials, earlier.tried_demand.trials})
          for (const Trial &trial : trials)
            sum += trial.n_steps;
        most = std::max(most, sum);
      }
    std::vector<double> costs;
    costs.reserve(wanted.size());
    for (const unsigned int b : wanted)
      // the stage is run again for one that failed in it
      costs.push_back(
        (steps.count(b) > 0 ? steps[b] : most) +
        (record.present.removal_stage[b] == record.present.number()
           ? record.present.n_done
           : 0));

    const std::vector<unsigned int> group = share_out(costs, groups.n());
    std::vector<unsigned int> mine;
    for (unsigned int i = 0; i < wanted.size(); ++i)
      if (group[i] == groups.index())
        mine.push_back(wanted[i]);
    return mine;
  }



  template <int dim>
  SafetyFactor
  SafetyStudy<dim>::factor_of_standing_block(
    StrengthReductionSearch<dim> &search,
    const unsigned int block)
  {
    const Stage &stage = *model.scene.stages[record.present.index];
    typename StrengthReductionSearch<dim>::Known known;
    for (const SafetyFactor &earlier : record.safety_factors)
      if (earlier.block == block)
        known.hint = earlier.outcome == SafetyFactor::Outcome::bracketed
                       ? earlier.value()
                       : 0.;
    // balance tells of strength where joints are neither tied nor overridden
    const StageReport &report = record.stage_reports.back();
    if (!stage.is_static() && stage.friction_angle_override < 0. &&
        report.is_converged && report.unbalanced_ratio < stage.unbalanced_ratio)
      known.stable = 1.;
    SafetyFactor cheap;
    search.add_cheap_answers(block, cheap);
    if (known.stable > 0.)
      known.onset = cheap.stress_ratio;
    if (std::isfinite(cheap.limit_alone))
      known.limit = cheap.limit_alone;
    if (known.hint == 0.)
      known.hint =
        known.limit > 0. && known.onset > 1. ? known.onset : known.limit;
    // only rest at the joints' own strength is a start at factor 1
    if (known.stable == 0.)
      known.start = std::max(model.scene.safety.lowest, 0.5 * known.hint);
    SafetyFactor result = search.find(block, record.present.number(), known);
    search.add_demand(record.present.number(), known, result);
    return result;
  }



  template <int dim>
  SafetyFactor
  SafetyStudy<dim>::find_factor(StrengthReductionSearch<dim> &search,
                                const unsigned int block)
  {
    SafetyFactor result =
      record.present.removal_stage[block] == record.present.number()
        ? factor_of_failed_block(search, block)
        : factor_of_standing_block(search, block);
    result.stage = model.scene.stages[record.present.index]->name;
    return result;
  }



  template <int dim>
  unsigned int
  SafetyStudy<dim>::find_block(const unsigned int id) const
  {
    const auto &blocks       = model.blocks.blocks;
    const std::string number = std::to_string(id);
    AssertThrow(model.contact != nullptr,
                InputError("Block " + number +
                           " has no safety factor, because 'Contact/Method' is "
                           "none; let joints have contact."));
    unsigned int b = 0;
    while (b < blocks.size() && blocks[b].id != id)
      ++b;
    AssertThrow(b < blocks.size(),
                InputError("There is no block " + number +
                           " whose factor could be found; the ids of blocks "
                           "are 1 to " +
                           std::to_string(blocks.size()) + "."));
    AssertThrow(!blocks[b].is_infinite && !blocks[b].is_rigid,
                InputError("Block " + number + " is " +
                           (blocks[b].is_rigid ? "rigid" : "infinite") +
                           " and has no safety factor; ask for that of a "
                           "finite block."));
    const unsigned int removal = record.present.removal_stage[b];
    AssertThrow(removal == 0 || removal >= record.present.number(),
                InputError("Block " + number +
                           " failed in an earlier stage and was taken away; "
                           "ask for its factor after that stage."));
    AssertThrow(removal == 0 || !record.before.fields.mass.empty(),
                InputError("The factor of block " + number +
                           ", which failed in this stage, needs the state "
                           "before it, which is not in the checkpoint; begin "
                           "the run anew."));
    return b;
  }



  template <int dim>
  SafetyFactor
  SafetyStudy<dim>::find_factor_of(const unsigned int id)
  {
    const unsigned int b = find_block(id);
    if (model.scene.safety.is_by_statics())
      {
        for (const SafetyFactor &factor : judge_by_statics())
          if (factor.block == b)
            return factor;
        AssertThrow(false,
                    InputError("Block " + std::to_string(id) +
                               " has no free face after this stage, so that "
                               "limit equilibrium says nothing of it; ask for "
                               "it after a stage that exposes it."));
      }
    const Snapshot<dim> after = take_snapshot(model.parts());
    StrengthReductionSearch<dim> search(
      model.scene, model.split, model.blocks, *model.numbering, model.parts());
    SafetyFactor result;
    try
      {
        result = find_factor(search, b);
      }
    catch (const StopRequest &)
      {
        // all ranks are stopped together, as recall() asks for
        recall(after, model.parts());
        throw;
      }
    recall(after, model.parts());
    finite_check.check_factor(result);
    model.count_cells();
    return result;
  }



  template <int dim>
  void
  SafetyStudy<dim>::record_factor(const SafetyFactor &factor,
                                  const bool is_printed)
  {
    record.safety_factors.push_back(factor);
    const std::vector<unsigned int> told =
      share_last_group(model.blocks, record.safety_factors);
    if (is_printed || !model.out.is_active())
      return;
    std::ostream &out = model.out.get_stream();
    print_factor(out, record.safety_factors.back(), model.blocks, model.scene);
    if (factor.tried_demand.outcome == TriedDemand::Outcome::bracketed &&
        model.scene.safety.bolt_convention == BoltConvention::passive)
      out << "        the pressure by trials is active, strength alone divided "
             "by the factor; that by limit equilibrium, passive, is divided, "
             "too"
          << std::endl;
    for (const unsigned int i : told)
      print_group(out, record.safety_factors[i], model.blocks, model.scene);
  }



  template <int dim>
  void
  SafetyStudy<dim>::find_remaining_factors(const RankGroups &groups)
  {
    if (model.scene.safety.is_by_statics())
      {
        const std::vector<unsigned int> wanted = list_wanted_blocks();
        for (const SafetyFactor &factor : judge_by_statics())
          if (std::count(wanted.begin(), wanted.end(), factor.block) > 0)
            record_factor(factor, false);
        return;
      }
    const Snapshot<dim> after = take_snapshot(model.parts());
    StrengthReductionSearch<dim> search(
      model.scene, model.split, model.blocks, *model.numbering, model.parts());
    try
      {
        const std::vector<unsigned int> mine =
          list_blocks_of_rank_group(groups);
        FactorProgress progress(model.out, mine.size());
        search.watcher = [&](const SearchAdvance &now) { progress.show(now); };
        for (const unsigned int b : mine)
          {
            progress.begin_block(model.blocks.blocks[b].id);
            const SafetyFactor result = find_factor(search, b);
            recall(after, model.parts());
            finite_check.check_factor(result);
            progress.clear();
            record_factor(result, false);
            model.count_cells();
            checkpointing.save_if_due();
          }
      }
    catch (const StopRequest &)
      {
        // what is saved is the end of the stage, and the factors found; all
        // ranks are stopped together, as recall() asks for
        recall(after, model.parts());
        throw;
      }
  }



  template class SafetyStudy<2>;
  template class SafetyStudy<3>;
} // namespace Keyblock
