// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/safety/block_faces.h>
#include <keyblock/safety/block_stiffness.h>
#include <keyblock/safety/caught_block.h>

namespace Keyblock
{
  namespace
  {
    /** Part of its load that a block would lack without what has caught it [-].
     */
    constexpr double least_borne = 1e-2;
  } // namespace



  template <int dim>
  bool
  is_caught_elsewhere(const Ground<dim> &ground,
                      const Blocks<dim> &blocks,
                      const unsigned int block,
                      const double time,
                      const double distance,
                      const double load,
                      const std::vector<JointSums<dim>> &sums)
  {
    const Block<dim> &shape = blocks.blocks[block];
    if (distance <= size_of_place * shape.size ||
        distance <= compressions_of_place *
                      compression_of_block(ground, block, shape, load))
      return false;
    const auto is_borne_without = [&](const auto &is_own) {
      double borne = is_own(none) ? 0. : sums.back().normal;
      for (unsigned int j = 0; j + 1 < sums.size(); ++j)
        if (!is_own(j))
          borne += sums[j].normal;
      return borne > least_borne * load;
    };
    // (to look around takes long: first those that it touches at the end)
    if (!is_borne_without([&](const unsigned int joint) {
          return shape.joint_area.count(joint) > 0;
        }))
      return false;
    const BlockSurroundings<dim> around =
      look_around(ground, FreeFaces<dim>(ground), shape, time);
    return is_borne_without(
      [&](const unsigned int joint) { return around.touches(joint); });
  }

#define INSTANTIATE(dim)                                                       \
  template bool is_caught_elsewhere(const Ground<dim> &,                       \
                                    const Blocks<dim> &,                       \
                                    const unsigned int,                        \
                                    const double,                              \
                                    const double,                              \
                                    const double,                              \
                                    const std::vector<JointSums<dim>> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock
