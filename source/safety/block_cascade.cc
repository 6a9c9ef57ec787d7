// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/number_text.h>
#include <keyblock/safety/block_cascade.h>

#include <algorithm>
#include <set>

namespace Keyblock
{
  namespace
  {
    /** Decrease of a factor that counts as one [-]. */
    constexpr double least_decrease = 1e-9;

    template <int dim>
    std::vector<bool>
    removed_from(const Ground<dim> &ground, const std::size_t n_blocks)
    {
      return ground.is_removed && !ground.is_removed->empty()
               ? *ground.is_removed
               : std::vector<bool>(n_blocks, false);
    }

    /** Ids of the blocks that are gone among the neighbours of one. */
    template <int dim>
    std::set<unsigned int>
    gone_beside(const BlockStatics<dim> &statics,
                const std::vector<bool> &is_gone,
                const Blocks<dim> &blocks)
    {
      std::set<unsigned int> ids;
      for (const std::set<unsigned int> &others : statics.around.others)
        for (const unsigned int other : others)
          if (is_gone[other])
            ids.insert(blocks.blocks[other].id);
      return ids;
    }

    std::string
    text_of_ids(const std::vector<unsigned int> &ids)
    {
      std::string text = ids.size() == 1 ? "block " : "blocks ";
      for (const unsigned int id : ids)
        text += (id == ids.front() ? "" : ", ") + std::to_string(id);
      return text + (ids.size() == 1 ? " has gone" : " have gone");
    }
  } // namespace



  template <int dim>
  std::vector<JudgedBlock<dim>>
  judge_exposed_blocks(const Ground<dim> &ground,
                       const FreeFaces<dim> &free,
                       const Blocks<dim> &blocks,
                       const double time,
                       const BrokenSegments &broken)
  {
    std::vector<JudgedBlock<dim>> judged;
    std::vector<bool> is_gone = removed_from(ground, blocks.blocks.size());
    for (unsigned int b = 0; b < blocks.blocks.size(); ++b)
      {
        const auto &classes = blocks.blocks[b].class_of_stage;
        if (!is_gone[b] && classes[std::min<std::size_t>(ground.stage_number,
                                                         classes.size() - 1)] ==
                             BlockClass::exposed)
          {
            judged.push_back(
              {b, judge_block(ground, free, blocks, b, time, broken), 0., {}});
            judged.back().least_factor = judged.back().statics.limit.factor;
          }
      }
    for (bool is_new = true; is_new;)
      {
        is_new = false;
        for (const JudgedBlock<dim> &one : judged)
          if (!is_gone[one.block] && one.least_factor < 1.)
            is_new = is_gone[one.block] = true;
        if (!is_new)
          break;
        const Ground<dim> later{ground.scene,
                                ground.split,
                                ground.stage_number,
                                &is_gone};
        std::unique_ptr<FreeFaces<dim>> free_later;
        for (JudgedBlock<dim> &one : judged)
          {
            const std::set<unsigned int> gone =
              gone_beside(one.statics, is_gone, blocks);
            if (is_gone[one.block] || gone.empty())
              continue;
            if (!free_later)
              free_later = std::make_unique<FreeFaces<dim>>(later);
            const BlockStatics<dim> then =
              judge_block(later, *free_later, blocks, one.block, time, broken);
            if (!(then.limit.factor < (1. - least_decrease) * one.least_factor))
              continue;
            one.least_factor = then.limit.factor;
            one.once_gone    = {{gone.begin(), gone.end()},
                                then.limit.factor,
                                then.mode()};
          }
      }
    for (JudgedBlock<dim> &one : judged)
      if (!one.once_gone.blocks.empty())
        one.statics.remarks.push_back(text_of(one.once_gone.factor, 4) + ", " +
                                      one.once_gone.mode + ", once " +
                                      text_of_ids(one.once_gone.blocks));
    return judged;
  }



  template <int dim>
  void
  note_leaning_blocks(const Ground<dim> &ground,
                      const Blocks<dim> &blocks,
                      const double time,
                      std::vector<JudgedBlock<dim>> &judged)
  {
    for (JudgedBlock<dim> &below : judged)
      {
        if (below.statics.limit.direction.norm() == 0.)
          continue;
        std::vector<bool> is_gone = removed_from(ground, blocks.blocks.size());
        is_gone[below.block]      = true;
        const Ground<dim> later   = {ground.scene,
                                     ground.split,
                                     ground.stage_number,
                                     &is_gone};
        std::unique_ptr<FreeFaces<dim>> free;
        for (const JudgedBlock<dim> &other : judged)
          {
            if (other.block == below.block ||
                gone_beside(other.statics, is_gone, blocks)
                    .count(blocks.blocks[below.block].id) == 0)
              continue;
            if (!free)
              free = std::make_unique<FreeFaces<dim>>(later);
            if (judge_block(later, *free, blocks, other.block, time)
                  .limit.factor <
                (1. - least_decrease) * other.statics.limit.factor)
              below.statics.remarks.push_back(
                "block " + std::to_string(blocks.blocks[other.block].id) +
                " may lean on it, left out");
          }
      }
  }



  template <int dim>
  std::vector<Tensor<1, dim>>
  find_ways_without_support(const Ground<dim> &ground,
                            const FreeFaces<dim> &free,
                            const Blocks<dim> &blocks,
                            const std::vector<bool> &is_wanted,
                            const double time)
  {
    const unsigned int n = blocks.blocks.size();
    std::vector<Tensor<1, dim>> ways(n);
    std::vector<unsigned int> closed_in;
    for (unsigned int b = 0; b < n; ++b)
      if (is_wanted[b])
        {
          ways[b] = way_without_support(ground, free, blocks, b, time);
          if (ways[b].norm() == 0. &&
              find_support_of_block(ground, b, time, {}).holds())
            closed_in.push_back(b);
        }
    std::vector<bool> is_gone = removed_from(ground, n);
    const Ground<dim> later{ground.scene,
                            ground.split,
                            ground.stage_number,
                            &is_gone};
    std::unique_ptr<FreeFaces<dim>> free_later;
    while (!closed_in.empty())
      {
        const FreeFaces<dim> &free_now = free_later ? *free_later : free;
        std::vector<unsigned int> going;
        for (unsigned int b = 0; b < n; ++b)
          if (const Block<dim> &block = blocks.blocks[b];
              !block.is_infinite && !block.is_rigid && !is_gone[b] &&
              !free_now.of_block(b).empty() &&
              way_without_support(later, free_now, blocks, b, time).norm() > 0.)
            going.push_back(b);
        if (going.empty())
          break;
        for (const unsigned int b : going)
          is_gone[b] = true;
        free_later         = std::make_unique<FreeFaces<dim>>(later);
        const auto has_way = [&](const unsigned int b) {
          ways[b] = way_without_support(later, *free_later, blocks, b, time);
          return ways[b].norm() > 0.;
        };
        closed_in.erase(std::remove_if(closed_in.begin(),
                                       closed_in.end(),
                                       has_way),
                        closed_in.end());
      }
    return ways;
  }



  template <int dim>
  void
  for_each_changed_ground(const Scene<dim> &scene,
                          const SplitMesh<dim> &split,
                          const GroundAction<dim> &action)
  {
    for (unsigned int number = 1; number < scene.stages.size() + 2; ++number)
      {
        if (number > 1 && !is_changing(scene, number))
          continue;
        const Ground<dim> ground{scene, split, number, nullptr};
        action(ground, FreeFaces<dim>(ground));
      }
  }

#define INSTANTIATE(dim)                                                       \
  template void note_leaning_blocks(const Ground<dim> &,                       \
                                    const Blocks<dim> &,                       \
                                    const double,                              \
                                    std::vector<JudgedBlock<dim>> &);          \
  template std::vector<JudgedBlock<dim>> judge_exposed_blocks(                 \
    const Ground<dim> &,                                                       \
    const FreeFaces<dim> &,                                                    \
    const Blocks<dim> &,                                                       \
    const double,                                                              \
    const BrokenSegments &);                                                   \
  template std::vector<Tensor<1, dim>> find_ways_without_support(              \
    const Ground<dim> &,                                                       \
    const FreeFaces<dim> &,                                                    \
    const Blocks<dim> &,                                                       \
    const std::vector<bool> &,                                                 \
    const double);                                                             \
  template void for_each_changed_ground(const Scene<dim> &,                    \
                                        const SplitMesh<dim> &,                \
                                        const GroundAction<dim> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock
