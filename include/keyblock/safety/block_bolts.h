// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_safety_block_bolts_h
#define keyblock_safety_block_bolts_h

#include <keyblock/rock/bolt_chain.h>
#include <keyblock/safety/block_faces.h>

namespace Keyblock
{
  /** What bolts can do for a block: each bolt that goes from it into another
   * one, or into it from there. */
  template <int dim>
  struct BlockBolts
  {
    struct Pull
    {
      Point<dim> place;     ///< where it crosses the joint [m]
      Tensor<1, dim> along; ///< unit vector, as it pulls the block
      double force                     = 0.; ///< its capacity there [N]
      double dowel_strength            = 0.; ///< across it [N]
      BoltChain::Capacity::Limit limit = BoltChain::Capacity::Limit::yield;
    };
    std::vector<Pull> pulls;

    /** Sum of the forces along the bolts [N]. */
    Tensor<1, dim> force() const;

    /** Sum of what dowels do against a motion of the block along @p direction
     * (unit vector) [N]. */
    Tensor<1, dim> dowel_force(const Tensor<1, dim> &direction) const;

    /** Number, capacity and what limits them, in words. */
    std::string describe() const;
  };

  /** The bolts of @p block (index) that are installed at the stage of
   * @p ground. */
  template <int dim>
  BlockBolts<dim> find_bolts_of_block(const Ground<dim> &ground,
                                      const unsigned int block);

  /**
   * Limit equilibrium of a block on @p faces under @p load with bolts.
   * Active: their forces are a part of the load. Passive: of their part along
   * the way that the block would take without them, what is against it is added
   * to what resists (Hoek and Bray 1981).
   */
  template <int dim>
  LimitEquilibrium<dim> solve_with_bolts(std::vector<BlockFace<dim>> &faces,
                                         const Tensor<1, dim> &load,
                                         const BlockBolts<dim> &bolts,
                                         const bool is_passive);

  /** What a wanted factor of a block asks for besides the support it has. */
  struct SupportDemand
  {
    double force    = 0.; ///< against the free faces; infinite: none does [N]
    double pressure = 0.; ///< the same, uniform on the free faces [Pa]

    /** The same by bolts of the scene's sets normal to the free faces. */
    std::vector<std::pair<std::string, unsigned int>> numbers;
  };

  /** Demand of @p block (index) for a @p factor; nothing if it has that. */
  template <int dim>
  SupportDemand find_demand(const Ground<dim> &ground,
                            const FreeFaces<dim> &free,
                            const unsigned int block,
                            const BlockSurroundings<dim> &around,
                            const BlockBolts<dim> &bolts,
                            const double factor);
} // namespace Keyblock

#endif
