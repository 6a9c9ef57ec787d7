// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/safety/block_support.h>

#include <keyblock/blocks/bolt_layout.h>
#include <keyblock/safety/reduced_joints.h>
#include <keyblock/scene/gravity.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <sstream>

namespace Keyblock
{
  namespace
  {
    /** By how much a reaction is changed to see what it does, over itself,
     * halvings by which its share is found, and changes that are none. */
    constexpr double share_step             = 1e-4;
    constexpr unsigned int n_share_halvings = 40;
    constexpr double round_off              = 1e-12;
  } // namespace



  template <int dim>
  Tensor<1, dim>
  BlockSupport<dim>::force() const
  {
    Tensor<1, dim> sum;
    for (const Pull &pull : pulls)
      sum += pull.force * pull.along;
    return sum;
  }



  template <int dim>
  std::vector<typename BlockSupport<dim>::Force>
  BlockSupport<dim>::forces_against(const Tensor<1, dim> &direction) const
  {
    std::vector<Force> forces;
    const auto against = [&](const Tensor<1, dim> &part,
                             const double strength) {
      return part.norm() > 1e-12 ? -strength / part.norm() * part
                                 : Tensor<1, dim>();
    };
    for (const Pull &pull : pulls)
      forces.push_back(
        {pull.force * pull.along,
         against(direction - (direction * pull.along) * pull.along,
                 pull.dowel_strength),
         pull.is_reduced});
    for (const Section &section : sections)
      forces.push_back(
        {{},
         against(section.trace.in_section(direction), section.strength),
         section.is_reduced});
    return forces;
  }



  template <int dim>
  std::string
  BlockSupport<dim>::describe() const
  {
    std::ostringstream out;
    out.precision(4);
    if (shotcrete_strength > 0.)
      {
        out << "shotcrete of " << 1e-3 * shotcrete_strength << " kN"
            << (dim == 2 ? "/m" : "");
        if (dim == 3)
          out << " along " << shotcrete_length << " m";
        if (!pulls.empty())
          out << " and ";
      }
    if (pulls.empty())
      return out.str();
    std::map<std::string, unsigned int> limits;
    double sum = 0.;
    for (const Pull &pull : pulls)
      {
        ++limits[Keyblock::describe(pull.limit)];
        sum += pull.force;
      }
    out << pulls.size() << (pulls.size() == 1 ? " bolt" : " bolts") << " of "
        << 1e-3 * sum << " kN" << (dim == 2 ? "/m" : "") << " (";
    for (auto limit = limits.begin(); limit != limits.end(); ++limit)
      {
        out << (limit == limits.begin() ? "" : ", ");
        if (limits.size() > 1)
          out << limit->second << " by ";
        out << limit->first;
      }
    out << ')';
    return out.str();
  }



  namespace
  {
    template <int dim>
    void
    add_shotcrete(const Ground<dim> &ground,
                  const unsigned int block,
                  const double time,
                  BlockSupport<dim> &support)
    {
      const Scene<dim> &scene         = ground.scene;
      const std::vector<bool> reduced = list_reduced_joints(scene);
      double mass                     = 0.;
      for (unsigned int i = 0; i < ground.split.liners.size(); ++i)
        {
          const Liner &liner = *scene.liners[i];
          if (scene.stage_number(liner.stage) > ground.stage_number)
            continue;
          for (const LinerTrace<dim> &trace : ground.split.liners[i].traces)
            if ((trace.block[0] == block || trace.block[1] == block) &&
                !ground.is_excavated(trace.cell[0]) &&
                !ground.is_excavated(trace.cell[1]))
              {
                const double strength =
                  liner.shear_strength * liner.thickness * trace.length;
                support.shotcrete_length += trace.length;
                support.shotcrete_strength += strength;
                support.sections.push_back(
                  {trace, strength, has_reduced(reduced, trace.joint)});
              }
          for (const LinerArea &part : ground.split.liners[i].areas)
            if (part.block == block && !ground.is_excavated(part.cell))
              {
                const double m = part.area * liner.thickness * liner.density;
                mass += m;
                support.shotcrete_center +=
                  m * Tensor<1, dim>(ground.split.mesh.vertices[part.vertex]);
              }
        }
      if (mass == 0.)
        return;
      support.shotcrete_center /= mass;
      support.shotcrete_load = mass * seismic_acceleration_with_safety(ground);
      support.shotcrete_load +=
        mass * Gravity<dim>(scene).at(support.shotcrete_center, time);
    }
  } // namespace



