// SPDX-License-Identifier: LGPL-2.1-or-later
// What the search for a factor does once for a block: cheap answers, and the
// rock that its trials need not move.
#include <keyblock/safety/block_cascade.h>
#include <keyblock/safety/safety_factor.h>
#include <keyblock/safety/standing_block.h>
#include <keyblock/safety/stress_ratio.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <set>
#include <sstream>

namespace Keyblock
{
  namespace
  {
    /** judge_block() in the present state of a run. */
    template <int dim>
    BlockStatics<dim>
    judge_now(const Blocks<dim> &blocks,
              const unsigned int block,
              const RunParts<dim> &run)
    {
      const Ground<dim> ground = run.conditions.active_cells.ground().rigid();
      return judge_block<dim>(ground,
                              FreeFaces<dim>(ground),
                              blocks,
                              block,
                              run.step.time,
                              run.conditions.broken_segments());
    }



    /** Say on how much of the faces cohesion counts which the run has lost,
     * and how much friction, and the factor with what is left at least.
     * @param losses ContactReport::lost_strength() */
    template <int dim>
    void
    remark_on_lost_strength(const Scene<dim> &scene,
                            const std::vector<StrengthLoss> &losses,
                            BlockStatics<dim> &statics)
    {
      constexpr double least = 1e-6; // of what the face has
      const auto degrees     = [](const double tangent) {
        return std::atan(tangent) * 180. / dealii::numbers::PI;
      };
      BlockSurroundings<dim> weakened = statics.around;
      std::ostringstream text;
      text << std::setprecision(4);
      for (const unsigned int i : statics.limit.faces)
        {
          BlockFace<dim> &face = weakened.faces[i];
          if (face.joint == none)
            continue;
          const StrengthLoss &loss = losses[face.joint];
          if (loss.area > 0.)
            text << (text.tellp() > 0 ? ", " : "") << "cohesion of "
                 << face.name << " counted on " << loss.area
                 << (dim == 2 ? " m" : " m2") << " that have lost it";
          const double tangent =
            std::max(0., face.tangent_friction - loss.tangent);
          if (tangent < (1. - least) * face.tangent_friction)
            text << (text.tellp() > 0 ? ", " : "") << "friction of "
                 << face.name << " counted with "
                 << degrees(face.tangent_friction) << " degrees, of which "
                 << degrees(tangent) << " are left";
          face.tangent_friction = tangent;
          face.cohesion =
            std::max(0., face.cohesion - loss.cohesion / face.area);
        }
      if (text.tellp() == 0)
        return;
      const bool is_passive =
        scene.safety.bolt_convention == BoltConvention::passive;
      text
        << "; "
        << find_motion<dim>(weakened, statics.support, is_passive).limit.factor
        << " without that";
      statics.remarks.push_back(text.str());
    }
  } // namespace



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
          // by limit equilibrium the block may hold there, too
          return above.str() + (std::isfinite(factor.limit_factor) &&
                                    factor.limit_factor >= factor.lower
                                  ? ""
                                  : ", held by " + factor.held_by);
        case SafetyFactor::Outcome::undecided:
          return "undecided";
        case SafetyFactor::Outcome::met:
          return above.str() + ", as wanted";
        case SafetyFactor::Outcome::by_statics:
          return "limit equilibrium";
        case SafetyFactor::Outcome::carried:
          return "carried along";
      }
    return "";
  }



  template <int dim>
  std::vector<unsigned int>
  StrengthReductionSearch<dim>::ids_of(const TriedBlocks &group) const
  {
    std::vector<unsigned int> ids;
    for (const unsigned int b : group.all())
      ids.push_back(blocks.blocks[b].id);
    std::sort(ids.begin(), ids.end());
    return ids;
  }



  template <int dim>
  std::vector<unsigned int>
  StrengthReductionSearch<dim>::blocks_pressed_on(
    const TriedBlocks &group) const
  {
    std::set<unsigned int> pressed;
    for (const unsigned int b : group.all())
      for (const unsigned int other :
           run.contact->report().list_blocks_pressed_on(b))
        if (!blocks.blocks[other].is_infinite && !group.contains(other))
          pressed.insert(other);
    return {pressed.begin(), pressed.end()};
  }



  /** judge_exposed_blocks(), and of what state. */
  template <int dim>
  struct StrengthReductionSearch<dim>::Judgement
  {
    unsigned int stage_number;
    double time;
    std::vector<bool> is_removed;
    BrokenSegments broken;
    /** Those in `noted` (by index) with the remark of what leans on them. */
    mutable std::vector<JudgedBlock<dim>> blocks;
    mutable std::set<unsigned int> noted;

    bool
    is_of_same_state(const Judgement &other) const
    {
      return stage_number == other.stage_number && time == other.time &&
             is_removed == other.is_removed && broken == other.broken;
    }
  };



  template <int dim>
  JudgedBlock<dim>
  StrengthReductionSearch<dim>::judge_among_others(
    const unsigned int block) const
  {
    const Ground<dim> ground = run.conditions.active_cells.ground().rigid();
    const FreeFaces<dim> free(ground);
    Judgement now{ground.stage_number,
                  run.step.time,
                  removed_from(ground, blocks.blocks.size()),
                  run.conditions.broken_segments(),
                  {},
                  {}};
    if (!judgement || !judgement->is_of_same_state(now))
      {
        now.blocks =
          judge_exposed_blocks<dim>(ground, free, blocks, now.time, now.broken);
        judgement = std::make_shared<const Judgement>(now);
      }
    for (JudgedBlock<dim> &one : judgement->blocks)
      if (one.block == block)
        {
          if (judgement->noted.insert(block).second)
            note_leaning_blocks(ground,
                                free,
                                blocks,
                                now.time,
                                scene.safety.wanted,
                                judgement->blocks,
                                one);
          return one;
        }
    return {block, judge_now(blocks, block, run), 0., {}};
  }



  template <int dim>
  void
  StrengthReductionSearch<dim>::add_cheap_answers(const unsigned int block,
                                                  SafetyFactor &result) const
  {
    JudgedBlock<dim> judged    = judge_among_others(block);
    BlockStatics<dim> &statics = judged.statics;
    result.limit_once_gone     = judged.once_gone;
    if (const double way = trials.measures.way_from_place(block); way > 0.)
      {
        std::ostringstream text;
        text << "judged where it was before it moved by "
             << std::setprecision(3) << way << " m";
        statics.remarks.push_back(text.str());
      }
    remark_on_lost_strength(scene,
                            run.contact->report().lost_strength(block),
                            statics);
    result.limit_mode     = statics.limit.block_mode(statics.around.faces);
    result.facts          = statics.facts;
    result.limit_remark   = statics.remark();
    result.limit_factor   = statics.limit.factor;
    result.limit_alone    = statics.alone.factor;
    result.limit_moves    = statics.alone.direction.norm() > 0.;
    result.support_demand = statics.demand;
    result.stress_ratio =
      stress_ratio<dim>(statics.around.faces,
                        statics.limit,
                        run.contact->report().sum_over_block(block));
  }



  template <int dim>
  BlockMode
  StrengthReductionSearch<dim>::mode_if_not_held(const unsigned int block) const
  {
    const BlockStatics<dim> statics          = judge_now(blocks, block, run);
    const std::vector<BlockFace<dim>> &faces = statics.around.faces;
    const std::set<unsigned int> pressed =
      statics.limit.pressed_faces(faces, statics.around.loads.without_water());
    BlockMode mode;
    mode.motion = "falling";
    if (pressed.empty() ||
        is_seated(faces, pressed, statics.around.loads.all()))
      return mode;
    mode.motion = "rotating";
    for (const unsigned int i : pressed)
      mode.add_joint(faces[i].name);
    std::sort(mode.joints.begin(), mode.joints.end());
    return mode;
  }



  template <int dim>
  Tensor<1, dim>
  StrengthReductionSearch<dim>::tell_ways(const TriedBlocks &tried)
  {
    const Ground<dim> ground = run.conditions.active_cells.ground();
    const FreeFaces<dim> free(ground);
    const std::vector<Tensor<1, dim>> ways =
      find_ways_without_support(ground,
                                free,
                                blocks,
                                trials.measures.tied.mark_neighbors(tried),
                                run.step.time);
    run.conditions.take_ways(ways);
    return ways[tried.block];
  }



  template <int dim>
  TriedBlocks
  StrengthReductionSearch<dim>::with_row(const TriedBlocks &tried) const
  {
    TriedBlocks found                 = tried;
    const std::vector<bool> is_guided = trials.measures.guided_blocks();
    const Ground<dim> ground = run.conditions.active_cells.ground().rigid();
    std::vector<bool> is_gone(blocks.blocks.size(), false);
    if (ground.is_removed && !ground.is_removed->empty())
      is_gone = *ground.is_removed;
    const Ground<dim> later{ground.scene,
                            ground.split,
                            ground.stage_number,
                            &is_gone};
    const BrokenSegments broken = run.conditions.broken_segments();
    found.row.clear();
    for (std::vector<unsigned int> going = tried.all(); !going.empty();)
      {
        TriedBlocks gone;
        gone.block = going.back();
        gone.companions.assign(going.begin(), going.end() - 1);
        for (const unsigned int b : going)
          is_gone[b] = true;
        const FreeFaces<dim> free(later);
        going.clear();
        // others stand as they did
        for (const unsigned int other : blocks_pressed_on(gone))
          if (!is_gone[other] && !is_guided[other] &&
              (trials.measures.way_from_place(other) > 0. ||
               !stands_alone<dim>(
                 later, free, blocks, other, run.step.time, broken)))
            going.push_back(other);
        found.row.insert(found.row.end(), going.begin(), going.end());
      }
    return found;
  }



  template <int dim>
  bool
  StrengthReductionSearch<dim>::freeze_beyond_reach(const TriedBlocks &tried)
  {
    const SafetySettings &settings = scene.safety;
    if (settings.reach == 0. || settings.reduced_joints == ReducedJoints::all ||
        settings.reduces_rock)
      return false;
    const std::vector<unsigned int> moving = tried.all();
    std::vector<bool> is_moving(blocks.blocks.size(), false);
    for (const std::vector<unsigned int> &list : {moving, tried.row})
      for (const unsigned int b : list)
        is_moving[b] = true;
    std::vector<bool> is_frozen(split.mesh.n_cells());
    for (unsigned int c = 0; c < split.mesh.n_cells(); ++c)
      is_frozen[c] =
        (split.block_of_cell[c] == none ||
         !is_moving[split.block_of_cell[c]]) &&
        std::none_of(moving.begin(), moving.end(), [&](const unsigned int m) {
          const Block<dim> &b = blocks.blocks[m];
          return split.mesh.cell_center(c).distance(b.centroid) <=
                 (0.5 + settings.reach) * b.size;
        });
    run.conditions.freeze(is_frozen);
    return true;
  }

  template bool
  StrengthReductionSearch<2>::freeze_beyond_reach(const TriedBlocks &);
  template bool
  StrengthReductionSearch<3>::freeze_beyond_reach(const TriedBlocks &);
  template TriedBlocks
  StrengthReductionSearch<2>::with_row(const TriedBlocks &) const;
  template BlockMode
  StrengthReductionSearch<2>::mode_if_not_held(const unsigned int) const;
  template BlockMode
  StrengthReductionSearch<3>::mode_if_not_held(const unsigned int) const;
  template Tensor<1, 2>
  StrengthReductionSearch<2>::tell_ways(const TriedBlocks &);
  template TriedBlocks
  StrengthReductionSearch<3>::with_row(const TriedBlocks &) const;
  template Tensor<1, 3>
  StrengthReductionSearch<3>::tell_ways(const TriedBlocks &);
  template JudgedBlock<2>
  StrengthReductionSearch<2>::judge_among_others(const unsigned int) const;
  template JudgedBlock<3>
  StrengthReductionSearch<3>::judge_among_others(const unsigned int) const;
  template std::vector<unsigned int>
  StrengthReductionSearch<2>::ids_of(const TriedBlocks &) const;
  template std::vector<unsigned int>
  StrengthReductionSearch<2>::blocks_pressed_on(const TriedBlocks &) const;
  template void
  StrengthReductionSearch<2>::add_cheap_answers(const unsigned int,
                                                SafetyFactor &) const;
  template std::vector<unsigned int>
  StrengthReductionSearch<3>::ids_of(const TriedBlocks &) const;
  template std::vector<unsigned int>
  StrengthReductionSearch<3>::blocks_pressed_on(const TriedBlocks &) const;
  template void
  StrengthReductionSearch<3>::add_cheap_answers(const unsigned int,
                                                SafetyFactor &) const;
} // namespace Keyblock
