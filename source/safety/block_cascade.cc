// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/number_text.h>
#include <keyblock/safety/block_cascade.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace Keyblock
{
  namespace
  {
    /** Decrease of a factor that counts as one [-]. */
    constexpr double least_decrease = 1e-9;

    /** Ids of the blocks that are gone among the neighbours of one. */
    template <int dim>
    std::set<unsigned int>
    gone_among(const std::vector<std::set<unsigned int>> &neighbors,
               const std::vector<bool> &is_gone,
               const Blocks<dim> &blocks)
    {
      std::set<unsigned int> ids;
      for (const std::set<unsigned int> &others : neighbors)
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

    /** Ids of the blocks across joints of one that are gone. */
    template <int dim>
    std::set<unsigned int>
    gone_across_joints(const Ground<dim> &ground,
                       const FreeFaces<dim> &free,
                       const std::vector<bool> &is_gone,
                       const Blocks<dim> &blocks,
                       const unsigned int block)
    {
      std::set<unsigned int> ids;
      for (const unsigned int i : free.joint_faces_of_block(block))
        {
          const JointFace &face = ground.split.interface.joint_faces[i];
          for (const unsigned int cell : {face.minus_cell, face.plus_cell})
            if (const unsigned int other = ground.split.block_of_cell[cell];
                other != none && other != block && is_gone[other])
              ids.insert(blocks.blocks[other].id);
        }
      return ids;
    }

    /** Judge hidden blocks that have a free face without those that are gone;
     * one that went with them as it was between what is left.
     * @param free_now the free faces without them, made where they matter */
    template <int dim>
    void
    add_uncovered(const Ground<dim> &ground,
                  const std::vector<bool> &is_gone,
                  const FreeFaces<dim> &free,
                  std::unique_ptr<FreeFaces<dim>> &free_now,
                  const Blocks<dim> &blocks,
                  const double time,
                  const BrokenSegments &broken,
                  std::vector<JudgedBlock<dim>> &judged)
    {
      if (std::none_of(is_gone.begin(), is_gone.end(), [](const bool gone) {
            return gone;
          }))
        return;
      const std::vector<bool> before = removed_from(ground, is_gone.size());
      std::vector<bool> is_asked     = before;
      for (const JudgedBlock<dim> &one : judged)
        is_asked[one.block] = true;
      for (unsigned int b = 0; b < is_gone.size(); ++b)
        {
          if (is_asked[b] ||
              class_now(ground, blocks.blocks[b]) != BlockClass::hidden)
            continue;
          std::vector<bool> others = is_gone;
          others[b]                = false;
          std::set<unsigned int> gone =
            gone_across_joints(ground, free, others, blocks, b);
          if (gone.empty())
            continue;
          const Ground<dim> later{ground.scene,
                                  ground.split,
                                  ground.stage_number,
                                  &others};
          std::unique_ptr<FreeFaces<dim>> own;
          if (auto &faces = is_gone[b] ? own : free_now; !faces)
            faces = std::make_unique<FreeFaces<dim>>(later);
          const FreeFaces<dim> &free_later = is_gone[b] ? *own : *free_now;
          if (free_later.of_block(b).empty())
            continue;
          JudgedBlock<dim> one{
            b, judge_block(later, free_later, blocks, b, time, broken), 0., {}};
          one.least_factor = one.statics.limit.factor;
          for (unsigned int other = 0; other < before.size(); ++other)
            if (before[other])
              gone.erase(blocks.blocks[other].id);
          one.is_uncovered = !gone.empty();
          if (one.is_uncovered && std::isfinite(one.least_factor))
            one.once_gone = {{gone.begin(), gone.end()},
                             one.least_factor,
                             one.statics.mode()};
          judged.push_back(std::move(one));
        }
    }
  } // namespace



  template <int dim>
  std::vector<JudgedBlock<dim>>
  judge_exposed_blocks(const Ground<dim> &ground,
                       const FreeFaces<dim> &free,
                       const Blocks<dim> &blocks,
                       const double time,
                       const BrokenSegments &broken,
                       const std::vector<bool> &gone_since)
  {
    std::vector<JudgedBlock<dim>> judged;
    std::vector<bool> is_gone = removed_from(ground, blocks.blocks.size());
    for (unsigned int b = 0; b < blocks.blocks.size(); ++b)
      if (!is_gone[b] && !blocks.is_unlike(b) &&
          class_now(ground, blocks.blocks[b]) == BlockClass::exposed)
        {
          judged.push_back(
            {b, judge_block(ground, free, blocks, b, time, broken), 0., {}});
          judged.back().least_factor = judged.back().statics.limit.factor;
        }
    std::unique_ptr<FreeFaces<dim>> free_later;
    add_uncovered(
      ground, is_gone, free, free_later, blocks, time, broken, judged);
    bool is_new = false;
    for (unsigned int b = 0; b < gone_since.size(); ++b)
      if (gone_since[b] && !is_gone[b])
        is_new = is_gone[b] = true;
    while (true)
      {
        for (const JudgedBlock<dim> &one : judged)
          if (!is_gone[one.block] && one.least_factor < 1.)
            is_new = is_gone[one.block] = true;
        if (!std::exchange(is_new, false))
          break;
        const Ground<dim> later{ground.scene,
                                ground.split,
                                ground.stage_number,
                                &is_gone};
        free_later.reset();
        for (JudgedBlock<dim> &one : judged)
          {
            const std::set<unsigned int> gone =
              gone_among(one.statics.around.others, is_gone, blocks);
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
        add_uncovered(
          ground, is_gone, free, free_later, blocks, time, broken, judged);
      }
    for (JudgedBlock<dim> &one : judged)
      if (!one.once_gone.blocks.empty())
        one.statics.remarks.push_back(
          (one.is_uncovered && one.least_factor == one.statics.limit.factor
             ? "with a free face only"
             : text_of(one.once_gone.factor, 4) + ", " + one.once_gone.mode +
                 ",") +
          " once " + text_of_ids(one.once_gone.blocks));
    return judged;
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
        const Ground<dim> ground{scene, split.rigid(), number, nullptr};
        action(ground, FreeFaces<dim>(ground));
      }
  }

#define INSTANTIATE(dim)                                                       \
  template std::vector<JudgedBlock<dim>> judge_exposed_blocks(                 \
    const Ground<dim> &,                                                       \
    const FreeFaces<dim> &,                                                    \
    const Blocks<dim> &,                                                       \
    const double,                                                              \
    const BrokenSegments &,                                                    \
    const std::vector<bool> &);                                                \
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
