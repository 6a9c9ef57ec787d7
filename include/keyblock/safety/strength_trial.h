// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_safety_strength_trial_h
#define keyblock_safety_strength_trial_h

#include <keyblock/safety/trial_failure.h>
#include <keyblock/safety/trial_measures.h>

#include <functional>

namespace Keyblock
{
  /** One run with reduced strength, and what it showed. */
  struct Trial
  {
    double factor         = 0.;
    double pressure       = 0.; ///< on the block's free faces [Pa]
    double start          = 0.; ///< factor of the equilibrium it started from
    bool is_of_group      = false; ///< of all blocks that move together
    bool is_stable        = false;
    bool is_undecided     = false; ///< neither at rest nor failing
    unsigned int phase    = 1;     ///< that decided; 0: a stage run again
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
   *
   * Shear across its way, or forces between its faces that balance each other,
   * can hold a block, too, as long as it does not move. Where limit equilibrium
   * knows all that acts, one that rests above its factor is made to slide a
   * little and asked again.
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
     * Change the factor of the blocks that are tried from @p start, at which
     * the present state of stage @p number is an equilibrium, to @p factor
     * (collective).
     * @param first mean slip of the block at the end of the stage [m]
     * @param pressure what Conditions::trial_pressure changes to with it [Pa]
     */
    Trial try_factor(const TriedBlocks &tried,
                     const unsigned int number,
                     const double start,
                     const double factor,
                     const Vector<dim> &first,
                     const double pressure = 0.);

    const TrialMeasures<dim> measures;

    /** Called now and then during a trial, if it is set. */
    std::function<void()> pulse;

    /** Of the last trial that failed. */
    TrialFailure<dim> failure;

  private:
    // what counts as rest (method: see doc/theory.md, section 12)
    static constexpr double rest_unbalanced = 1e-5; ///< over the weight [-]
    static constexpr double rest_slip = 1e-6; ///< per period, over the size [-]

    /** Share of the bracket that a resultant over the weight may have that is
     * not told from rest [-]. */
    static constexpr double resolution = 0.02;

    /** Length of the second phase, at most, in periods of the block's lowest
     * mode, the first time and so much longer each time after it: what is open
     * then goes back to the first one, which damps [-]. */
    static constexpr double watch_periods = 20.;

    using Motion = typename TrialMeasures<dim>::Motion;

    enum class Verdict
    {
      open,
      holds,
      fails
    };

    /** Looks for signals, and tells that the trial goes on. */
    void pause() const;

    /** Divide the strength of the joints of the blocks by @p factor. */
    void reduce(const TriedBlocks &tried, const double factor);

    /** Both phases, in turn until one decides, with strength that changes from
     * that of the factor @p from to that of the trial. */
    Verdict decide(const TriedBlocks &tried,
                   const unsigned int number,
                   const double from,
                   const Vector<dim> &first,
                   Trial &trial);

    /** Whether the blocks fail that have moved off @p n_failures times. */
    bool is_failure(const TriedBlocks &tried,
                    const unsigned int n_failures,
                    const Trial &trial) const;

    /** Settings of the first phase. */
    Stage quiet_stage(const TriedBlocks &tried) const;

    /** Of the second. */
    Stage moving_stage() const;

    /** Gradually, in steps of the first phase, and with it the pressure to that
     * of the trial. */
    void change_strength(const TriedBlocks &tried,
                         const double from,
                         const double to,
                         Trial &trial);

    /** Of a block at rest above its limit equilibrium: makes it slide a little
     * and asks again whether it holds. */
    Verdict decide_as_it_slides(const TriedBlocks &tried,
                                const unsigned int number,
                                const Vector<dim> &first,
                                Trial &trial);

    /** Weaken the joints until the block has slipped as far as its elasticity
     * lets it, and give them their strength back while it slides on: what
     * presses on the joints and shears them then is that of sliding. False if
     * it does not slide. */
    bool slide_on(const TriedBlocks &tried, Trial &trial);

    /** Whether a block that slides gains speed: the trend over windows, as
     * waves in the block shake it meanwhile. */
    bool slides_faster(const TriedBlocks &tried,
                       const Vector<dim> &first,
                       Trial &trial);

    /** Phase 1; whether the block has come to rest.
     * @param full_damping of the masses, where no slow mode shows [1/s] */
    bool settle(const TriedBlocks &tried,
                const double full_damping,
                const Vector<dim> &first,
                Trial &trial);

    /** Phase 2, over @p periods of the block's lowest mode at most. */
    Verdict watch(const TriedBlocks &tried,
                  const double periods,
                  const Vector<dim> &first,
                  Trial &trial);

    /** Steps in a window of the second phase. */
    unsigned int watched_window(const TriedBlocks &tried) const;

    /** Whether a resultant over the load is too small for the bracket to tell.
     */
    bool is_as_good_as_at_rest(const double unbalanced) const;

    /** Steps of phase 1. All motion stops when the kinetic energy of the block
     * and of those that lean on it is below @p drop of its peak. */
    void step_damped_until(const unsigned int last,
                           const TriedBlocks &tried,
                           const double drop,
                           Trial &trial);

    const Communicator communicator;
    const Scene<dim> &scene;
    const Blocks<dim> &blocks;
    RunParts<dim> run;
  };
} // namespace Keyblock

#endif