  template <int dim>
  BlockSupport<dim>
  find_support_of_block(const Ground<dim> &ground,
                        const unsigned int block,
                        const double time,
                        const BrokenSegments &broken)
  {
    BlockSupport<dim> result;
    add_shotcrete(ground, block, time, result);
    const std::vector<bool> reduced = list_reduced_joints(ground.scene);
    for (unsigned int b = 0; b < ground.split.bolts.size(); ++b)
      {
        const Bolt<dim> &bolt   = ground.split.bolts[b];
        const BoltSet<dim> &set = *ground.scene.bolts[bolt.set];
        if (bolt.crossings.empty() ||
            ground.scene.stage_number(set.stage) > ground.stage_number)
          continue;
        const BoltRemains remains   = find_remains(bolt, ground);
        std::vector<bool> is_parted = remains.is_cut;
        if (!broken.empty())
          std::transform(is_parted.begin(),
                         is_parted.end(),
                         broken[b].begin(),
                         is_parted.begin(),
                         std::logical_or<>());
        BoltChain chain(properties_of(set), bolt.places);
        chain.set_ground(remains.is_held, is_parted, remains.grout);
        for (const BoltCrossing<dim> &crossing : bolt.crossings)
          {
            const bool is_near = crossing.block[0] == block,
                       is_far  = crossing.block[1] == block;
            if (is_near == is_far)
              continue;
            const unsigned int segment = chain.segment_at(crossing.place);
            if (chain.is_parted_at(segment))
              {
                result.n_broken += !remains.is_cut[segment];
                continue;
              }
            for (const BoltCrossing<dim> &other : bolt.crossings)
              result.shared_with.insert(other.block.begin(), other.block.end());
            const BoltChain::Capacity capacity = chain.capacity(crossing.place);
            typename BlockSupport<dim>::Pull pull;
            pull.place          = bolt.at(crossing.place);
            pull.along          = (is_near ? 1. : -1.) * bolt.direction();
            pull.force          = set.share() * capacity.force;
            pull.dowel_strength = set.share() * set.dowel_strength;
            pull.limit          = capacity.limit;
            pull.is_reduced     = has_reduced(reduced, crossing.joint);
            result.pulls.push_back(pull);
          }
      }
    result.shared_with.erase(block);
    return result;
  }



  namespace
  {
    template <int dim>
    LimitEquilibrium<dim>
    solve_with_active(std::vector<BlockFace<dim>> &faces,
                      const Tensor<1, dim> &load,
                      const BlockSupport<dim> &support)
    {
      const Tensor<1, dim> pulled = load + support.force();
      const LimitEquilibrium<dim> unsheared =
        solve_with_laws<dim>(faces, pulled);
      const Tensor<1, dim> way = unsheared.direction;
      if (way.norm() == 0.)
        return unsheared;
      Tensor<1, dim> reaction;
      for (const auto &force : support.forces_against(way))
        reaction += force.reaction;
      if (reaction.norm() == 0.)
        return unsheared;
      // what is sheared resists, and never by more than drives
      if (-(reaction * way) < unsheared.driving_force)
        return solve_with_laws<dim>(faces, pulled + reaction);
      LimitEquilibrium<dim> result;
      result.factor   = std::numeric_limits<double>::infinity();
      result.is_borne = true;
      return result;
    }

