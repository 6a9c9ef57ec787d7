// SPDX-License-Identifier: LGPL-2.1-or-later
// What a study of safety factors asks limit equilibrium for.
#include <keyblock/run/safety_study.h>
#include <keyblock/safety/block_cascade.h>

#include <algorithm>

namespace Keyblock
{
  template <int dim>
  std::vector<unsigned int>
  SafetyStudy<dim>::select_critical(
    const std::vector<unsigned int> &blocks) const
  {
    if (!model.scene.safety.wants_critical_only() || blocks.empty())
      return blocks;
    const std::vector<bool> is_removed = record.present.removed_before();
    const Ground<dim> ground{model.scene,
                             model.split.rigid(),
                             record.present.number(),
                             &is_removed};
    const FreeFaces<dim> free(ground);
    const BrokenSegments broken = model.conditions->broken_segments();
    const auto judged           = judge_exposed_blocks(ground,
                                             free,
                                             model.blocks,
                                             model.step->time,
                                             broken,
                                             record.present.removed_since());
    std::vector<unsigned int> critical;
    for (const unsigned int b : blocks)
      {
        const auto known =
          std::find_if(judged.begin(), judged.end(), [b](const auto &one) {
            return one.block == b;
          });
        const double factor =
          known != judged.end()
            ? known->least_factor
            : judge_block(
                ground, free, model.blocks, b, model.step->time, broken)
                .limit.factor;
        if (factor < model.scene.safety.critical_factor)
          critical.push_back(b);
      }
    return critical;
  }



  template <int dim>
  std::vector<SafetyFactor>
  SafetyStudy<dim>::judge_by_statics() const
  {
    const std::vector<bool> is_removed = record.present.removed_before();
    const Ground<dim> ground{model.scene,
                             model.split.rigid(),
                             record.present.number(),
                             &is_removed};
    const double time = model.step->time;
    const FreeFaces<dim> free(ground);
    std::vector<SafetyFactor> factors;
    for (const JudgedBlock<dim> &one :
         judge_leaning_blocks(ground,
                              free,
                              model.blocks,
                              time,
                              model.scene.safety.wanted,
                              record.present.removed_since()))
      {
        SafetyFactor factor;
        factor.block   = one.block;
        factor.stage   = model.scene.stages[record.present.index]->name;
        factor.outcome = SafetyFactor::Outcome::by_statics;
        factor.limit_mode =
          one.statics.limit.block_mode(one.statics.around.faces);
        factor.facts           = one.statics.facts;
        factor.limit_remark    = one.statics.remark();
        factor.limit_factor    = one.statics.limit.factor;
        factor.limit_once_gone = one.once_gone;
        factor.support_demand  = one.statics.demand;
        factors.push_back(factor);
      }
    return factors;
  }

#define INSTANTIATE(dim)                                                       \
  template std::vector<unsigned int> SafetyStudy<dim>::select_critical(        \
    const std::vector<unsigned int> &) const;                                  \
  template std::vector<SafetyFactor> SafetyStudy<dim>::judge_by_statics() const;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock
