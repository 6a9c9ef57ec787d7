// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_safety_trial_measures_h
#define keyblock_safety_trial_measures_h

#include <keyblock/safety/support_state.h>
#include <keyblock/safety/tied_blocks.h>
#include <keyblock/step/snapshot.h>

#include <string>

namespace Keyblock
{
  /** What a trial measures of a block in the present state of a run. Blocks
   * are given by index. */
  template <int dim>
  class TrialMeasures
  {
  public:
    TrialMeasures(const Scene<dim> &scene,
                  const SplitMesh<dim> &split,
                  const Blocks<dim> &blocks,
                  const Numbering<dim> &numbering,
                  const RunParts<dim> &run);

    struct Motion
    {
      /** Mean slip on its contacts, or, where the strength of all joints or of
       * rock is reduced or it is carried, its displacement [m]. */
      Vector<dim> slip{};

      Vector<dim> displacement{}; ///< of its masses, mean [m]
      Vector<dim> velocity{};     ///< of its masses, mean [m/s]
      double unbalanced = 0.;     ///< everything but damping over the loads [-]
      double load       = 0.;     ///< these [N]
    };

    /** Of the block that is tried (collective). */
    Motion motion(const TriedBlocks &tried) const;

    /** How far a block has moved against what it touches between two states:
     * the slip on its contacts, but no more than its own displacement, since a
     * neighbour that slides past a block at rest slips on it, too [m]. */
    static double way_between(const Motion &from, const Motion &to);

    /** Largest resultant over the load of the block that is tried, of those
     * that hang on it, or it on them, in whatever row, by what support ties
     * together, and, over the load of the tried one if that is larger, of those
     * that lean on it: a block is not at rest while those move whose load comes
     * on it later (collective) [-].
     * @param own of the block that is tried */
    double largest_unbalanced(const TriedBlocks &tried,
                              const Motion &own) const;

    /** What elements do now to the blocks that are tried and to those tied to
     * them (collective). */
    SupportState<dim> support(const TriedBlocks &tried) const;

    /** Steps in a swing of blocks on their elements, by Rayleigh's quotient of
     * how they have moved in a time, at whose ends @p block has these motions;
     * 0: elements bear no more than before, so that nothing may yet hold it. */
    double swing_period(const unsigned int block,
                        const SupportState<dim> &from,
                        const SupportState<dim> &to,
                        const Motion &before,
                        const Motion &now) const;

    /** How far @p block has left the place where limit equilibrium judges it
     * [m]; 0: by less than a twentieth of its size (collective). */
    double way_from_place(const unsigned int block) const;

    /** Whether @p block and what it touches are no more where they were, by a
     * mean slip of @p slip [m] on its contacts: if the block did not move, a
     * neighbour has. */
    bool has_passed(const unsigned int block, const double slip) const;

    /** What holds @p block against @p way (unit vector; zero: its load) now, in
     * words: every kind of support that bears a tenth of its load, and, if that
     * is left a tenth, clamping, or what it lies on if it has left its place
     * (collective). */
    std::string list_holders(const unsigned int block,
                             const Tensor<1, dim> &way) const;

    /** Blocks (by index) that supports hold in their places, see
     * mark_guided_blocks() (collective). */
    std::vector<bool> guided_blocks() const;

    /** Cells that a wave crosses in a fourth of the block's lowest period,
     * those along its size. */
    double n_across(const unsigned int block) const;

    /** Steps in that period, with scaled density: a wave crosses one cell a
     * step, and the block four times. */
    unsigned int period(const unsigned int block) const;

    /** Period of the slowest of the blocks that may move over that of the one
     * that is tried [-]. Those that lean on it may be slender and rock, as many
     * times more slowly than they are longer than thick, roughly, unless
     * in-situ stress clamps them (collective). */
    double slowness(const TriedBlocks &tried) const;

    /** What passes through the block from joint to joint, half the sum of the
     * normal forces on these: in-situ stress may make it many times its load
     * (collective) [N]. */
    double force_through(const unsigned int block) const;

    /** Largest slip by which the compliant ones of the block's joints bear
     * their shear (collective) [m]. */
    double elastic_slip(const unsigned int block) const;

    /** By how much @p load [N] compresses the block [m]. */
    double compression(const unsigned int block, const double load) const;

    /** Largest speed of compression waves in the block [m/s]. */
    double wave_speed(const unsigned int block) const;

    /** Of the block that is tried and of those that lean on it [J]
     * (collective). */
    double kinetic_energy(const TriedBlocks &tried) const;

    /** [kg] (collective). */
    double mass_in_use(const unsigned int block) const;

    /** Bonds of the block's joints that are intact (collective). */
    unsigned int n_intact(const unsigned int block) const;

    const TiedBlocks<dim> tied;

    /** Local ones of each block, owned by this rank. */
    const std::vector<std::vector<unsigned int>> nodes_of_block;

  private:
    const Communicator communicator;
    const Scene<dim> &scene;
    const Blocks<dim> &blocks;
    RunParts<dim> run;
  };
} // namespace Keyblock

#endif
