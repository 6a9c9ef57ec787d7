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
    unsigned int id      = 0; ///< from 1; finite blocks first, largest first
    unsigned int n_cells = 0;
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

    /** The block as its planes bound it, where joints were bent to fit the
     * mesh (measure_exactly()). */
    struct Measures
    {
      bool is_known = false;
      double volume = 0.;                        ///< [m^dim]
      std::map<unsigned int, double> joint_area; ///< in the plane [m^(dim-1)]
      std::map<unsigned int, double> bent_area;  ///< of the same faces as bent
      Point<dim> centroid;                       ///< of the volume [m]

      /** Polygons in the plane by joint, around them as seen from one side; in
       * 2D segments. */
      std::map<unsigned int, std::vector<std::vector<Point<dim>>>> joint_faces;
    };
    Measures exact;

    /** Mass with the exact volume, if it is known [kg], per metre in 2D. */
    double
    exact_mass() const
    {
      return exact.is_known ? mass * exact.volume / volume : mass;
    }

    /** Area of joint @p joint in its plane over that in the mesh [-]. */
    double
    area_ratio(const unsigned int joint) const
    {
      const auto plane = exact.joint_area.find(joint);
      const auto bent  = exact.bent_area.find(joint);
      return plane != exact.joint_area.end() && bent->second > 0.
               ? plane->second / bent->second
               : 1.;
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

    unsigned int n_finite  = 0; ///< between the planes
    unsigned int n_exposed = 0; ///< of these, after the last stage

    struct LostBlock
    {
      double volume; ///< [m^dim]
      Point<dim> centroid;
    };
    std::vector<LostBlock>
      lost; ///< exposed, and not in the mesh; largest first

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
    bool is_unlike(const unsigned int block) const;

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
