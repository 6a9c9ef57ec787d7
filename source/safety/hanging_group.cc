// SPDX-License-Identifier: LGPL-2.1-or-later
// Blocks that hang on the same shotcrete, or on bolts between them.
#include <keyblock/safety/hanging_group.h>
#include <keyblock/safety/tied_blocks.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace Keyblock
{
  namespace
  {
    /** Blocks of a group; more of them cost more than they tell. */
    constexpr unsigned int most_blocks = 32;

    /** Factors that differ by less are the same [-]. */
    constexpr double same_factor = 1e-9;

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

    /** One block of a group. */
    template <int dim>
    struct Member
    {
      unsigned int block; ///< index
      BlockSurroundings<dim> around;
      BlockSupport<dim> support;
    };

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

    /** Limit equilibrium of @p members as one body: of their faces, bolts and
     * shotcrete those towards rock and other blocks, under all of their loads,
     * and a force @p pressed on them [N]; the first one's faces by the indices
     * of its own. */
    template <int dim>
    LimitEquilibrium<dim>
    solve_as_one(const std::vector<Member<dim>> &members,
                 const bool is_passive,
                 const Tensor<1, dim> &pressed = Tensor<1, dim>())
    {
      std::set<unsigned int> blocks;
      for (const Member<dim> &member : members)
        blocks.insert(member.block);
      const auto is_inside = [&](const unsigned int b) {
        return blocks.count(b) > 0;
      };
      std::vector<BlockFace<dim>> faces;
      std::vector<unsigned int> own; // indices of the first one's
      BlockSupport<dim> support;
      Tensor<1, dim> load, weight;
      for (const Member<dim> &member : members)
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
                  std::vector<Member<dim>> &members,
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
                can_hang(blocks, b) && members.size() < most_blocks &&
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

    /** Add to @p members, the first of which is there, the blocks with which it
     * is tied by bolts that reach no other rock, and which go with it at less
     * than @p factor, which @p visit lowers then. */
    template <int dim, typename Visit>
    void
    add_tied(const Ground<dim> &ground,
             const FreeFaces<dim> &free,
             const Blocks<dim> &blocks,
             const double time,
             const BrokenSegments &broken,
             const double &factor,
             std::vector<Member<dim>> &members,
             const Visit &visit)
    {
      std::set<unsigned int> seen{members[0].block};
      for (unsigned int m = 0;
           m < std::min<std::size_t>(members.size(), most_blocks);
           ++m)
        {
          const auto pulls = members[m].support.pulls;
          for (const auto &pull : pulls)
            {
              const double before     = factor;
              const std::size_t known = members.size();
              for (const unsigned int b :
                   blocks_tied_by(ground.split, blocks, pull.bolt))
                if (seen.count(b) == 0)
                  members.push_back(
                    {b,
                     look_around(ground, free, blocks.blocks[b], time),
                     find_support_of_block(ground, b, time, broken)});
              visit();
              if (!(factor < before))
                members.resize(known);
              for (std::size_t i = known; i < members.size(); ++i)
                seen.insert(members[i].block);
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
                          const Member<dim> &member,
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
               const Member<dim> &member,
               const SupportDemand &demand)
    {
      BlockSurroundings<dim> around = member.around;
      const Tensor<1, dim> way =
        solve_with_laws<dim>(around.faces, around.loads.without_water())
          .direction;
      Tensor<1, dim> area;
      for (const CellFace &f :
           list_supported_faces(ground, free, member.block, way))
        area += ground.split.mesh.face_area_vector(f.cell, f.face);
      return std::isfinite(demand.force) && area.norm() > 0.
               ? -demand.force / area.norm() * area
               : Tensor<1, dim>();
    }

    /** The least share of @p pressed, which is what each of the @p members
     * needs without the others, with which they have a @p factor as one [-]. */
    template <int dim>
    double
    needed_share(const std::vector<Member<dim>> &members,
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
    std::vector<Member<dim>> members{{block, statics.around, statics.support}};
    bool is_by_bolts = false;
    const auto visit = [&]() {
      const auto limit = solve_as_one(members, is_passive);
      if (!(limit.factor < (1. - same_factor) * factor))
        return;
      factor = limit.factor;
      // (each block of a row that holds has the factor of its own bolts)
      if (is_by_bolts && factor >= 1.)
        return;
      least.limit       = limit;
      least.is_by_bolts = is_by_bolts;
      least.others.clear();
      for (unsigned int i = 1; i < members.size(); ++i)
        least.others.push_back(members[i].block);
    };
    add_neighbors(ground, free, blocks, time, broken, factor, members, visit);
    members.resize(1);
    is_by_bolts = true;
    add_tied(ground, free, blocks, time, broken, factor, members, visit);
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
    const bool is_passive =
      ground.scene.safety.bolt_convention == BoltConvention::passive;
    std::vector<Member<dim>> members{{block, statics.around, statics.support}};
    // bolts give nothing with which it fails together with what they end in
    auto &pulls = members[0].support.pulls;
    if (const auto group =
          find_hanging_group(ground, free, blocks, block, time, {}, statics);
        group.is_by_bolts && group.limit.factor < factor)
      {
        const auto is_loose = [&](const auto &pull) {
          return !blocks_tied_by(ground.split, blocks, pull.bolt).empty();
        };
        pulls.erase(std::remove_if(pulls.begin(), pulls.end(), is_loose),
                    pulls.end());
      }
    const auto demand_of = [&](const Member<dim> &member) {
      return demand_without_shared(ground, free, blocks, member, time, factor);
    };
    SupportDemand demand = demand_of(members[0]);
    if (statics.support.sections.empty() || demand.force == 0. ||
        !std::isfinite(demand.force))
      return demand;
    Tensor<1, dim> pressed = pressed_by(ground, free, members[0], demand);
    double share           = needed_share(members, is_passive, pressed, factor);
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
