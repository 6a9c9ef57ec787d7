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

    bool is_attached   = false; ///< to rock that is not excavated yet
    bool is_on_fill    = false;
    bool has_free_face = false; ///< that touches another one

    /** Whether one of the faces lies on a joint (by index). */
    bool touches(const unsigned int joint) const;

    /** Whether friction of a joint that it touches falls where it slips. */
    bool loses_friction() const;
  };

  /** A face with the strength of a joint that has not slipped, without area or
   * corners.
   * @param inward unit normal, into the block
   * @param joint index, or none
   * @param is_reduced strength reduction divides its strength */
  template <int dim>
  BlockFace<dim> make_block_face(const Tensor<1, dim> &inward,
                                 const std::string &name,
                                 const std::shared_ptr<const JointLaw> &law,
                                 const unsigned int joint,
                                 const bool is_reduced);

  /**
   * What @p block touches and what acts on it at @p time. Water and tractions
   * are summed as Loads does, water by its pressure at the faces'
   * vertices.
   */
  template <int dim>
  BlockSurroundings<dim> look_around(const Ground<dim> &ground,
                                     const FreeFaces<dim> &free,
                                     const Block<dim> &block,
                                     const double time);
} // namespace Keyblock

#endif
