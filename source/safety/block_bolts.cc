// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/safety/block_bolts.h>

#include <keyblock/blocks/bolt_layout.h>

#include <cmath>
#include <limits>
#include <map>
#include <sstream>

namespace Keyblock
{
  namespace
  {
    /** Halvings by which a demand is found, and greatest demand over the load
     * that is looked at. */
    constexpr unsigned int n_halvings = 60;
    constexpr double most_demand      = 1e4;
  } // namespace



  template <int dim>
  Tensor<1, dim>
  BlockBolts<dim>::force() const
  {
    Tensor<1, dim> sum;
    for (const Pull &pull : pulls)
      sum += pull.force * pull.along;
    return sum;
  }



  template <int dim>
  Tensor<1, dim>
  BlockBolts<dim>::dowel_force(const Tensor<1, dim> &direction) const
  {
    Tensor<1, dim> sum;
    for (const Pull &pull : pulls)
      {
        const Tensor<1, dim> across =
          direction - (direction * pull.along) * pull.along;
        if (across.norm() > 1e-12)
          sum -= pull.dowel_strength / across.norm() * across;
      }
    return sum;
  }



  template <int dim>
  std::string
  BlockBolts<dim>::describe() const
  {
    if (pulls.empty())
      return "";
    std::map<std::string, unsigned int> limits;
    double sum = 0.;
    for (const Pull &pull : pulls)
      {
        ++limits[Keyblock::describe(pull.limit)];
        sum += pull.force;
      }
    std::ostringstream out;
    out.precision(4);
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



  template <int dim>
  BlockBolts<dim>
  find_bolts_of_block(const Ground<dim> &ground, const unsigned int block)
  {
    BlockBolts<dim> result;
    for (const Bolt<dim> &bolt : ground.split.bolts)
      {
        const BoltSet<dim> &set = *ground.scene.bolts[bolt.set];
        if (ground.scene.stage_number(set.stage) > ground.stage_number)
          continue;
        for (const BoltCrossing<dim> &crossing : bolt.crossings)
          {
            const bool is_near = crossing.block[0] == block,
                       is_far  = crossing.block[1] == block;
            if (is_near == is_far)
              continue;
            BoltChain chain(properties_of(set), bolt.places);
            chain.set_ground(list_held_nodes(bolt, ground));
            const BoltChain::Capacity capacity = chain.capacity(crossing.place);
            typename BlockBolts<dim>::Pull pull;
            pull.place          = bolt.at(crossing.place);
            pull.along          = (is_near ? 1. : -1.) * bolt.direction();
            pull.force          = set.share() * capacity.force;
            pull.dowel_strength = set.share() * set.dowel_strength;
            pull.limit          = capacity.limit;
            result.pulls.push_back(pull);
          }
      }
    return result;
  }



  template <int dim>
  LimitEquilibrium<dim>
  solve_with_bolts(std::vector<BlockFace<dim>> &faces,
                   const Tensor<1, dim> &load,
                   const BlockBolts<dim> &bolts,
                   const bool is_passive)
  {
    LimitEquilibrium<dim> bare = solve_with_laws<dim>(faces, load);
    if (bolts.pulls.empty() || bare.direction.norm() == 0.)
      return bare;
    const Tensor<1, dim> way = bare.direction;
    const Tensor<1, dim> all = bolts.force() + bolts.dowel_force(way);
    if (!is_passive)
      return solve_with_laws<dim>(faces, load + all);
    const double against = -(all * way);
    LimitEquilibrium<dim> held =
      solve_with_laws<dim>(faces, load + all + against * way);
    if (held.driving_force > 0. && std::isfinite(held.factor))
      {
        const double driving = held.driving_force + std::max(0., -against);
        held.factor =
          (held.factor * held.driving_force + std::max(0., against)) / driving;
        held.driving_force = driving;
      }
    return held;
  }



  template <int dim>
  SupportDemand
  find_demand(const Ground<dim> &ground,
              const FreeFaces<dim> &free,
              const unsigned int block,
              const BlockSurroundings<dim> &around,
              const BlockBolts<dim> &bolts,
              const double factor)
  {
    Tensor<1, dim> area;
    for (const unsigned int i : free.of_block(block))
      area += ground.split.mesh.face_area_vector(free.faces[i].cell,
                                                 free.faces[i].face);
    SupportDemand demand;
    const bool is_passive =
      ground.scene.safety.bolt_convention == BoltConvention::passive;
    const Tensor<1, dim> load = around.loads.without_water();
    const auto factor_with    = [&](const double force) {
      std::vector<BlockFace<dim>> faces = around.faces;
      BlockBolts<dim> more              = bolts;
      if (force > 0.)
        {
          more.pulls.emplace_back();
          more.pulls.back().along = -area / area.norm();
          more.pulls.back().force = force;
        }
      const LimitEquilibrium<dim> limit =
        solve_with_bolts<dim>(faces, load, more, is_passive);
      return limit.mode == LimitEquilibrium<dim>::Mode::lifting ? 0.
                                                                   : limit.factor;
    };
    if (factor_with(0.) >= factor)
      return demand;
    demand.force = demand.pressure = std::numeric_limits<double>::infinity();
    if (area.norm() == 0.)
      return demand;
    // the least force that does: more may push the block elsewhere
    double low = 0., high = 0.;
    for (double force = 1e-3 * load.norm(); force < most_demand * load.norm();
         force *= 1.1)
      {
        if (factor_with(force) >= factor)
          {
            high = force;
            break;
          }
        low = force;
      }
    if (high == 0.)
      return demand;
    for (unsigned int i = 0; i < n_halvings; ++i)
      {
        const double middle                          = 0.5 * (low + high);
        (factor_with(middle) >= factor ? high : low) = middle;
      }
    demand.force    = high;
    demand.pressure = high / area.norm();
    for (const auto &set : ground.scene.bolts)
      demand.numbers.emplace_back(set->name,
                                  static_cast<unsigned int>(std::ceil(
                                    high / (set->share() * set->yield_force) -
                                    1e-9)));
    return demand;
  }

#define INSTANTIATE(dim)                                                       \
  template struct BlockBolts<dim>;                                             \
  template BlockBolts<dim> find_bolts_of_block(const Ground<dim> &,            \
                                               const unsigned int);            \
  template LimitEquilibrium<dim> solve_with_bolts(                             \
    std::vector<BlockFace<dim>> &,                                             \
    const Tensor<1, dim> &,                                                    \
    const BlockBolts<dim> &,                                                   \
    const bool);                                                               \
  template SupportDemand find_demand(const Ground<dim> &,                      \
                                     const FreeFaces<dim> &,                   \
                                     const unsigned int,                       \
                                     const BlockSurroundings<dim> &,           \
                                     const BlockBolts<dim> &,                  \
                                     const double);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock
