// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_safety_strength_trial_h
#define keyblock_safety_strength_trial_h

#include <keyblock/safety/support_state.h>
#include <keyblock/step/snapshot.h>

namespace Keyblock
{
  /** One run with reduced strength, and what it showed. */
  struct Trial
  {
    double factor         = 0.;
    double start          = 0.; ///< factor of the equilibrium it started from
    bool is_of_group      = false; ///< of all blocks that move together
    bool is_stable        = false;
    bool is_undecided     = false; ///< neither at rest nor failing
    unsigned int phase    = 1;     ///< that decided
    double slip           = 0.;    ///< mean, since the stage [m]
    double velocity       = 0.;    ///< of the slip, last window [m/s]
    double acceleration   = 0.;    ///< fitted to the last windows [m/s2]
    double unbalanced     = 0.;  ///< resultant on the block over its weight [-]
    unsigned int n_broken = 0;   ///< bonds of the block's joints, in the trial
    double weakened_area  = 0.;  ///< of them that have lost cohesion by its
                                 ///< end [m^(dim-1)]
    unsigned int n_steps   = 0;  ///< of both phases
    double seconds         = 0.; ///< wall time
    double phase_1_seconds = 0.;
  };

  /**
   * Divides tan(phi), cohesion and tensile strength of the joints of one block
   * by a factor, and decides whether the block holds (doc/theory.md, section
   * 12). A trial starts from an equilibrium and has two phases:
   *
   * 1. Under mass and stiffness damping, with scaled density and all motion
   *    stopped at every peak of its energy, the block either comes to rest
   *    (resultant of loads, stresses and contact on it below 1e-5 of its
   *    weight, slip per period below 1e-6 of its size), which is stable, or
   *    not. Creep by one slow mode is damped by that mode's frequency.
   * 2. From rest, with viscous damping of the highest modes alone, its slip
   *    speeds up, which is unstable, or dies out.
   *
   * The measures contain no damping force, so that damping cannot hold it. A
   * block that does neither after several rounds of both, as one that chatters,
   * is undecided.
   */
  template <int dim>
  class StrengthTrials
  {
  public:
    StrengthTrials(const Scene<dim> &scene,
                   const SplitMesh<dim> &split,
                   const Blocks<dim> &blocks,
                   const Numbering<dim> &numbering,
                   const RunParts<dim> &run);

    /**
     * Change the factor of @p block from @p start, at which the present state
     * of stage @p number is an equilibrium, to @p factor (collective).
     * @param first mean slip of the block at the end of the stage [m]
     */
    Trial try_factor(const unsigned int block,
                     const unsigned int number,
                     const double start,
                     const double factor,
                     const Vector<dim> &first);

    /** Mean slip of @p block on its contacts, or, where the strength of all
     * joints is reduced or it is carried, its mean displacement [m]
     * (collective). */
    Vector<dim>
    slip_of(const unsigned int block) const
    {
      return measure(block).slip;
    }

    /** Divide the strength of the joints of the block, and of its companions,
     * by @p factor. */
    void reduce(const unsigned int block, const double factor);

    /** Blocks (indices) whose joints are reduced with those of the block that
     * is tried; empty: none. */
    std::vector<unsigned int> companions;

    /** Companions carry the block along, so that it may not slip on what it
     * touches: its slip is its displacement. */
    bool is_carried = false;

    /** Which blocks are those whose joints are reduced when @p block is tried,
     * or are tied to one of them by bolts or shotcrete, by index. */
    std::vector<bool> mark_tied_blocks(const unsigned int block) const;

    /** Nothing has failed yet. */
    void
    forget_failure()
    {
      last_failure.clear();
      last_along.clear();
      last_moving.clear();
    }

    /** Blocks (indices) that moved along in the last trial that failed: other
     * finite ones, by at least half of its way in its direction. */
    const std::vector<unsigned int> &
    blocks_along() const
    {
      return last_along;
    }

    /** Those that moved at all in that trial: by at least a tenth of its way,
     * wherever to. */
    const std::vector<unsigned int> &
    blocks_moving() const
    {
      return last_moving;
    }

    /** Other finite blocks (indices) which @p block or its companions press on
     * now, and that are none of these (collective). */
    std::vector<unsigned int> blocks_pressed_on(const unsigned int block) const;

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

    /** How the block moved in the last trial that failed; empty: none. */
    const std::string &
    failure() const
    {
      return last_failure;
    }

  private:
    // what counts as rest (method: see doc/theory.md, section 12)
    static constexpr double rest_unbalanced = 1e-5; ///< over the weight [-]
    static constexpr double rest_slip = 1e-6; ///< per period, over the size [-]

    /** Share of the bracket that a resultant over the weight may have that is
     * not told from rest [-]. */
    static constexpr double resolution = 0.02;

    struct Motion
    {
      Vector<dim> slip{};         ///< as slip_of() [m]
      Vector<dim> displacement{}; ///< of its masses, mean [m]
      Vector<dim> velocity{};     ///< of its masses, mean [m/s]
      double unbalanced = 0.;     ///< everything but damping over the loads [-]
      double load       = 0.;     ///< these [N]
    };

    /** Largest resultant over the load of @p block and of those that hang on
     * it, or it on them, in whatever row, by what support ties together: a
     * block that its stiff support balances is not at rest while those move
     * whose load comes on it later (collective) [-].
     * @param own that of @p block */
    double unbalanced_with_tied(const unsigned int block,
                                const double own) const;

    /** What elements do to the blocks of mark_tied_blocks() now (collective).
     */
    SupportState<dim> support_of(const unsigned int block) const;

    /** Steps in a swing of blocks on their elements, by Rayleigh's quotient of
     * how they have moved in a time, at whose ends @p block has these motions;
     * 0: elements bear no more than before, so that nothing may yet hold it. */
    double swing_period(const unsigned int block,
                        const SupportState<dim> &from,
                        const SupportState<dim> &to,
                        const Motion &before,
                        const Motion &now) const;

    /** Mean slip and displacement of the block, and the forces on it. */
    Motion measure(const unsigned int block) const;

    /** How far a block has moved against what it touches between two states:
     * the slip on its contacts, but no more than its own displacement, since a
     * neighbour that slides past a block at rest slips on it, too [m]. */
    static double way_between(const Motion &from, const Motion &to);

    enum class Verdict
    {
      open,
      holds,
      fails
    };

    /** Both phases, in turn until one decides. */
    Verdict decide(const unsigned int block,
                   const unsigned int number,
                   const Vector<dim> &first,
                   Trial &trial);

    /** Settings of the first phase. */
    Stage quiet_stage(const unsigned int block) const;

    void change_strength(const unsigned int block, Trial &trial);

    /** Phase 1; whether the block has come to rest.
     * @param full_damping of the masses, where no slow mode shows [1/s] */
    bool settle(const unsigned int block,
                const double full_damping,
                const Vector<dim> &first,
                Trial &trial);

    /** Phase 2, over @p periods of the block's lowest mode at most. */
    Verdict watch(const unsigned int block,
                  const double periods,
                  const Vector<dim> &first,
                  Trial &trial);

    /** Whether the resultant is too small for the bracket to tell. */
    bool is_as_good_as_at_rest(const Trial &trial) const;

    /** Steps of phase 1. All motion stops when the kinetic energy of the block
     * is below @p drop of its peak. */
    void step_damped_until(const unsigned int last,
                           const unsigned int block,
                           const double drop,
                           Trial &trial);

    /** Cells along the block's size. */
    double n_across(const unsigned int block) const;

    /** Steps in a period of the block's lowest mode, with scaled density: a
     * wave crosses one cell a step, and the block four times. */
    unsigned int period_of(const unsigned int block) const;

    /** By how much @p load [N] compresses the block [m]. */
    double compression(const unsigned int block, const double load) const;

    /** Largest speed of compression waves in the block [m/s]. */
    double wave_speed(const unsigned int block) const;

    double kinetic_energy(const unsigned int block) const;
    double mass_in_use(const unsigned int block) const;

    /** Bonds of the block's joints that are intact. */
    unsigned int n_intact(const unsigned int block) const;

    std::string name_failure(const unsigned int block) const;

    /** Note blocks_along() and blocks_moving(). */
    void note_blocks_that_moved(const unsigned int block);

    bool is_finite(const unsigned int block) const;

    const Communicator communicator;
    const Scene<dim> &scene;
    const SplitMesh<dim> &split;
    const Blocks<dim> &blocks;
    RunParts<dim> run;
    std::vector<std::vector<unsigned int>> nodes_of_block; ///< owned ones
    std::string last_failure;
    std::vector<unsigned int> last_along, last_moving;
    std::vector<double> displacement_before; ///< of the second phase [m]
    std::vector<double> joint_force;         ///< in its windows, added up [N]
  };
} // namespace Keyblock

#endif
