// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/number_text.h>
#include <keyblock/safety/block_remarks.h>
#include <keyblock/safety/hanging_group.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

namespace Keyblock
{
  namespace
  {
    /** Let a block be judged with others on the same support where they go at
     * less than it would by itself, and say so. */
    template <int dim>
    void
    add_group(const HangingGroup<dim> &group,
              const Blocks<dim> &blocks,
              BlockStatics<dim> &statics,
              std::string &remark)
    {
      if (group.others.empty())
        return;
      std::ostringstream out;
      out.precision(4);
      out << "with block" << (group.others.size() == 1 ? " " : "s ");
      for (const unsigned int b : group.others)
        out << (b == group.others.front() ? "" : ", ") << blocks.blocks[b].id;
      if (group.is_by_bolts)
        out << ", tied to it by bolts"
            << (group.is_by_shotcrete ? " and shotcrete; " : "; ");
      else
        out << ", which " << (group.others.size() == 1 ? "hangs" : "hang")
            << " on the same shotcrete; ";
      if (std::isfinite(statics.limit.factor))
        out << statics.limit.factor << " by itself";
      else
        out << "stable by itself";
      remark = out.str();
      if (!group.is_by_bolts || group.limit.factor < 1.)
        statics.alone = group.limit;
      statics.limit  = group.limit;
      statics.others = group.others;
    }



    /** What is said of a block that turns at a lower factor than it slides. */
    std::string
    remark_on_moments(const bool has_passive_bolts,
                      const double factor,
                      const double factor_of_sliding)
    {
      std::ostringstream out;
      out.precision(4);
      if (has_passive_bolts)
        out << "passive bolts, divided by more, cannot";
      else if (factor > 0.)
        out << "its faces, with less strength, cannot";
      else
        out << "its faces, however strong, cannot";
      out << " balance the moment of what acts; ";
      if (std::isfinite(factor_of_sliding))
        out << "sliding alone " << factor_of_sliding;
      else
        out << "stable by forces alone";
      return out.str();
    }



    /** The motion of a block by itself with its seismic load times @p times. */
    template <int dim>
    SupportedMotion<dim>
    find_motion_shaken(BlockSurroundings<dim> around,
                       BlockSupport<dim> support,
                       const bool is_passive,
                       const double times)
    {
      // shotcrete is shaken as the block is
      const double size = (around.loads.weight + around.loads.seismic).norm();
      around.loads.seismic *= times;
      if (size > 0.)
        support.shotcrete_load = support.shotcrete_load.norm() / size *
                                 (around.loads.weight + around.loads.seismic);
      return find_motion<dim>(around, support, is_passive);
    }

    /** That the seismic coefficient raises the factor of a block, as one that
     * points into the slope does, or empty. */
    template <int dim>
    std::string
    remark_on_seismic(const BlockStatics<dim> &statics,
                      const bool is_passive,
                      const double factor)
    {
      constexpr double least = 1.001; // rise of the factor that is told [-]
      if (statics.around.loads.seismic.norm() == 0.)
        return "";
      const auto factor_for = [&](const double times) {
        return find_motion_shaken(statics.around,
                                  statics.support,
                                  is_passive,
                                  times)
          .limit.factor;
      };
      const double at_rest = factor_for(0.);
      if (!(factor > least * at_rest))
        return "";
      const auto text_for = [](const double value) {
        return std::isfinite(value) ? text_of(value, 4)
                                    : std::string("above all");
      };
      return "the seismic coefficient raises the factor from " +
             text_for(at_rest) + " to " + text_for(factor) +
             ": try the other sign, too, with which it is " +
             text_for(factor_for(-1.));
    }

    template <int dim>
    BlockFacts
    find_facts(const Scene<dim> &scene, const BlockStatics<dim> &statics)
    {
      const std::vector<BlockFace<dim>> &faces = statics.around.faces;
      BlockFacts facts;
      facts.loses_friction = statics.around.loses_friction();
      facts.bears_tension =
        std::any_of(faces.begin(), faces.end(), [](const auto &face) {
          return face.tensile_strength > 0.;
        });
      facts.is_complete = !has_initial_stress(scene) && !facts.loses_friction &&
                          !statics.support.acts();
      return facts;
    }
  } // namespace



  template <int dim>
  BlockStatics<dim>
  judge_block(const Ground<dim> &ground,
              const FreeFaces<dim> &free,
              const Blocks<dim> &blocks,
              const unsigned int block,
              const double time,
              const BrokenSegments &broken)
  {
    BlockStatics<dim> statics;
    statics.around  = look_around(ground, free, blocks.blocks[block], time);
    statics.support = find_support_of_block(ground, block, time, broken);
    const bool is_passive =
      ground.scene.safety.bolt_convention == BoltConvention::passive;
    SupportedMotion<dim> motion =
      find_motion<dim>(statics.around, statics.support, is_passive);
    statics.facts = find_facts(ground.scene, statics);
    statics.limit = statics.alone = motion.limit;
    const std::string seismic_remark =
      remark_on_seismic(statics, is_passive, motion.limit.factor);
    if (const double wanted = ground.scene.safety.wanted; wanted > 0.)
      statics.demand = find_unshared_demand(
        ground, free, blocks, block, time, wanted, statics);
    std::string group_remark;
    add_group(
      find_hanging_group(ground, free, blocks, block, time, broken, statics),
      blocks,
      statics,
      group_remark);
    add_remarks<dim>(ground, free, blocks, block, time, motion, statics);
    if (motion.rotation.is_by_moments)
      statics.remarks.push_back(
        remark_on_moments(is_passive && !statics.support.pulls.empty(),
                          motion.limit.factor,
                          motion.factor_of_sliding));
    if (!seismic_remark.empty())
      statics.remarks.insert(statics.remarks.begin(), seismic_remark);
    if (!group_remark.empty())
      statics.remarks.insert(statics.remarks.begin(), group_remark);
    return statics;
  }



  template <int dim>
  bool
  has_initial_stress(const Scene<dim> &scene)
  {
    return !scene.initial_state.stress.empty() ||
           scene.initial_state.has_depth_stress() ||
           !scene.initial_state.measured_points.empty();
  }

  template BlockStatics<2> judge_block(const Ground<2> &,
                                       const FreeFaces<2> &,
                                       const Blocks<2> &,
                                       const unsigned int,
                                       const double,
                                       const BrokenSegments &);
  template BlockStatics<3> judge_block(const Ground<3> &,
                                       const FreeFaces<3> &,
                                       const Blocks<3> &,
                                       const unsigned int,
                                       const double,
                                       const BrokenSegments &);
  template bool has_initial_stress(const Scene<2> &);
  template bool has_initial_stress(const Scene<3> &);
} // namespace Keyblock
