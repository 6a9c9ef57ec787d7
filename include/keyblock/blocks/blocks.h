// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_blocks_blocks_h
#define keyblock_blocks_blocks_h

#include <keyblock/mesh/mesh.h>

#include <cmath>
#include <iosfwd>
#include <map>
#include <string>
#include <vector>

namespace Keyblock
{
  /** What a block is at one stage of the excavation. */
  enum class BlockClass
  {
    attached, ///< joined to rock that is not excavated yet
    exposed,  ///< finite, with a free face
    hidden,   ///< finite, without a free face
    infinite, ///< touches the truncated boundary of the model
    rigid     ///< a rigid body
  };

  std::string to_string(const BlockClass block_class);

  /** A connected piece of the rock that is left after the last stage. */
  template <int dim>
  struct Block
  {
    unsigned int id      = 0;  ///< from 1; finite blocks first, largest first
    unsigned int n_cells = 0;  ///< 0: only the planes have it
    double volume        = 0.; ///< [m^dim]
    double mass          = 0.; ///< [kg], per metre in 2D
    Point<dim> centroid;       ///< of the volume [m]
    bool is_infinite = false;
    bool is_rigid    = false;

    /** Whether some direction leaves every joint face without penetration
     * (Goodman and Shi 1985), with the free faces of the last stage. */
    bool is_removable = false;

    /** First stage with a free face; 0: from the start; `none`: never. */
    unsigned int exposed_stage = none;

    std::vector<BlockClass> class_of_stage; ///< index 0: before stage 1

    /** Area [m^(dim-1)] on each joint, by index of the joint. */
    std::map<unsigned int, double> joint_area;

    /** Sign of the block's side of each joint it touches: -1, +1. */
    std::map<unsigned int, int> joint_side;

    /** Diameter of the sphere around its centroid that holds its cells [m]. */
    double size = 0.;

    /** Least extent along the normals of its faces [m]; 0 if infinite. */
    double width = 0.;

    /** Width over the mean size of the cells [-]. */
    double
    cells_across() const
    {
      return width / std::pow(volume / n_cells, 1. / dim);
    }

    /** The block as planes bound it, whatever the mesh made of it
     * (number_like_planes()); where it has no cells all else is that, too. */
    struct Measures
    {
      bool is_known = false;
      double volume = 0.;                        ///< [m^dim]
      double mass   = 0.;                        ///< [kg], per metre in 2D
      std::map<unsigned int, double> joint_area; ///< [m^(dim-1)]
      Point<dim> centroid;                       ///< of the volume [m]
    };
    Measures exact;

    double
    best_volume() const
    {
      return exact.is_known ? exact.volume : volume;
    }

    double
    best_mass() const
    {
      return exact.is_known ? exact.mass : mass;
    }
  };

  /** How the blocks of a mesh differ from those that the planes of its scene
   * bound. A block is the same in both if each has more than half of the other.
   */
  template <int dim>
  struct BlockComparison
  {
    /** The scene has planes, and a mesh that may leave them. */
    bool is_known = false;

    /** How far joints may end before another one and close against it [m]. */
    double bridging = 0.;

    unsigned int n_finite  = 0; ///< between the planes
    unsigned int n_exposed = 0; ///< of these, after the last stage

    /** Exposed blocks (index) that the mesh has not. */
    std::vector<unsigned int> lost;

    /** Exposed blocks of the mesh (index) that are none between the planes:
     * several in one, a part of one, or open to the rock. */
    std::vector<unsigned int> unlike;
  };

  /** The blocks of a mesh: rock that joints, excavations and the domain's
   * boundary bound. */
  template <int dim>
  struct Blocks
  {
    std::vector<Block<dim>> blocks;

    /** Index into blocks of each cell; `none` for cells that are excavated out.
     */
    std::vector<unsigned int> block_of_cell;

    unsigned int n_stages = 0; ///< of excavation

    /** Sign codes (Chen, Xiao and Chen 2020, equation 4) among the rock that is
     * left: what the sign test alone would take for blocks. */
    unsigned int n_sign_codes = 0;

    BlockComparison<dim> comparison;

    /** Whether a block (index) is none of those between the planes, so that it
     * gets no factor. */
    bool
    is_unlike(const unsigned int block) const
    {
      return comparison.is_known && !blocks[block].is_infinite &&
             !blocks[block].exact.is_known;
    }

    /** Whether the nodes on a face are to be duplicated. */
    bool is_split(const Mesh<dim> &mesh,
                  const unsigned int cell,
                  const unsigned int face,
                  const bool weld_infinite_blocks) const;
  };

  /**
   * Sign code of each cell against each joint (Chen, Xiao and Chen 2020,
   * equations 2 to 4), +1 or -1; cells by rows, joints by columns.
   */
  template <int dim>
  std::vector<std::vector<signed char>> sign_code(const Mesh<dim> &mesh,
                                                  const Scene<dim> &scene);

  /**
   * Group cells that share a face which lies on no joint and on no excavation
   * outline, then classify and measure the groups.
   */
  template <int dim>
  Blocks<dim> find_blocks(const Mesh<dim> &mesh, const Scene<dim> &scene);

  /**
   * Whether a direction d other than zero exists with n.d >= 0 for all of the
   * normals @p inward, which point into the block: the joint pyramid is not
   * empty, the block is not tapered. No normals: removable.
   */
  template <int dim>
  bool is_removable(const std::vector<Tensor<1, dim>> &inward);

  /** Order of blocks by which they are numbered: finite ones first, larger
   * before smaller, equal ones by place. */
  template <int dim>
  std::vector<unsigned int> rank_blocks(const std::vector<Block<dim>> &blocks);

  /** The block table for people: exposed blocks first, and 40 at most. */
  template <int dim>
  void print_block_table(std::ostream &out,
                         const Blocks<dim> &blocks,
                         const Scene<dim> &scene);
} // namespace Keyblock

#endif
