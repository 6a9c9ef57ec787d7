// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_blocks_plane_blocks_h
#define keyblock_blocks_plane_blocks_h

#include <keyblock/blocks/blocks.h>
#include <keyblock/blocks/plane_extent.h>

#include <functional>
#include <utility>
#include <vector>

namespace Keyblock
{
  /** A convex part of an excavation. Parts may overlap each other and reach out
   * of the domain; where they overlap the one of the earlier stage counts. */
  template <int dim>
  struct ExcavationPiece
  {
    unsigned int excavation = 0; ///< index; parts of one have the same
    unsigned int stage      = 0; ///< that excavates it, from 1; 0: never rock
    std::vector<HalfSpace<dim>> sides;
  };

  /** What bounds blocks: planes, in 2D lines. */
  template <int dim>
  struct PlaneScene
  {
    BoundingBox<dim> box; ///< of the domain [m]

    /** Of a convex domain within the box; none: it is the box. */
    std::vector<HalfSpace<dim>> sides;

    /** Of each side of the domain: whether rock goes on behind it. Sides of a
     * box have the numbers of faces of a cell of deal.II. */
    std::vector<bool> is_truncated;

    std::vector<ExcavationPiece<dim>> excavations;
    std::vector<JointPiece<dim>> joints;
    double bridging = -1.; ///< `Joints/Bridging` [m]; negative: not given

    /** Whether the first joint (index) rules where it shares a plane with the
     * second; not given: it has the lower index. */
    std::function<bool(unsigned int, unsigned int)> rules;

    /** Index of an excavation that stands for rock beyond the domain, which
     * goes on there; or nothing. */
    unsigned int beyond = ConvexCells<dim>::nothing;
  };

  struct PlaneBlockOptions
  {
    /** How far joints reach beyond their rims [m]: they close against joints
     * that they nearly meet. */
    double bridging = 1e-6;

    /** What rounding leaves [m]: width of openings that do not join two parts
     * of rock, and of faces that are none, and distance of planes that are one.
     */
    double narrow = 1e-6;

    /** Volume below which a block is rounding and goes to one beside it: to one
     * behind a narrow opening, or else behind the largest face [m^dim]. */
    double dust = 1e-9;

    /** Leave out joints that cannot bound an exposed block. Infinite blocks may
     * then be one, and hidden ones that no chain of joints connects with an
     * excavation may be missing; exposed blocks are the same. */
    bool leave_out = false;

    /** Cut along large joints first, which makes fewer cells. */
    bool largest_first = true;
  };

  /** The blocks of a PlaneScene. */
  template <int dim>
  struct PlaneBlocks
  {
    static constexpr unsigned int nothing = ConvexCells<dim>::nothing;

    /** Where a block touches another one along a plane of a joint. */
    struct Face
    {
      unsigned int joint;
      int side;               ///< of the joint on which the block lies: -1, +1
      unsigned int neighbour; ///< index into blocks
      double area;            ///< [m^(dim-1)]
      Tensor<1, dim> normal;  ///< of unit length, into the block
      std::vector<std::vector<Point<dim>>> outlines; ///< convex; 2D: ends [m]
    };

    /** A part of a block's surface that is or becomes free. */
    struct FreeFace
    {
      unsigned int stage;       ///< since when; 0: from the start
      unsigned int excavation;  ///< index; or nothing
      unsigned int domain_side; ///< number; or nothing
      unsigned int joint;       ///< that parts it from what is excavated;
                                ///< nothing: it is attached until then
      double area;              ///< [m^(dim-1)]
      Tensor<1, dim> normal;    ///< of unit length, into the block
      std::vector<Point<dim>> outline; ///< convex; in 2D two ends [m]
    };

    explicit PlaneBlocks(ConvexCells<dim> cells)
      : cells(std::move(cells))
    {}

    /** In the order of rank_blocks(). Not set, as they need materials or a
     * mesh: mass, is_rigid, width, exact; `n_cells` counts convex cells. */
    std::vector<Block<dim>> blocks;
    std::vector<std::vector<Face>> faces;          ///< of each block
    std::vector<std::vector<FreeFace>> free_faces; ///< of each block
    PlaneBlockOptions options;
    unsigned int n_stages      = 0;
    unsigned int n_joints_used = 0; ///< pieces that were not left out

    ConvexCells<dim> cells;
    std::vector<unsigned int> block_of_cell;      ///< index; or nothing
    std::vector<unsigned int> excavation_of_cell; ///< index; or nothing

    /** Index of the joint that closes each of ConvexCells::for_each_contact(),
     * with rock on one side at least; or nothing. */
    std::vector<unsigned int> joint_of_contact;

    /** Joints share places, so that their strengths say which one counts. */
    bool has_shared_places = false;

    /** Index of the block with a point [m]; nothing if it is excavated or not
     * in the domain's box. */
    unsigned int
    block_at(const Point<dim> &point) const
    {
      return block_of_cell[cells.cell_at(point)];
    }
  };

  /**
   * Find the blocks of a scene without a mesh. Joints cut the cells that they
   * overlap. Cells with a polygon between them that a joint does not wholly
   * cover are one block. Throws InputError if the domain is not convex.
   */
  template <int dim>
  PlaneBlocks<dim> find_plane_blocks(const PlaneScene<dim> &scene,
                                     const PlaneBlockOptions &options);
} // namespace Keyblock

#endif
