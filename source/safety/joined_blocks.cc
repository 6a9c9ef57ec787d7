// SPDX-License-Identifier: LGPL-2.1-or-later
// Blocks that move as one body, on bolts that tie them to each other.
#include <keyblock/safety/joined_blocks.h>
#include <keyblock/safety/least_support.h>
#include <keyblock/safety/tied_blocks.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace Keyblock
{
  namespace
  {
    /** Blocks in a row that do not lower the factor of a group, after which it
     * is not made larger. */
    constexpr unsigned int most_in_vain = 4;

    /** Keep of the faces of @p limit those that are the first one's, by its
     * @p own indices; without any it falls with the others. */
    template <int dim>
    void
    keep_first(const std::vector<unsigned int> &own,
               LimitEquilibrium<dim> &limit)
    {
      const std::vector<unsigned int> faces = std::exchange(limit.faces, {});
      const std::vector<double> forces = std::exchange(limit.normal_forces, {});
      const unsigned int n_pressed     = std::exchange(limit.n_pressed, 0);
      for (unsigned int i = 0; i < faces.size(); ++i)
        if (faces[i] < own.size())
          {
            limit.faces.push_back(own[faces[i]]);
            limit.normal_forces.push_back(forces[i]);
            limit.n_pressed += i < n_pressed;
          }
      if (n_pressed > 0 && limit.n_pressed == 0)
        limit.mode = LimitEquilibrium<dim>::Mode::falling;
    }

    /** Neighbour of a group that bolts or shotcrete tie to it. */
    struct Tie
    {
      unsigned int block; ///< index
      bool is_bolt;       ///< or only shotcrete
    };

    /** Those of @p members, bolts first. */
    template <int dim>
    std::vector<Tie>
    list_ties(const Blocks<dim> &blocks,
              const std::vector<JoinedBlock<dim>> &members)
    {
      std::set<unsigned int> seen;
      for (const JoinedBlock<dim> &member : members)
        seen.insert(member.block);
      std::vector<Tie> ties;
      const auto add = [&](const unsigned int b, const bool is_bolt) {
        if (can_hang(blocks, b) && seen.insert(b).second)
          ties.push_back({b, is_bolt});
      };
      for (const JoinedBlock<dim> &member : members)
        for (const auto &pull : member.support.pulls)
          add(pull.other, true);
      for (const JoinedBlock<dim> &member : members)
        for (const auto &section : member.support.sections)
          add(section.trace.block[section.trace.block[0] == member.block],
              false);
      return ties;
    }

    /** Whether bolts tie any block that can move to another one. */
    template <int dim>
    bool
    has_tied_blocks(const Ground<dim> &ground, const Blocks<dim> &blocks)
    {
      for (const Bolt<dim> &bolt : ground.split.bolts)
        for (const BoltCrossing<dim> &crossing : bolt.crossings)
          if (crossing.block[0] != crossing.block[1] &&
              can_hang(blocks, crossing.block[0]) &&
              can_hang(blocks, crossing.block[1]))
            return true;
      return false;
    }

    /** Bolts of a set that @p members have, those to each other, and others. */
    template <int dim>
    std::array<unsigned int, 2>
    count_bolts(const std::vector<JoinedBlock<dim>> &members,
                const unsigned int set)
    {
      std::array<unsigned int, 2> n{{0, 0}};
      for (const JoinedBlock<dim> &member : members)
        for (const auto &pull : member.support.pulls)
          if (pull.set == set)
            ++n[std::none_of(
              members.begin(), members.end(), [&](const auto &one) {
                return one.block == pull.other;
              })];
      return n;
    }
  } // namespace



  template <int dim>
  LimitEquilibrium<dim>
  solve_as_one(const std::vector<JoinedBlock<dim>> &members,
               const bool is_passive,
               const Tensor<1, dim> &pressed)
  {
    std::set<unsigned int> blocks;
    for (const JoinedBlock<dim> &member : members)
      blocks.insert(member.block);
    const auto is_inside = [&](const unsigned int b) {
      return blocks.count(b) > 0;
    };
    std::vector<BlockFace<dim>> faces;
    std::vector<unsigned int> own; // indices of the first one's
    BlockSupport<dim> support;
    Tensor<1, dim> load, weight;
    for (const JoinedBlock<dim> &member : members)
      {
        const auto &around = member.around;
        for (unsigned int i = 0; i < around.faces.size(); ++i)
          if (const auto &others = around.others[i];
              others.empty() ||
              !std::all_of(others.begin(), others.end(), is_inside))
            {
              faces.push_back(around.faces[i]);
              if (&member == &members.front())
                own.push_back(i);
            }
        for (const auto &pull : member.support.pulls)
          if (!is_inside(pull.other))
            support.pulls.push_back(pull);
        for (const auto &section : member.support.sections)
          if (!is_inside(
                section.trace.block[section.trace.block[0] == member.block]))
            {
              support.sections.push_back(section);
              support.shotcrete_strength += section.strength;
            }
        support.shotcrete_load += member.support.shotcrete_load;
        load += around.loads.without_water();
        weight += around.loads.weight;
      }
    if (pressed.norm() > 0.)
      {
        support.pulls.emplace_back();
        support.pulls.back().along = pressed / pressed.norm();
        support.pulls.back().force = pressed.norm();
      }
    LimitEquilibrium<dim> limit =
      solve_with_support<dim>(faces, load, support, is_passive);
    limit.orient(weight);
    keep_first(own, limit);
    return limit;
  }



  template <int dim>
  void
  for_each_tied_group(const Ground<dim> &ground,
                      const FreeFaces<dim> &free,
                      const Blocks<dim> &blocks,
                      const double time,
                      const BrokenSegments &broken,
                      const JoinedBlock<dim> &first,
                      const double factor,
                      const GroupAction<dim> &action)
  {
    if (!has_tied_blocks(ground, blocks))
      return;
    const bool is_passive =
      ground.scene.safety.bolt_convention == BoltConvention::passive;
    std::vector<JoinedBlock<dim>> members{first};
    std::map<unsigned int, JoinedBlock<dim>> known;
    double least      = factor;
    bool has_bolts    = false;
    unsigned int vain = 0;
    while (members.size() < most_joined_blocks && vain < most_in_vain)
      {
        const std::vector<Tie> ties = list_ties(blocks, members);
        if (ties.empty())
          break;
        Tie best = ties.front();
        LimitEquilibrium<dim> limit;
        for (const Tie &tie : ties)
          {
            auto found = known.find(tie.block);
            if (found == known.end())
              found =
                known
                  .emplace(
                    tie.block,
                    JoinedBlock<dim>{
                      tie.block,
                      look_around(ground, free, blocks.blocks[tie.block], time),
                      find_support_of_block(ground, tie.block, time, broken)})
                  .first;
            members.push_back(found->second);
            const auto with = solve_as_one(members, is_passive);
            members.pop_back();
            if (&tie == &ties.front() || with.factor < limit.factor)
              {
                best  = tie;
                limit = with;
              }
          }
        members.push_back(known.at(best.block));
        has_bolts |= best.is_bolt;
        if (has_bolts)
          action(members, limit);
        const bool is_lower = limit.factor < (1. - same_factor) * least;
        vain                = is_lower ? 0 : vain + 1;
        if (is_lower)
          least = limit.factor;
      }
  }



  template <int dim>
  SupportDemand
  find_demand_of_group(const Ground<dim> &ground,
                       const FreeFaces<dim> &free,
                       const std::vector<JoinedBlock<dim>> &members,
                       const double factor)
  {
    using Mode = typename LimitEquilibrium<dim>::Mode;
    const bool is_passive =
      ground.scene.safety.bolt_convention == BoltConvention::passive;
    SupportDemand demand;
    demand.factor                    = factor;
    const LimitEquilibrium<dim> bare = solve_as_one(members, is_passive);
    if (bare.factor >= factor)
      return demand;
    const auto is_held = [&](const LimitEquilibrium<dim> &limit) {
      // so much that it lifts them is none
      return limit.factor >= factor &&
             (limit.mode != Mode::lifting || bare.mode == Mode::lifting);
    };
    Tensor<1, dim> area, load, water;
    BlockSupport<dim> all;
    for (const JoinedBlock<dim> &member : members)
      {
        area += sum_of_areas(
          ground.split.mesh,
          list_supported_faces(ground, free, member.block, bare.direction));
        load += member.around.loads.without_water();
        for (const BlockFace<dim> &face : member.around.faces)
          water += face.water_force * face.inward;
        all.pulls.insert(all.pulls.end(),
                         member.support.pulls.begin(),
                         member.support.pulls.end());
        if (&member != &members.front())
          demand.others.push_back(member.block);
      }
    const double resultant = (load + water).norm();
    const double most      = most_demand * std::max(load.norm(), resultant);
    demand.force           = least_force(
      [&](const double force) {
        return is_held(
          solve_as_one(members, is_passive, -force / area.norm() * area));
      },
      least_demand * resultant,
      area.norm() > 0. ? most : 0.,
      1.1);
    demand.pressure =
      area.norm() > 0. ? demand.force / area.norm() : demand.force;
    demand.numbers = list_new_bolts(ground, all, demand.force);
    for (unsigned int set = 0; set < ground.scene.bolts.size(); ++set)
      {
        const auto [n_inside, n_outside] = count_bolts(members, set);
        if (n_inside + n_outside == 0)
          continue;
        const std::string &name = ground.scene.bolts[set]->name;
        if (n_outside == 0)
          demand.loose_sets.insert(name);
        demand.numbers.emplace_back(
          name, n_outside == 0 ? 0 : least_number([&](const unsigned int n) {
            std::vector<JoinedBlock<dim>> more = members;
            for (JoinedBlock<dim> &member : more)
              member.support.add_bolts(set, double(n) / n_outside);
            return is_held(solve_as_one(more, is_passive));
          }));
      }
    return demand;
  }

#define INSTANTIATE(dim)                                                       \
  template LimitEquilibrium<dim> solve_as_one(                                 \
    const std::vector<JoinedBlock<dim>> &,                                     \
    const bool,                                                                \
    const Tensor<1, dim> &);                                                   \
  template void for_each_tied_group(const Ground<dim> &,                       \
                                    const FreeFaces<dim> &,                    \
                                    const Blocks<dim> &,                       \
                                    const double,                              \
                                    const BrokenSegments &,                    \
                                    const JoinedBlock<dim> &,                  \
                                    const double,                              \
                                    const GroupAction<dim> &);                 \
  template SupportDemand find_demand_of_group(                                 \
    const Ground<dim> &,                                                       \
    const FreeFaces<dim> &,                                                    \
    const std::vector<JoinedBlock<dim>> &,                                     \
    const double);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock
