// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_safety_block_support_h
#define keyblock_safety_block_support_h

#include <keyblock/rock/bolt_chain.h>
#include <keyblock/safety/block_faces.h>

#include <set>

namespace Keyblock
{
  /** What bolts and shotcrete can do for a block: each bolt that goes from it
   * into another one, or into it from there, and the sections of shotcrete
   * that it has to shear. */
  template <int dim>
  struct BlockSupport
  {
    struct Pull
    {
      Point<dim> place;     ///< where it crosses the joint or void [m]
      Tensor<1, dim> along; ///< unit vector, as it pulls the block
      double force                     = 0.; ///< its capacity there [N]
      double dowel_strength            = 0.; ///< across it [N]
      BoltChain::Capacity::Limit limit = BoltChain::Capacity::Limit::yield;
      bool has_plate                   = true; ///< held by rock, at its head
      bool is_reduced    = true; ///< BlockFace::is_reduced of the joint
      unsigned int set   = 0;    ///< index of its set of bolts
      unsigned int bolt  = 0;    ///< index into SplitMesh::bolts
      unsigned int other = none; ///< block that it pulls to, by index
    };
    std::vector<Pull> pulls;

    /** Bolts that would hold it, but have broken. */
    unsigned int n_broken = 0;

    /** Other blocks (by index) that these bolts go through. */
    std::set<unsigned int> shared_with;

    double shotcrete_length   = 0.; ///< of traces under it [m]
    double shotcrete_strength = 0.; ///< of its sections along them [N]

    struct Section
    {
      LinerTrace<dim> trace;
      double strength = 0.;   ///< [N]
      bool is_reduced = true; ///< BlockFace::is_reduced of the joint under it
    };
    std::vector<Section> sections;

    bool has_liner = false;        ///< shotcrete or another liner on it
    Tensor<1, dim> shotcrete_load; ///< of that on the block: weight, and
                                   ///< seismic [N]
    Point<dim> shotcrete_center;   ///< where that acts [m]

    /** Whether there is something that holds the block. */
    bool
    holds() const
    {
      return !pulls.empty() || shotcrete_strength > 0.;
    }

    /** Whether support acts on the block, if only by its weight. */
    bool
    acts() const
    {
      return !pulls.empty() || has_liner;
    }

    /** Sum of the forces along the bolts [N]. */
    Tensor<1, dim> force() const;

    /** Force of one bolt or section on the block. */
    struct Force
    {
      Tensor<1, dim> pull;     ///< along a bolt [N]
      Tensor<1, dim> reaction; ///< across it, or in a section, at most [N]
      bool is_reduced;         ///< in the passive convention
      bool is_of_bolt;         ///< or of shotcrete
    };

    /** Those of all as the block moves along @p direction (unit vector). */
    std::vector<Force> forces_against(const Tensor<1, dim> &direction) const;

    /** Let those of a @p set (index) bear more by a @p share of what they do.
     */
    void add_bolts(const unsigned int set, const double share);

    /** Number, capacity and what limits what holds it, in words; a bolt that
     * goes through the block counts once, where it can bear most. */
    std::string describe() const;
  };

  /** Bolts and shotcrete of @p block (index) that are there at the stage of
   * @p ground, bolts without what has @p broken, the weight of shotcrete at a
   * @p time. */
  template <int dim>
  BlockSupport<dim> find_support_of_block(const Ground<dim> &ground,
                                          const unsigned int block,
                                          const double time,
                                          const BrokenSegments &broken);

  /** Mean capacity of the bolts of a @p set (index), installed or not, where
   * they cross joints [N], in 2D per metre; 0: none crosses any. */
  template <int dim>
  double mean_bolt_capacity(const Ground<dim> &ground, const unsigned int set);

  /** A @p number of bolts of a @p set in words, in 2D with the metres of tunnel
   * that they are for. */
  template <int dim>
  std::string describe_bolts(const Scene<dim> &scene,
                             const std::string &set,
                             const unsigned int number);

  /**
   * Limit equilibrium of a block on @p faces under @p load with its support.
   * Active: the pulls of bolts are a part of the load, as is what dowels and
   * shotcrete do against the way that the block takes then; where these bear
   * all that drives it, nothing does. Passive: of each force its part against
   * the way that the block would take without them is added to what resists
   * (Hoek and Bray 1981); the rest of it is load. What dowels and shotcrete do
   * there is, each by one share of the strength of all, as little as drives the
   * block least, or less if the factor is greater then. Shotcrete that holds
   * all that acts on the block, off its planes, counts so where this gives a
   * greater factor.
   */
  template <int dim>
  LimitEquilibrium<dim> solve_with_support(std::vector<BlockFace<dim>> &faces,
                                           const Tensor<1, dim> &load,
                                           const BlockSupport<dim> &support,
                                           const bool is_passive);

  /** Way that @p block would take without support by limit equilibrium, at a
   * @p time [s]; zero: it cannot move. */
  template <int dim>
  Tensor<1, dim> way_without_support(const Ground<dim> &ground,
                                     const FreeFaces<dim> &free,
                                     const Blocks<dim> &blocks,
                                     const unsigned int block,
                                     const double time);
} // namespace Keyblock

#endif
