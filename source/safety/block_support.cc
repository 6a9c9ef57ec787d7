// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/safety/block_support.h>

#include <keyblock/blocks/bolt_layout.h>
#include <keyblock/safety/reduced_joints.h>
#include <keyblock/scene/gravity.h>

#include <algorithm>
#include <functional>
#include <map>
#include <sstream>

namespace Keyblock
{
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
         pull.is_reduced,
         true});
    for (const Section &section : sections)
      forces.push_back(
        {{},
         against(section.trace.in_section(direction), section.strength),
         section.is_reduced,
         false});
    return forces;
  }



  template <int dim>
  void
  BlockSupport<dim>::add_bolts(const unsigned int set, const double share)
  {
    for (Pull &pull : pulls)
      if (pull.set == set)
        {
          pull.force *= 1. + share;
          pull.dowel_strength *= 1. + share;
        }
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
    std::map<unsigned int, const Pull *> strongest; // of each bolt
    double sum = 0., sum_of_dowels = 0.;
    for (const Pull &pull : pulls)
      {
        const Pull *&best = strongest.emplace(pull.bolt, &pull).first->second;
        best              = pull.force > best->force ? &pull : best;
        sum_of_dowels += pull.dowel_strength;
      }
    std::map<std::string, unsigned int> limits;
    for (const auto &[bolt, pull] : strongest)
      {
        ++limits[!pull->has_plate &&
                     pull->limit == BoltChain::Capacity::Limit::head
                   ? "bond inside"
                   : Keyblock::describe(pull->limit)];
        sum += pull->force;
      }
    out << strongest.size() << (strongest.size() == 1 ? " bolt" : " bolts")
        << " of " << 1e-3 * sum << " kN" << (dim == 2 ? "/m" : "") << " (";
    for (auto limit = limits.begin(); limit != limits.end(); ++limit)
      {
        out << (limit == limits.begin() ? "" : ", ");
        if (limits.size() > 1)
          out << limit->second << " by ";
        out << limit->first;
      }
    out << ')';
    if (sum_of_dowels > 0.)
      out << " and dowels of " << 1e-3 * sum_of_dowels << " kN"
          << (dim == 2 ? "/m" : "");
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
                support.has_liner = true;
                support.shotcrete_length += trace.length;
                support.shotcrete_strength += strength;
                support.sections.push_back(
                  {trace, strength, has_reduced(reduced, trace.joint)});
              }
          for (const LinerArea &part : ground.split.liners[i].areas)
            if (part.block == block && !ground.is_excavated(part.cell))
              {
                const double m    = part.area * liner.thickness * liner.density;
                support.has_liner = true;
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



  namespace
  {
    /** A bolt in the ground that there is, without the segments that excavation
     * has cut, or that have @p broken. */
    template <int dim>
    BoltChain
    chain_of(const Bolt<dim> &bolt,
             const BoltSet<dim> &set,
             const BoltRemains &remains,
             const std::vector<bool> *broken)
    {
      std::vector<bool> is_parted = remains.is_cut;
      if (broken)
        std::transform(is_parted.begin(),
                       is_parted.end(),
                       broken->begin(),
                       is_parted.begin(),
                       std::logical_or<>());
      BoltChain chain(properties_of(set), bolt.places);
      chain.set_ground(remains.is_held, is_parted, remains.grout);
      return chain;
    }
  } // namespace



  template <int dim>
  double
  mean_bolt_capacity(const Ground<dim> &ground, const unsigned int set_index)
  {
    const BoltSet<dim> &set = *ground.scene.bolts[set_index];
    double sum              = 0.;
    unsigned int n          = 0;
    for (const Bolt<dim> &bolt : ground.split.bolts)
      if (bolt.set == set_index && !bolt.crossings.empty())
        {
          const BoltChain chain =
            chain_of(bolt, set, find_remains(bolt, ground), nullptr);
          for (const BoltCrossing<dim> &crossing : bolt.crossings)
            if (!chain.is_parted_between(crossing.begin, crossing.end))
              {
                sum += set.share() * chain.capacity(crossing.middle()).force;
                ++n;
              }
        }
    return n > 0 ? sum / n : 0.;
  }



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
        const BoltRemains remains = find_remains(bolt, ground);
        const BoltChain chain =
          chain_of(bolt, set, remains, broken.empty() ? nullptr : &broken[b]);
        for (const BoltCrossing<dim> &crossing : bolt.crossings)
          {
            const bool is_near = crossing.block[0] == block,
                       is_far  = crossing.block[1] == block;
            if (is_near == is_far)
              continue;
            if (chain.is_parted_between(crossing.begin, crossing.end))
              {
                const auto [first, end] =
                  chain.segments_between(crossing.begin, crossing.end);
                result.n_broken +=
                  std::none_of(remains.is_cut.begin() + first,
                               remains.is_cut.begin() + end,
                               [](const bool is) { return is; });
                continue;
              }
            for (const BoltCrossing<dim> &other : bolt.crossings)
              result.shared_with.insert(other.block.begin(), other.block.end());
            const BoltChain::Capacity capacity =
              chain.capacity(crossing.middle());
            typename BlockSupport<dim>::Pull pull;
            pull.place = bolt.at(crossing.middle());
            pull.along = (is_near ? 1. : -1.) * bolt.direction();
            pull.force = set.share() * capacity.force;
            pull.dowel_strength =
              crossing.is_void() ? 0. : set.share() * set.dowel_strength;
            pull.limit      = capacity.limit;
            pull.has_plate  = remains.is_held.front();
            pull.is_reduced = has_reduced(reduced, crossing.joint);
            pull.set        = bolt.set;
            pull.bolt       = b;
            pull.other      = crossing.block[is_near];
            result.pulls.push_back(pull);
          }
      }
    result.shared_with.erase(block);
    return result;
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

  template <int dim>
  std::string
  describe_bolts(const Scene<dim> &scene,
                 const std::string &set,
                 const unsigned int number)
  {
    std::ostringstream out;
    out << number << (number == 1 ? " bolt" : " bolts") << " of the set "
        << set;
    for (const auto &bolts : scene.bolts)
      if (dim == 2 && bolts->name == set)
        out << " every " << bolts->spacing.back() << " m of tunnel";
    return out.str();
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
  template double mean_bolt_capacity(const Ground<dim> &, const unsigned int); \
  template std::string describe_bolts(const Scene<dim> &,                      \
                                      const std::string &,                     \
                                      const unsigned int);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock
