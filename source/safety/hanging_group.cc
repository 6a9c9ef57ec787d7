// SPDX-License-Identifier: LGPL-2.1-or-later
// Blocks that hang on the same shotcrete, or on bolts between them.
#include <keyblock/safety/hanging_group.h>
#include <keyblock/safety/joined_blocks.h>
#include <keyblock/safety/tied_blocks.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace Keyblock
{
  namespace
  {
    /** Halvings of the share of a demand. */
    constexpr unsigned int n_share_steps = 50;

    /** Factor of a block with @p around without any support. */
    template <int dim>
    double
    bare_factor(BlockSurroundings<dim> around)
    {
      return solve_with_laws<dim>(around.faces, around.loads.without_water())
        .factor;
    }

    /** Add to @p members, the first of which is there, one block after the
     * other that the same shotcrete is sprayed on and that would move without
     * support at less than @p factor, which @p visit, called after each, may
     * lower. */
    template <int dim, typename Visit>
    void
    add_neighbors(const Ground<dim> &ground,
                  const FreeFaces<dim> &free,
                  const Blocks<dim> &blocks,
                  const double time,
                  const BrokenSegments &broken,
                  const double &factor,
                  std::vector<JoinedBlock<dim>> &members,
                  const Visit &visit)
    {
      std::set<unsigned int> seen{members[0].block};
      for (unsigned int m = 0; m < members.size(); ++m)
        {
          const auto sections      = members[m].support.sections;
          const unsigned int on_it = members[m].block;
          for (const auto &section : sections)
            if (const unsigned int b =
                  section.trace.block[section.trace.block[0] == on_it];
                can_hang(blocks, b) && members.size() < most_joined_blocks &&
                seen.insert(b).second)
              {
                const auto around =
                  look_around(ground, free, blocks.blocks[b], time);
                if (!(bare_factor(around) < factor))
                  continue;
                members.push_back(
                  {b, around, find_support_of_block(ground, b, time, broken)});
                visit();
              }
        }
    }

    /** What @p factor asks for of a block, but for the shotcrete on traces
     * whose other side is a block that moves without support at less than that
     * factor. */
    template <int dim>
    SupportDemand
    demand_without_shared(const Ground<dim> &ground,
                          const FreeFaces<dim> &free,
                          const Blocks<dim> &blocks,
                          const JoinedBlock<dim> &member,
                          const double time,
                          const double factor)
    {
      BlockSupport<dim> support = member.support;
      std::map<unsigned int, bool> is_loose;
      const auto is_shared = [&](const auto &section) {
        const unsigned int b =
          section.trace.block[section.trace.block[0] == member.block];
        if (!can_hang(blocks, b))
          return false;
        const auto [found, is_new] = is_loose.emplace(b, false);
        if (is_new)
          found->second =
            bare_factor(look_around(ground, free, blocks.blocks[b], time)) <
            factor;
        return found->second;
      };
      std::vector<typename BlockSupport<dim>::Section> kept;
      for (const auto &section : support.sections)
        if (is_shared(section))
          {
            support.shotcrete_strength -= section.strength;
            support.shotcrete_length -= section.trace.length;
          }
        else
          kept.push_back(section);
      support.sections = kept;
      if (kept.empty())
        support.shotcrete_strength = support.shotcrete_length = 0.;
      return find_demand(
        ground, free, member.block, member.around, support, factor);
    }

    /** The force of a demand on a block, as it is pressed; none if it is out of
     * reach. */
    template <int dim>
    Tensor<1, dim>
    pressed_by(const Ground<dim> &ground,
               const FreeFaces<dim> &free,
               const JoinedBlock<dim> &member,
               const SupportDemand &demand)
    {
      BlockSurroundings<dim> around = member.around;
      const Tensor<1, dim> way =
        solve_with_laws<dim>(around.faces, around.loads.without_water())
          .direction;
      const Tensor<1, dim> area =
        sum_of_areas(ground.split.mesh,
                     list_supported_faces(ground, free, member.block, way));
      return std::isfinite(demand.force) && area.norm() > 0.
               ? -demand.force / area.norm() * area
               : Tensor<1, dim>();
    }

    /** The least share of @p pressed, which is what each of the @p members
     * needs without the others, with which they have a @p factor as one [-]. */
    template <int dim>
    double
    needed_share(const std::vector<JoinedBlock<dim>> &members,
                 const bool is_passive,
                 const Tensor<1, dim> &pressed,
                 const double factor)
    {
      const auto is_enough = [&](const double share) {
        return solve_as_one(members, is_passive, share * pressed).factor >=
               factor;
      };
      if (is_enough(0.))
        return 0.;
      double low = 0., high = 1.;
      for (unsigned int i = 0; i < n_share_steps; ++i)
        {
          const double middle              = 0.5 * (low + high);
          (is_enough(middle) ? high : low) = middle;
        }
      return high;
    }

    /** Whether a bolt ties @p one to any of @p members. */
    template <int dim>
    bool
    is_bolted_to_any(const JoinedBlock<dim> &one,
                     const std::vector<JoinedBlock<dim>> &members)
    {
      for (const auto &pull : one.support.pulls)
        for (const JoinedBlock<dim> &member : members)
          if (member.block == pull.other)
            return true;
      return false;
    }

    /** The demand of find_unshared_demand() for the block itself and those on
     * the same shotcrete. */
    template <int dim>
    SupportDemand
    find_demand_on_shotcrete(const Ground<dim> &ground,
                             const FreeFaces<dim> &free,
                             const Blocks<dim> &blocks,
                             const unsigned int block,
                             const double time,
                             const double factor,
                             const BlockStatics<dim> &statics)
    {
      const bool is_passive =
        ground.scene.safety.bolt_convention == BoltConvention::passive;
      std::vector<JoinedBlock<dim>> members{
        {block, statics.around, statics.support}};
      const auto demand_of = [&](const JoinedBlock<dim> &member) {
        return demand_without_shared(
          ground, free, blocks, member, time, factor);
      };
      SupportDemand demand = demand_of(members[0]);
      if (statics.support.sections.empty() || demand.force == 0. ||
          !std::isfinite(demand.force))
        return demand;
      Tensor<1, dim> pressed = pressed_by(ground, free, members[0], demand);
      double share = needed_share(members, is_passive, pressed, factor);
      // (what has broken of the bolts of others is not known here)
      add_neighbors(ground, free, blocks, time, {}, factor, members, [&]() {
        pressed +=
          pressed_by(ground, free, members.back(), demand_of(members.back()));
        share =
          std::max(share, needed_share(members, is_passive, pressed, factor));
      });
      if (share == 0.)
        return find_demand(
          ground, free, block, statics.around, members[0].support, factor);
      demand.force *= share;
      demand.pressure *= share;
      for (auto &[set, number] : demand.numbers)
        number = std::ceil(share * number - 1e-9);
      return demand;
    }
  } // namespace



  template <int dim>
  HangingGroup<dim>
  find_hanging_group(const Ground<dim> &ground,
                     const FreeFaces<dim> &free,
                     const Blocks<dim> &blocks,
                     const unsigned int block,
                     const double time,
                     const BrokenSegments &broken,
                     const BlockStatics<dim> &statics)
  {
    HangingGroup<dim> least;
    double factor      = statics.limit.factor;
    least.limit.factor = std::numeric_limits<double>::quiet_NaN();
    const bool is_passive =
      ground.scene.safety.bolt_convention == BoltConvention::passive;
    std::vector<JoinedBlock<dim>> hanging{
      {block, statics.around, statics.support}};
    const auto look_at = [&](const std::vector<JoinedBlock<dim>> &members,
                             const LimitEquilibrium<dim> &limit) {
      if (!(limit.factor < (1. - same_factor) * factor))
        return false;
      factor = limit.factor;
      least  = {{}, limit, false, false};
      for (unsigned int i = 1; i < members.size(); ++i)
        least.others.push_back(members[i].block);
      std::sort(least.others.begin(), least.others.end());
      return true;
    };
    add_neighbors(ground, free, blocks, time, broken, factor, hanging, [&]() {
      if (look_at(hanging, solve_as_one(hanging, is_passive)))
        least.is_by_shotcrete = true;
    });
    for_each_tied_group<dim>(
      ground,
      free,
      blocks,
      time,
      broken,
      hanging[0],
      statics.limit.factor,
      [&](const auto &members, const auto &limit) {
        if (!look_at(members, limit))
          return;
        least.is_by_bolts = true;
        least.is_by_shotcrete =
          !std::all_of(members.begin(), members.end(), [&](const auto &one) {
            return is_bolted_to_any(one, members);
          });
      });
    return least;
  }



  template <int dim>
  SupportDemand
  find_unshared_demand(const Ground<dim> &ground,
                       const FreeFaces<dim> &free,
                       const Blocks<dim> &blocks,
                       const unsigned int block,
                       const double time,
                       const double factor,
                       const BlockStatics<dim> &statics)
  {
    SupportDemand demand = find_demand_on_shotcrete(
      ground, free, blocks, block, time, factor, statics);
    const JoinedBlock<dim> first{block, statics.around, statics.support};
    for_each_tied_group<dim>(
      ground,
      free,
      blocks,
      time,
      {},
      first,
      statics.limit.factor,
      [&](const auto &members, const auto &limit) {
        if (limit.factor < factor)
          demand.include(find_demand_of_group(ground, free, members, factor));
      });
    return demand;
  }

#define INSTANTIATE(dim)                                                       \
  template HangingGroup<dim> find_hanging_group(const Ground<dim> &,           \
                                                const FreeFaces<dim> &,        \
                                                const Blocks<dim> &,           \
                                                const unsigned int,            \
                                                const double,                  \
                                                const BrokenSegments &,        \
                                                const BlockStatics<dim> &);    \
  template SupportDemand find_unshared_demand(const Ground<dim> &,             \
                                              const FreeFaces<dim> &,          \
                                              const Blocks<dim> &,             \
                                              const unsigned int,              \
                                              const double,                    \
                                              const double,                    \
                                              const BlockStatics<dim> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock
