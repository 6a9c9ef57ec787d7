// SPDX-License-Identifier: LGPL-2.1-or-later
// Blocks that may lean on one that can move, and what that needs then.
#include <keyblock/base/number_text.h>
#include <keyblock/blocks/nodal_areas.h>
#include <keyblock/safety/block_cascade.h>
#include <keyblock/safety/hanging_group.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <set>

namespace Keyblock
{
  namespace
  {
    /** Decrease of a factor that counts as one [-]. */
    constexpr double least_decrease = 1e-9;

    /** Difference of two demands that are the same [-]. */
    constexpr double same_demand = 1e-9;

    /** A row of blocks behind each other, and the ground without them. */
    template <int dim>
    struct LeaningRow
    {
      std::vector<bool> is_gone;
      std::unique_ptr<Ground<dim>> ground;
      std::unique_ptr<FreeFaces<dim>> free;

      LeaningRow(const Ground<dim> &now, const std::vector<bool> &gone)
        : is_gone(gone)
        , ground(std::make_unique<Ground<dim>>(
            Ground<dim>{now.scene, now.split, now.stage_number, &is_gone}))
        , free(std::make_unique<FreeFaces<dim>>(*ground))
      {}
    };

    /** One that moves once what is below it has gone. */
    template <int dim>
    struct LeaningBlock
    {
      unsigned int block; ///< index
      unsigned int below; ///< what it leans on: index
      unsigned int row;
      BlockStatics<dim> statics; ///< without all below
    };

    template <int dim>
    std::set<unsigned int>
    neighbors_of(const BlockStatics<dim> &statics)
    {
      std::set<unsigned int> neighbors;
      for (const std::set<unsigned int> &others : statics.around.others)
        neighbors.insert(others.begin(), others.end());
      return neighbors;
    }

    /** What a block needs for the wanted factor under @p thrusts besides. */
    template <int dim>
    SupportDemand
    demand_under(const std::vector<PointForce<dim>> &thrusts,
                 const Ground<dim> &ground,
                 const FreeFaces<dim> &free,
                 const unsigned int block,
                 const BlockStatics<dim> &statics,
                 const double wanted)
    {
      BlockSurroundings<dim> around = statics.around;
      auto &tractions               = around.loads.tractions;
      // what passive support bears of them is divided by the factor
      const double share =
        ground.scene.safety.bolt_convention == BoltConvention::passive
          ? 1. / wanted
          : 1.;
      for (const PointForce<dim> &one : thrusts)
        tractions.push_back({one.place, share * one.force});
      return find_demand(ground, free, block, around, statics.support, wanted);
    }

    /** The thrusts of a @p force by which a block presses on what it leans on:
     * opposite to support against its free faces. */
    template <int dim>
    std::vector<PointForce<dim>>
    thrusts_of(const double force,
               const Ground<dim> &ground,
               const FreeFaces<dim> &free,
               const LeaningBlock<dim> &above)
    {
      std::vector<PointForce<dim>> thrusts;
      const Mesh<dim> &mesh             = ground.split.mesh;
      const std::vector<CellFace> faces = list_supported_faces(
        ground, free, above.block, above.statics.limit.direction);
      for (const CellFace &f : faces)
        thrusts.push_back({area_center(mesh, f.cell, f.face),
                           mesh.face_area_vector(f.cell, f.face)});
      const double area = sum_of_areas(mesh, faces).norm();
      for (PointForce<dim> &one : thrusts)
        one.force *= area > 0. ? force / area : 0.;
      return thrusts;
    }

    template <int dim>
    std::string
    remark_on_leaning(const std::vector<LeaningBlock<dim>> &leaning,
                      const Blocks<dim> &blocks,
                      const double more)
    {
      std::set<unsigned int> ids;
      for (const LeaningBlock<dim> &one : leaning)
        ids.insert(blocks.blocks[one.block].id);
      std::string text = ids.size() == 1 ? "block " : "blocks ";
      for (const unsigned int id : ids)
        text += (id == *ids.begin() ? "" : ", ") + std::to_string(id);
      text += " may lean on it, left out";
      if (more > 0. && std::isfinite(more))
        text += (ids.size() == 1 ? ", and asks for " : ", and ask for ") +
                text_of(1e-3 * more, 4) + (dim == 2 ? " kN/m" : " kN") +
                " more";
      return text;
    }

