// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_blocks_free_faces_h
#define keyblock_blocks_free_faces_h

#include <deal.II/numerics/rtree.h>

#include <keyblock/blocks/ground.h>

#include <optional>

namespace Keyblock
{
  /** The free faces of the rock at a stage, which of them is ahead of a point
   * that moves, and what belongs to each block, so that it is looked for once.
   */
  template <int dim>
  class FreeFaces
  {
  public:
    explicit FreeFaces(const Ground<dim> &ground);

    /** A face that faces the motion, and the way to it. */
    struct Meeting
    {
      double distance = 0.; ///< [m]
      CellFace face{none, none};
    };

    /**
     * The first face of another block than @p own (index) that a point meets
     * on its way from @p from along @p direction (unit vector), from @p behind
     * before the point to @p reach ahead of it [m].
     */
    std::optional<Meeting> first_ahead(const Point<dim> &from,
                                       const Tensor<1, dim> &direction,
                                       const double behind,
                                       const double reach,
                                       const unsigned int own) const;

    /**
     * The first face of another block that the free faces of @p block (index)
     * meet on the way along @p direction (unit vector), at most @p reach [m]:
     * by their corners and centres, and by the corners of what is ahead.
     */
    std::optional<Meeting> first_met(const unsigned int block,
                                     const Tensor<1, dim> &direction,
                                     const double reach) const;

    const std::vector<CellFace> faces;

    /** Indices into faces, by block. */
    const std::vector<unsigned int> &of_block(const unsigned int block) const;

    /** Cells of the split mesh that belong to a block, excavated ones too. */
    const std::vector<unsigned int> &
    cells_of_block(const unsigned int block) const;

    /** Indices into Interface::joint_faces of those with the block on either
     * side. */
    const std::vector<unsigned int> &
    joint_faces_of_block(const unsigned int block) const;

  private:
    using Entry = std::pair<dealii::BoundingBox<dim>, unsigned int>;

    /** The first face for which @p is_wanted(CellFace) holds and that faces a
     * motion along @p direction: as first_ahead(). */
    template <typename IsWanted>
    std::optional<Meeting> first_hit(const Point<dim> &from,
                                     const Tensor<1, dim> &direction,
                                     const double behind,
                                     const double reach,
                                     const IsWanted &is_wanted) const;

    /** Corners of a face, drawn a little towards its centre, so that they are
     * on no other, and the centre. */
    std::vector<Point<dim>> probes_of(const CellFace &face) const;

    const SplitMesh<dim> &split;
    using ByBlock = std::vector<std::vector<unsigned int>>;
    ByBlock by_block, cells_by_block, joint_faces_by_block;
    dealii::RTree<Entry> tree;
  };
} // namespace Keyblock

#endif
