// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/safety/block_remarks.h>
#include <keyblock/safety/hanging_group.h>
#include <keyblock/safety/kinetic_friction.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace Keyblock
{
  namespace
  {
    /** Let a block be judged with others on the same shotcrete where they go at
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
      out << ", which " << (group.others.size() == 1 ? "hangs" : "hang")
          << " on the same shotcrete; ";
      if (std::isfinite(statics.limit.factor))
        out << statics.limit.factor << " by itself";
      else
        out << "stable by itself";
      remark        = out.str();
      statics.limit = group.limit;
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
    const SupportedMotion<dim> motion =
      find_motion<dim>(statics.around, statics.support, is_passive);
    statics.limit = motion.limit;
    if (const double wanted = ground.scene.safety.wanted; wanted > 0.)
      statics.demand = find_unshared_demand(
        ground, free, blocks, block, time, wanted, statics);
    std::string group_remark;
    add_group(
      find_hanging_group(ground, free, blocks, block, time, broken, statics),
      blocks,
      statics,
      group_remark);
    const auto is_lost = [](const auto &face) { return face.is_lost; };
    const auto &all    = statics.around.faces;
    std::optional<SupportedMotion<dim>> without_lost_faces;
    if (std::any_of(all.begin(), all.end(), is_lost))
      {
        BlockSurroundings<dim> in_mesh = statics.around;
        auto &faces                    = in_mesh.faces;
        faces.erase(std::remove_if(faces.begin(), faces.end(), is_lost),
                    faces.end());
        without_lost_faces =
          find_motion<dim>(in_mesh, statics.support, is_passive);
      }
    add_remarks<dim>(
      ground, free, blocks, block, time, motion, without_lost_faces, statics);
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



  template <int dim>
  bool
  is_known_to_statics(const Scene<dim> &scene)
  {
    return !has_initial_stress(scene) && !has_kinetic_friction(scene) &&
           scene.bolts.empty() && scene.liners.empty();
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
  template bool is_known_to_statics(const Scene<2> &);
  template bool is_known_to_statics(const Scene<3> &);
} // namespace Keyblock
