// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_blocks_block_resolution_h
#define keyblock_blocks_block_resolution_h

#include <keyblock/blocks/blocks.h>

#include <map>
#include <memory>
#include <utility>

namespace Keyblock
{
  template <int dim>
  struct ExactBlocks; // blocks/exact_blocks.h

  /** Fill Block::width of finite blocks: the least of the distances between two
   * planes that hold the block between them and are parallel to one of its
   * joints or free faces. For convex blocks in 2D that is the least width of
   * all, in 3D near to it. */
  template <int dim>
  void measure_widths(Blocks<dim> &blocks,
                      const Mesh<dim> &mesh,
                      const Scene<dim> &scene);

  /** A larger deviation() is warned of [-]. */
  constexpr double largest_difference = 0.02;

  /** How far a block of the mesh is from that between the planes: the larger of
   * the change of volume, and the part of the area on joints that is on those
   * which the mesh's block does not touch, parts of a bent joint taken together
   * [-]. */
  template <int dim>
  double deviation(const Block<dim> &of_mesh,
                   const double volume,
                   const std::map<unsigned int, double> &joint_area,
                   const Scene<dim> &scene);

  /** Whether a finite block has fewer cells across than Mesh/Cells across
   * blocks asks for. */
  template <int dim>
  bool
  is_too_coarse(const Block<dim> &block, const Scene<dim> &scene)
  {
    return !block.is_infinite &&
           block.cells_across() < scene.meshing.cells_across;
  }

  /**
   * Mesh the scene and find its blocks. Blocks that only the mesh has closed
   * are joined to the rock again (weld_phantoms()). With Mesh/Cells across
   * blocks the scene is meshed again with smaller cells where finite blocks
   * near excavations have fewer cells across, and where rock between joints was
   * too thin to become a block. For all ranks together; throws as make_mesh().
   * @param exact are found before; null: there are no joints, or no planes
   */
  template <int dim>
  std::pair<Mesh<dim>, Blocks<dim>>
  make_mesh_for_blocks(const Communicator &communicator,
                       const Scene<dim> &scene,
                       std::unique_ptr<ExactBlocks<dim>> &exact,
                       const dealii::ConditionalOStream &out);
} // namespace Keyblock

#endif