    /** All that may lean on a block, and what it needs then. */
    template <int dim>
    class LeaningBlocks
    {
    public:
      LeaningBlocks(const Ground<dim> &ground,
                    const FreeFaces<dim> &free,
                    const Blocks<dim> &blocks,
                    const double time,
                    const double wanted,
                    const std::vector<JudgedBlock<dim>> &judged,
                    const JudgedBlock<dim> &below)
        : ground(ground)
        , free(free)
        , blocks(blocks)
        , time(time)
        , wanted(wanted)
        , judged(judged)
        , below(below)
      {
        neighbors[below.block]    = neighbors_of(below.statics);
        std::vector<bool> is_gone = removed_from(ground, blocks.blocks.size());
        for (std::vector<unsigned int> last{below.block}; !last.empty();)
          {
            for (const unsigned int b : last)
              is_gone[b] = true;
            last = add_row_behind(last, is_gone);
          }
      }

      /** What the block asks for more if they press on it with all that they
       * ask for [N]; infinite: nothing is enough. */
      double
      find_more() const
      {
        std::map<unsigned int, std::vector<PointForce<dim>>> thrusts;
        for (auto above = found.rbegin(); above != found.rend(); ++above)
          {
            const LeaningRow<dim> &row = *rows[above->row];
            const auto &on_it          = thrusts[above->block];
            const double force         = on_it.empty() ? demand_of(*row.ground,
                                                           *row.free,
                                                           above->block,
                                                           above->statics)
                                                       : demand_under(on_it,
                                                              *row.ground,
                                                              *row.free,
                                                              above->block,
                                                              above->statics,
                                                              wanted)
                                                   .force;
            if (!std::isfinite(force))
              return force;
            const auto more = thrusts_of(force, *row.ground, *row.free, *above);
            auto &on_below  = thrusts[above->below];
            if (force > 0.)
              on_below.insert(on_below.end(), more.begin(), more.end());
          }
        const auto &on_it = thrusts[below.block];
        if (on_it.empty())
          return 0.;
        const auto demand = [&](const std::vector<PointForce<dim>> &forces) {
          return demand_under(
                   forces, ground, free, below.block, below.statics, wanted)
            .force;
        };
        // support that it shares may hold it otherwise than as it was judged
        const double alone =
          demand_of(ground, free, below.block, below.statics);
        const double without = demand({});
        return std::isfinite(without) &&
                   std::abs(without - alone) <= same_demand * alone
                 ? demand(on_it) - without
                 : sum_of(on_it).norm();
      }

      std::vector<LeaningBlock<dim>> found; ///< the nearest first

    private:
      /** Add those that move once all up to the @p last are gone, and have not
       * before; returns those that do not stay by themselves then. */
      std::vector<unsigned int>
      add_row_behind(const std::vector<unsigned int> &last,
                     const std::vector<bool> &is_gone)
      {
        std::unique_ptr<LeaningRow<dim>> row;
        std::vector<unsigned int> next;
        std::set<unsigned int> asked;
        for (const unsigned int b : last)
          for (const unsigned int other : neighbors[b])
            {
              const BlockClass kind = class_now(ground, blocks.blocks[other]);
              const auto &tied = below.statics.others; // judged as one with it
              if (is_gone[other] || !asked.insert(other).second ||
                  std::count(tied.begin(), tied.end(), other) > 0 ||
                  (kind != BlockClass::exposed && kind != BlockClass::hidden))
                continue;
              if (!row)
                row = std::make_unique<LeaningRow<dim>>(ground, is_gone);
              const BlockStatics<dim> then =
                judge_block(*row->ground, *row->free, blocks, other, time);
              const BlockStatics<dim> &now = in_place(other);
              // (one tied to it falls with it, and asks for more without it)
              const bool asks_more =
                judgement_of(other) != judged.end() &&
                demand_of(ground, free, other, now) == 0. &&
                demand_of(*row->ground, *row->free, other, then) > 0.;
              if (!asks_more && !(then.limit.factor <
                                  (1. - least_decrease) * now.limit.factor))
                continue;
              found.push_back(
                {other, b, static_cast<unsigned int>(rows.size()), then});
              neighbors[other] = neighbors_of(then);
              if (asks_more || then.limit.factor < std::max(1., wanted))
                next.push_back(other);
            }
        if (row)
          rows.push_back(std::move(row));
        return next;
      }