    /**
     * Set the @p share of a reaction's strength that is there by what
     * @p solve gives with it: a reaction does not drive, so it grows no further
     * than what drives gets less, or stays, with the block on its planes, and
     * no further than it raises the factor.
     */
    template <int dim, typename Solve>
    void
    mobilize(const Solve &solve, double &share)
    {
      const auto with = [&](const double trial) {
        share = trial;
        return solve();
      };
      const LimitEquilibrium<dim> without = with(0.);
      if (without.mode == LimitEquilibrium<dim>::Mode::stable)
        return;
      // the greatest share at which something is no worse than just below,
      // as it gets better with less to begin with or never
      const auto greatest = [&](const double most, const auto &is_no_worse) {
        const auto grows = [&](const double trial) {
          return is_no_worse(with((1. - share_step) * trial), with(trial));
        };
        if (grows(most))
          return most;
        double low = 0., high = most;
        for (unsigned int i = 0; i < n_share_halvings; ++i)
          {
            const double middle          = 0.5 * (low + high);
            (grows(middle) ? low : high) = middle;
          }
        return low;
      };
      using Limit = LimitEquilibrium<dim>;
      const double driving_least =
        greatest(1., [&](const Limit &less, const Limit &more) {
          return more.mode != Limit::Mode::stable &&
                 (more.n_pressed > 0 || without.n_pressed == 0) &&
                 more.driving_force <= (1. + round_off) * less.driving_force;
        });
      share = greatest(driving_least, [](const Limit &less, const Limit &more) {
        return more.factor >= (1. - round_off) * less.factor;
      });
    }

    template <int dim>
    LimitEquilibrium<dim>
    solve_with_passive(std::vector<BlockFace<dim>> &faces,
                       const Tensor<1, dim> &load,
                       const BlockSupport<dim> &support)
    {
      LimitEquilibrium<dim> bare = solve_with_laws<dim>(faces, load);
      if (!support.holds() || bare.direction.norm() == 0.)
        return bare;
      const Tensor<1, dim> way = bare.direction;
      const auto forces        = support.forces_against(way);
      std::vector<double> shares(forces.size(), 0.);
      const auto solve = [&]() {
        Tensor<1, dim> loading = load;
        std::vector<double> resisting(forces.size());
        for (unsigned int i = 0; i < forces.size(); ++i)
          {
            const Tensor<1, dim> force =
              forces[i].pull + shares[i] * forces[i].reaction;
            const double against = std::max(0., -(force * way));
            loading += force + against * way;
            resisting[i] = against;
          }
        LimitEquilibrium<dim> held = solve_with_laws<dim>(faces, loading);
        if (held.mode == LimitEquilibrium<dim>::Mode::stable)
          return held;
        for (unsigned int i = 0; i < forces.size(); ++i)
          held.add_resistance(resisting[i], forces[i].is_reduced);
        held.set_factor();
        return held;
      };
      for (unsigned int i = 0; i < forces.size(); ++i)
        if (forces[i].reaction.norm() > 0.)
          mobilize<dim>(solve, shares[i]);
      return solve();
    }
  } // namespace



  template <int dim>
  LimitEquilibrium<dim>
  solve_with_support(std::vector<BlockFace<dim>> &faces,
                     const Tensor<1, dim> &load,
                     const BlockSupport<dim> &support,
                     const bool is_passive)
  {
    const Tensor<1, dim> all_load = load + support.shotcrete_load;
    return is_passive ? solve_with_passive(faces, all_load, support)
                      : solve_with_active(faces, all_load, support);
  }



  template <int dim>
  Tensor<1, dim>
  way_without_support(const Ground<dim> &ground,
                      const FreeFaces<dim> &free,
                      const Blocks<dim> &blocks,
                      const unsigned int block,
                      const double time)
  {
    BlockSurroundings<dim> around =
      look_around(ground, free, blocks.blocks[block], time);
    BlockSupport<dim> weight;
    add_shotcrete(ground, block, time, weight);
    return solve_with_laws<dim>(around.faces,
                                around.loads.without_water() +
                                  weight.shotcrete_load)
      .direction;
  }

#define INSTANTIATE(dim)                                                       \
  template struct BlockSupport<dim>;                                           \
  template BlockSupport<dim> find_support_of_block(const Ground<dim> &,        \
                                                   const unsigned int,         \
                                                   const double,               \
                                                   const BrokenSegments &);    \
  template Tensor<1, dim> way_without_support(const Ground<dim> &,             \
                                              const FreeFaces<dim> &,          \
                                              const Blocks<dim> &,             \
                                              const unsigned int,              \
                                              const double);                   \
  template LimitEquilibrium<dim> solve_with_support(                           \
    std::vector<BlockFace<dim>> &,                                             \
    const Tensor<1, dim> &,                                                    \
    const BlockSupport<dim> &,                                                 \
    const bool);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock
