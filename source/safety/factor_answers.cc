// SPDX-License-Identifier: LGPL-2.1-or-later
// What the record of a factor says besides its bracket.
#include <keyblock/safety/block_statics.h>
#include <keyblock/safety/safety_factor.h>

#include <algorithm>
#include <sstream>

namespace Keyblock
{
  std::string
  describe_outcome(const SafetyFactor &factor)
  {
    std::ostringstream above;
    above << "above " << factor.lower;
    switch (factor.outcome)
      {
        case SafetyFactor::Outcome::bracketed:
          return "value";
        case SafetyFactor::Outcome::falls_freely:
          return "falls freely";
        case SafetyFactor::Outcome::immovable:
          return "immovable";
        case SafetyFactor::Outcome::clamped:
          return above.str() + (factor.limit_factor < factor.lower
                                  ? ", held by clamping"
                                  : "");
        case SafetyFactor::Outcome::undecided:
          return "undecided";
      }
    return "";
  }



  template <int dim>
  std::vector<unsigned int>
  StrengthReductionSearch<dim>::ids_of_group(const unsigned int block) const
  {
    std::vector<unsigned int> ids = {blocks.blocks[block].id};
    for (const unsigned int b : trials.companions)
      ids.push_back(blocks.blocks[b].id);
    std::sort(ids.begin(), ids.end());
    return ids;
  }



  template <int dim>
  void
  StrengthReductionSearch<dim>::add_cheap_answers(const unsigned int block,
                                                  SafetyFactor &result) const
  {
    const Ground<dim> ground        = run.conditions.active_cells.ground();
    const BlockStatics<dim> statics = judge_block<dim>(
      ground, FreeFaces<dim>(ground), blocks, block, run.step.time);
    result.limit_mode   = statics.mode();
    result.limit_remark = statics.remark();
    result.limit_factor = statics.limit.factor;
    result.stress_ratio =
      stress_ratio<dim>(scene,
                        statics.around.faces,
                        statics.limit.faces,
                        run.contact->report().sum_over_block(block));
  }

  template std::vector<unsigned int>
  StrengthReductionSearch<2>::ids_of_group(const unsigned int) const;
  template void
  StrengthReductionSearch<2>::add_cheap_answers(const unsigned int,
                                                SafetyFactor &) const;
  template std::vector<unsigned int>
  StrengthReductionSearch<3>::ids_of_group(const unsigned int) const;
  template void
  StrengthReductionSearch<3>::add_cheap_answers(const unsigned int,
                                                SafetyFactor &) const;
} // namespace Keyblock
