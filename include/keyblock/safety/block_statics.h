// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_safety_block_statics_h
#define keyblock_safety_block_statics_h

#include <keyblock/safety/block_rotation.h>
#include <keyblock/safety/block_support.h>
#include <keyblock/safety/support_demand.h>

#include <iosfwd>

namespace Keyblock
{
  /** How a block with its support would move. */
  template <int dim>
  struct SupportedMotion
  {
    LimitEquilibrium<dim> limit; ///< rotation included
    Rotation rotation;
    double factor_of_sliding; ///< without rotation
  };

  /** That of a block with @p around and @p support: along faces, about the end
   * of its base, or where moments are not balanced (balances_moments()),
   * whichever has the least factor. */
  template <int dim>
  SupportedMotion<dim> find_motion(BlockSurroundings<dim> &around,
                                   const BlockSupport<dim> &support,
                                   const bool is_passive);

  /** Demands over the load of a block that are none, and that are looked at
   * [-]. */
  constexpr double least_demand = 1e-3, most_demand = 1e4;

  /** Free faces of a block (by index) that support can press on: all but, for
   * one with a face that was dug, the ground's surface where it leaves that
   * along @p way. */
  template <int dim>
  std::vector<CellFace> list_supported_faces(const Ground<dim> &ground,
                                             const FreeFaces<dim> &free,
                                             const unsigned int block,
                                             const Tensor<1, dim> &way);

  /** Sum of the vector areas of faces, outwards [m^(dim-1)]; 0 where they
   * cancel each other, as those on both ends of a block do, but for round-off.
   */
  template <int dim>
  Tensor<1, dim> sum_of_areas(const Mesh<dim> &mesh,
                              const std::vector<CellFace> &faces);

  /** Bolts of the scene's sets of which a block (by index) has none, that give
   * @p force [N] together, each its mean capacity. */
  template <int dim>
  std::vector<std::pair<std::string, unsigned int>>
  list_new_bolts(const Ground<dim> &ground,
                 const BlockSupport<dim> &support,
                 const double force);

  /** What @p block (index) needs besides its support for a @p factor; nothing
   * if it has that. */
  template <int dim>
  SupportDemand find_demand(const Ground<dim> &ground,
                            const FreeFaces<dim> &free,
                            const unsigned int block,
                            const BlockSurroundings<dim> &around,
                            const BlockSupport<dim> &support,
                            const double factor);

  /** What may make strength reduction differ from limit equilibrium. */
  struct BlockFacts
  {
    /** Limit equilibrium knows all that acts on the block: there is no initial
     * stress, no support acts on it, and friction of its joints stays. */
    bool is_complete = false;

    bool loses_friction = false; ///< of one of its joints, where it slips
    bool bears_tension  = false; ///< one of its joints
  };

  /** What limit equilibrium says of a block at a stage. */
  template <int dim>
  struct BlockStatics
  {
    BlockSurroundings<dim> around;
    BlockSupport<dim> support;
    LimitEquilibrium<dim> limit;
    LimitEquilibrium<dim> alone;      ///< without those that bolts tie to it
                                      ///< and that stand with it
    std::vector<unsigned int> others; ///< that it moves with, by index
    SupportDemand demand;             ///< of SafetySettings::wanted
    BlockFacts facts;

    /** What is special, and what was left out. */
    std::vector<std::string> remarks;

    std::string
    mode() const
    {
      return limit.describe(around.faces);
    }

    /** The remarks, separated by semicolons. */
    std::string remark() const;

    /** Weight, what else acts, and what the faces carry, in words [kN]. */
    std::string forces() const;
  };

  /**
   * Mode and factor of a block (by index) by limit equilibrium at @p time [s]:
   * rigid, between neighbours that stay where they are, without the in-situ
   * stress, under its weight, tractions, water and the seismic coefficient.
   * Needs no run, only the scene and its mesh, and of a run what bolts have
   * @p broken there. What bears on the block and is left out is said in the
   * remarks.
   */
  template <int dim>
  BlockStatics<dim> judge_block(const Ground<dim> &ground,
                                const FreeFaces<dim> &free,
                                const Blocks<dim> &blocks,
                                const unsigned int block,
                                const double time,
                                const BrokenSegments &broken = {});

  /** Whether the rock is under stress before anything is excavated, which limit
   * equilibrium leaves out. */
  template <int dim>
  bool has_initial_stress(const Scene<dim> &scene);

  /**
   * The table for people: of each block with a free face its factor, mode and
   * forces with the strength and the loads of time zero, after each stage that
   * changes them.
   */
  template <int dim>
  void print_block_statics(std::ostream &out,
                           const Scene<dim> &scene,
                           const SplitMesh<dim> &split,
                           const Blocks<dim> &blocks);
} // namespace Keyblock

#endif
