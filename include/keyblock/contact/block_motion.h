// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_contact_block_motion_h
#define keyblock_contact_block_motion_h

#include <keyblock/blocks/blocks.h>
#include <keyblock/contact/state.h>
#include <keyblock/contact/topology.h>
#include <keyblock/rock/fields.h>

namespace Keyblock
{
  /** How far a block has gone by itself, or how fast it goes. */
  template <int dim>
  struct BlockMotion
  {
    Vector<dim> shift{}; ///< mean, against the rock around [m], or [m/s]
    double spread = 0.;  ///< root mean square about the mean: rotation [same]
    double load   = 0.;  ///< resultant of gravity and tractions [N]

    /** Root mean square of both [same]. */
    double
    way() const
    {
      return std::hypot(norm<dim>(shift), spread);
    }
  };



  /**
   * Motions of blocks, each its own: of two that slide past each other the one
   * that moved.
   *
   * The mean displacements across faces between blocks are differences of the
   * blocks' shifts, of which infinite blocks have none. With rotations they do
   * not fit exactly: shifts are those that fit best, by least squares with the
   * faces' areas. A block whose faces are all on infinite ones has the mean
   * over these. One that touches no rock any more, with all it touches, has its
   * displacement against the mean of the rock's walls.
   */
  template <int dim>
  class BlockMotions
  {
  public:
    BlockMotions(const PairTopology<dim> &topology,
                 const Blocks<dim> &blocks,
                 const Fields<dim> &fields,
                 const ContactMemory<dim> &memory);

    /** By index of the block, since the start; null for infinite blocks
     * (collective). */
    std::vector<BlockMotion<dim>>
    measure() const
    {
      return measure(fields.displacement);
    }

    /** The same of displacements since later, or of velocities.
     * @param motion dim values per local node [m] or [m/s] */
    std::vector<BlockMotion<dim>>
    measure(const std::vector<double> &motion) const;

  private:
    /** Blocks (indices) on either side of faces; `none` for infinite ones and
     * for rock that is to be dug. */
    using Link = std::array<unsigned int, 2>;

    /** Area [m^(dim-1)] and, times that, u(plus) - u(minus), link by link, over
     * all ranks; last the same of u of the rock's walls.
     * @param motion u, dim values per local node */
    std::vector<double> sum_over_faces(const std::vector<double> &motion) const;

    /** Mass [kg], mass times u and mass times its square, block by block, over
     * all ranks. */
    std::vector<double>
    sum_over_masses(const std::vector<double> &motion) const;

    const PairTopology<dim> &topology;
    const Blocks<dim> &blocks;
    const Fields<dim> &fields;
    const ContactMemory<dim> &memory;
    std::vector<Link> links;
    std::vector<unsigned int> link_of_pair; ///< `none` within rock or a block
    std::vector<std::vector<unsigned int>> nodes_of_block;
  };
} // namespace Keyblock

#endif
