// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_safety_factor_h
#define keyblock_safety_factor_h

#include <keyblock/limit_equilibrium.h>
#include <keyblock/snapshot.h>

namespace Keyblock
{
  /** One run with reduced strength, and what it showed. */
  struct Trial
  {
    double factor          = 0.;
    bool is_stable         = false;
    unsigned int phase     = 1;  ///< that decided
    double slip            = 0.; ///< mean, at the end of the phase [m]
    double velocity        = 0.; ///< of the slip, last window [m/s]
    double acceleration    = 0.; ///< fitted to the last windows [m/s2]
    double unbalanced      = 0.; ///< resultant on the block over its weight [-]
    unsigned int n_steps   = 0;  ///< of both phases
    double seconds         = 0.; ///< wall time
    double phase_1_seconds = 0.;
  };

  /** The safety factor of a block at the end of a stage. */
  struct SafetyFactor
  {
    enum class Outcome
    {
      bracketed,
      falls_freely, ///< fails at SafetySettings::lowest
      immovable     ///< holds at SafetySettings::highest
    };
    unsigned int block = 0; ///< index
    std::string stage;
    Outcome outcome = Outcome::bracketed;
    double lower    = 0.; ///< greatest factor at which it holds
    double upper    = 0.; ///< least factor at which it fails
    std::string failure_mode;
    std::vector<Trial> trials;

    // the two cheap answers
    std::string limit_mode;
    double limit_factor = 0.;
    double stress_ratio = 0.; ///< on the faces it slides on; 0: none

    double
    value() const
    {
      return outcome == Outcome::bracketed   ? 0.5 * (lower + upper)
             : outcome == Outcome::immovable ? lower
                                             : 0.;
    }
  };

  std::string to_string(const SafetyFactor::Outcome outcome);

  /**
   * Strength reduction of one block: divides tan(phi), cohesion and tensile
   * strength of its joints by F, and looks for the F between holding and
   * failing. A trial starts from an equilibrium and has two phases
   * (doc/theory.md, section 12):
   *
   * 1. Under mass and stiffness damping, with scaled density and all motion
   *    stopped at every peak of its energy, the block either comes to rest
   *    (resultant of loads, stresses and contact on it below 1e-5 of its
   *    weight, slip per period below 1e-6 of its size), which is stable, or
   * not.
   * 2. With true masses, from rest, with viscous damping of the highest modes,
   *    its slip speeds up, which is unstable, or dies out.
   *
   * The measures contain no damping force, so that damping cannot hold it.
   */
  template <int dim>
  class StrengthReductionSearch
  {
  public:
    StrengthReductionSearch(const Scene<dim> &scene,
                            const SplitMesh<dim> &split,
                            const Blocks<dim> &blocks,
                            const Numbering<dim> &numbering,
                            const RunParts<dim> &run);

    /** What is known before the first trial. Zero: nothing. */
    struct Known
    {
      double stable   = 0.; ///< a factor at which the block holds
      double unstable = 0.; ///< one at which it fails
      double hint     = 0.; ///< a guess
      double start    = 1.; ///< factor of the equilibrium to start from
    };

    /**
     * Factor of @p block in the present state, which must be an equilibrium, of
     * stage @p number. The state is the same afterwards (collective).
     */
    SafetyFactor find(const unsigned int block,
                      const unsigned int number,
                      const Known &known);

    /** Limit equilibrium and stress ratio of @p block in the present state. */
    void add_cheap_answers(const unsigned int block, SafetyFactor &result);

  private:
    struct Motion
    {
      Vector<dim> slip;
      double unbalanced = 0.;
    };

    Trial try_factor(const unsigned int block,
                     const unsigned int number,
                     const double factor,
                     const double start);
    void reduce(const unsigned int block, const double factor);
    Motion measure(const unsigned int block) const;
    bool settle(const unsigned int block, const double start, Trial &trial);
    void watch(const unsigned int block, Trial &trial);
    void step_until(const unsigned int last, Trial &trial);
    void step_damped_until(const unsigned int last,
                           const unsigned int block,
                           Trial &trial);

    /** Cells along the block's size. */
    double n_across(const unsigned int block) const;

    double kinetic_energy(const unsigned int block) const;
    void bisect(const unsigned int block,
                const unsigned int number,
                const Known &known,
                SafetyFactor &result);
    void sweep(const unsigned int block,
               const unsigned int number,
               const Known &known,
               SafetyFactor &result);
    std::string name_failure(const unsigned int block);
    std::vector<BlockFace<dim>> list_faces(const unsigned int block) const;
    Tensor<1, dim> weight_of(const unsigned int block) const;

    const Scene<dim> &scene;
    const SplitMesh<dim> &split;
    const Blocks<dim> &blocks;
    const Numbering<dim> &numbering;
    RunParts<dim> run;
    std::vector<std::vector<unsigned int>> nodes_of_block; ///< owned ones
    std::string last_failure;
    std::vector<double> displacement_before; ///< of the second phase [m]
  };
} // namespace Keyblock

#endif