      double
      demand_of(const Ground<dim> &at,
                const FreeFaces<dim> &faces,
                const unsigned int block,
                const BlockStatics<dim> &statics) const
      {
        if (wanted == 0.)
          return 0.;
        return statics.demand.factor == wanted
                 ? statics.demand.force
                 : find_unshared_demand(
                     at, faces, blocks, block, time, wanted, statics)
                     .force;
      }

      typename std::vector<JudgedBlock<dim>>::const_iterator
      judgement_of(const unsigned int block) const
      {
        return std::find_if(judged.begin(),
                            judged.end(),
                            [block](const JudgedBlock<dim> &one) {
                              return one.block == block;
                            });
      }

      /** A block between all others. */
      const BlockStatics<dim> &
      in_place(const unsigned int block)
      {
        if (const auto known = judgement_of(block);
            known != judged.end() && !known->is_uncovered)
          return known->statics;
        auto &statics = between_all[block];
        if (!statics)
          statics = std::make_unique<BlockStatics<dim>>(
            judge_block(ground, free, blocks, block, time));
        return *statics;
      }

      const Ground<dim> &ground;
      const FreeFaces<dim> &free;
      const Blocks<dim> &blocks;
      const double time, wanted;
      const std::vector<JudgedBlock<dim>> &judged;
      const JudgedBlock<dim> &below;
      std::vector<std::unique_ptr<LeaningRow<dim>>> rows;
      std::map<unsigned int, std::set<unsigned int>> neighbors;
      std::map<unsigned int, std::unique_ptr<BlockStatics<dim>>> between_all;
    };
  } // namespace



  template <int dim>
  void
  note_leaning_blocks(const Ground<dim> &ground,
                      const FreeFaces<dim> &free,
                      const Blocks<dim> &blocks,
                      const double time,
                      const double wanted,
                      const std::vector<JudgedBlock<dim>> &judged,
                      JudgedBlock<dim> &below)
  {
    if (below.statics.limit.direction.norm() == 0.)
      return;
    const LeaningBlocks<dim> leaning(
      ground, free, blocks, time, wanted, judged, below);
    if (!leaning.found.empty())
      below.statics.remarks.push_back(remark_on_leaning(
        leaning.found, blocks, wanted > 0. ? leaning.find_more() : 0.));
  }



  template <int dim>
  std::vector<JudgedBlock<dim>>
  judge_leaning_blocks(const Ground<dim> &ground,
                       const FreeFaces<dim> &free,
                       const Blocks<dim> &blocks,
                       const double time,
                       const double wanted,
                       const std::vector<bool> &gone_since)
  {
    auto judged =
      judge_exposed_blocks(ground, free, blocks, time, {}, gone_since);
    for (JudgedBlock<dim> &one : judged)
      note_leaning_blocks(ground, free, blocks, time, wanted, judged, one);
    return judged;
  }

#define INSTANTIATE(dim)                                                       \
  template void note_leaning_blocks(const Ground<dim> &,                       \
                                    const FreeFaces<dim> &,                    \
                                    const Blocks<dim> &,                       \
                                    const double,                              \
                                    const double,                              \
                                    const std::vector<JudgedBlock<dim>> &,     \
                                    JudgedBlock<dim> &);                       \
  template std::vector<JudgedBlock<dim>> judge_leaning_blocks(                 \
    const Ground<dim> &,                                                       \
    const FreeFaces<dim> &,                                                    \
    const Blocks<dim> &,                                                       \
    const double,                                                              \
    const double,                                                              \
    const std::vector<bool> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock
