// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_safety_block_faces_h
#define keyblock_safety_block_faces_h

#include <keyblock/blocks/free_faces.h>
#include <keyblock/safety/block_loads.h>
#include <keyblock/safety/limit_equilibrium.h>

#include <set>

namespace Keyblock
{
  /** A block as limit equilibrium sees it. */
  template <int dim>
  struct BlockSurroundings
  {
    /** Joints that it touches, one face per joint and side, and free faces of
     * other rock that its own lie against. */
    std::vector<BlockFace<dim>> faces;

    /** Blocks across each of the faces, by index. */
    std::vector<std::set<unsigned int>> others;

    BlockLoads<dim> loads;

    /** Of a face against its joint's plane [deg]. */
    double largest_bend = 0.;

    /** Of the free faces between the planes over that in the mesh, by their
     * mean normal [-]. */
    double free_area_ratio = 1.;

    std::string bent;           ///< name of the joint that is bent most
    bool is_attached   = false; ///< to rock that is not excavated yet
    bool is_on_fill    = false;
    bool has_free_face = false; ///< that touches another one
  };

  /**
   * What @p block touches and what acts on it at @p time. Water and tractions
   * are summed as Loads does, water by its pressure at the faces'
   * vertices; of a block that is known exactly (Block::exact), weight, areas
   * and water are those between its planes, where the mesh has bent them;
   * tractions are scaled by the ratio of its free areas.
   */
  template <int dim>
  BlockSurroundings<dim> look_around(const Ground<dim> &ground,
                                     const FreeFaces<dim> &free,
                                     const Block<dim> &block,
                                     const double time);
} // namespace Keyblock

#endif
