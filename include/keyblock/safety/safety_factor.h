// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_safety_safety_factor_h
#define keyblock_safety_safety_factor_h

#include <keyblock/safety/block_statics.h>
#include <keyblock/safety/once_gone.h>
#include <keyblock/safety/strength_trial.h>
#include <keyblock/safety/support_demand.h>
#include <keyblock/safety/tried_demand.h>

#include <memory>

namespace Keyblock
{
  /** The safety factor of a block at the end of a stage. */
  struct SafetyFactor
  {
    enum class Outcome
    {
      bracketed,
      falls_freely, ///< fails at SafetySettings::lowest
      immovable,    ///< holds at SafetySettings::highest
      clamped,      ///< the same, though it can move (limit equilibrium); what
                    ///< holds it says held_by
      undecided,    ///< neither holds nor fails wherever it was tried
      met,          ///< holds at SafetySettings::wanted; not looked further
      by_statics,   ///< not tried: limit equilibrium is all that was asked for
      carried       ///< fails with its group, whatever its own joints' strength
    };
    unsigned int block = 0; ///< index
    std::string stage;
    Outcome outcome = Outcome::bracketed;
    double lower    = 0.; ///< greatest factor at which it holds
    double upper    = 0.; ///< least factor at which it fails

    /** Factors in the bracket at which it neither came to rest nor failed; 0:
     * none. */
    double undecided_lower = 0., undecided_upper = 0.;

    BlockMode failure_mode;

    /** What holds it at the highest factor, if it is clamped: clamping, bolts,
     * or both, and so on. */
    std::string held_by;

    /** Ids of the blocks that move together when this one fails, or another of
     * them, ascending; empty: it moves alone. With the strength of all their
     * joints divided by the same number, they hold at group_lower and fail at
     * group_upper. */
    std::vector<unsigned int> group;
    double group_lower = 0., group_upper = 0.;

    /** As those of the block alone. */
    double group_undecided_lower = 0., group_undecided_upper = 0.;

    std::vector<Trial> trials;

    TriedDemand tried_demand; ///< of SafetySettings::wanted

    // the two cheap answers
    BlockMode limit_mode;
    std::string limit_remark;
    BlockFacts facts;
    double limit_factor = 0.;     ///< infinite: stable
    OnceGone limit_once_gone;     ///< the least factor without others
    double limit_alone  = 0.;     ///< by BlockStatics::alone, and whether it
    bool limit_moves    = false;  ///< finds a way; known in the search only
    double stress_ratio = 0.;     ///< on the faces it slides on; 0: none
    SupportDemand support_demand; ///< by limit equilibrium

    double
    value() const
    {
      return outcome == Outcome::bracketed   ? 0.5 * (lower + upper)
             : outcome == Outcome::immovable ? lower
                                             : 0.;
    }

    double
    value_of_group() const
    {
      return 0.5 * (group_lower + group_upper);
    }

    /** Whether the group is that of this block's failure, not of another's. */
    bool has_own_group() const;
  };

  /** The outcome in words; a value, falls freely, immovable, above 100, held by
   * clamping (or what else), undecided, above 1.5, as wanted, or carried along.
   */
  std::string describe_outcome(const SafetyFactor &factor);

  /**
   * Blocks of a group have its factor even if it was found for another one: by
   * themselves they may not move at all. Gives the group of the last of
   * @p factors to those before it, and theirs to it, where they are of the same
   * stage; of several it is the weakest.
   * @return indices of those before it that got it
   */
  template <int dim>
  std::vector<unsigned int>
  share_last_group(const Blocks<dim> &blocks,
                   std::vector<SafetyFactor> &factors);

  /** A block on whose free faces support presses. */
  template <int dim>
  struct PressedBlock
  {
    Vector<dim> place{}; ///< displacement where it has its place [m]
    Tensor<1, dim> area; ///< sum of the faces' areas, outwards [m^(dim-1)]
    double area_of_force = 0.; ///< its size for limit equilibrium, which takes
                               ///< that of the exact block [m^(dim-1)]
    double unit = 0.; ///< the block's load over it [Pa]; 0: no such face

    /** Pressure below which the block alone slides by limit equilibrium, where
     * that knows all that acts on it; 0: unknown [Pa]. */
    double slides_below = 0.;
    double first_guess  = 0.; ///< [Pa]
  };

  template <int dim>
  struct JudgedBlock;

  /** How far the search for the factor of a block is. */
  struct SearchAdvance
  {
    unsigned int n_trials = 0;  ///< begun, those of groups among them
    double lower          = 0.; ///< greatest factor at which it holds; 0: none
    double upper          = 0.; ///< least one at which it fails; 0: none
  };

  /**
   * Looks for the factor between holding and failing of one block by trials:
   * bisection, or a sweep. All start from the end of a stage; with warm starts
   * a trial goes on from the highest factor that held.
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
    StrengthReductionSearch(const StrengthReductionSearch &) = delete;

    /** What is known before the first trial. Zero: nothing. */
    struct Known
    {
      double stable   = 0.;    ///< a factor at which the block holds
      double unstable = 0.;    ///< one at which it fails
      double hint     = 0.;    ///< a guess
      double limit    = 0.;    ///< another, tried where that was wrong
      double onset    = 0.;    ///< at which present forces exceed the strength
      double start    = 1.;    ///< factor of the equilibrium to start from
      bool looks_on   = false; ///< also where it holds at the wanted factor
    };

    /**
     * Factor of @p block in the present state, which must be an equilibrium, of
     * stage @p number. The state is the same afterwards (collective).
     */
    SafetyFactor find(const unsigned int block,
                      const unsigned int number,
                      const Known &known);

    /** The same of a block that fails whatever its own joints' strength: factor
     * of it and of the companions that carry it, as a group. */
    SafetyFactor find_with(const TriedBlocks &carried,
                           const unsigned int number,
                           const Known &known);

    /**
     * Find the support by which the block of @p result, which find() or
     * find_with() has given for the same state, holds at the wanted factor,
     * with its group if that is what fails at it. Nothing if none is wanted.
     */
    void add_demand(const unsigned int number,
                    const Known &known,
                    SafetyFactor &result);

    /** The same of a block that the pressure on it has held in the present
     * state, and that nothing else would have. */
    void add_demand_of_pressed(const PressedBlock<dim> &pressed,
                               const unsigned int number,
                               const Known &known,
                               SafetyFactor &result);

    /** Let Conditions::trial_pressure, zero so far, act on the block of
     * @p result as it is free now. */
    PressedBlock<dim> press_on_block(const SafetyFactor &result);

    /** Limit equilibrium and stress ratio of @p block in the present state. */
    void add_cheap_answers(const unsigned int block,
                           SafetyFactor &result) const;

    /** How @p block moves, if not even strong joints hold it: it rotates on
     * what it is not seated on, see is_seated(), else it falls. */
    BlockMode mode_if_not_held(const unsigned int block) const;

    /** Tell support which ways the blocks that are @p tried would take without
     * it, for reduced strengths; returns that of the one that is looked at. */
    Tensor<1, dim> tell_ways(const TriedBlocks &tried);

    /** Called when a trial begins, and now and then during it, if it is set.
     * It must not change the run. */
    std::function<void(const SearchAdvance &)> watcher;

  private:
    class Origin;
    class Search;
    class PressureSearch;

    /** What is known of a block before trials change the pressure on it. */
    struct PressureState
    {
      bool is_at_rest    = true; ///< under the present pressure
      bool fails_without = true; ///< without any, at the wanted factor
    };

    /** Limit equilibrium of @p block in the present state, with what it tells
     * of others. */
    JudgedBlock<dim> judge_among_others(const unsigned int block) const;

    /** Find the pressure on one of the blocks that are @p tried. */
    void search_pressure(const TriedBlocks &tried,
                         const PressedBlock<dim> &pressed,
                         const unsigned int number,
                         const double start,
                         const PressureState &now,
                         TriedDemand &demand);

    /** Tell the watcher. */
    void
    tell_advance() const
    {
      if (watcher)
        watcher(advance);
    }

    /** Factor of the block of @p result together with those that are @p tried
     * with it at first, and all that then move along. */
    void find_group(TriedBlocks tried,
                    const unsigned int number,
                    Known guess,
                    SafetyFactor &result);

    /** Blocks (indices) that those of the @p group press on, and that move,
     * too, where it fails once their joints are as weak as the group's: at the
     * highest factor at which the group holds. None where it holds there. Adds
     * the trial to @p result. */
    std::vector<unsigned int> find_weaker_neighbors(const TriedBlocks &group,
                                                    const unsigned int number,
                                                    const Known &known,
                                                    SafetyFactor &result);

    /** Look for the factor of a block that holds at the wanted one, but not as
     * its group does: where it fails by itself at which that fails, it was
     * caught further on, at the wanted one, by others of the group. */
    void look_below_wanted(const TriedBlocks &alone,
                           const unsigned int number,
                           Known known,
                           SafetyFactor &result);

    /** Finite blocks (indices) that those of the @p group press on now, and
     * that are none of these (collective). */
    std::vector<unsigned int> blocks_pressed_on(const TriedBlocks &group) const;

    /** Ids of these blocks, as SafetyFactor::group. */
    std::vector<unsigned int> ids_of(const TriedBlocks &group) const;

    /** The same with the finite blocks that lean on them now, but for those
     * that supports hold in their places (collective). */
    TriedBlocks with_row(const TriedBlocks &tried) const;

    /** Leave all but the surroundings of the blocks that are @p tried as they
     * are; whether there is anything to leave. */
    bool freeze_beyond_reach(const TriedBlocks &tried);

    /** Try a factor on either side of @p guess, unless it is known by now
     * whether the block holds there.
     * @param onset as in Known */
    void try_guess(Search &search,
                   double guess,
                   const double onset,
                   const double spread) const;

    /** Try factors further and further from one that was tried, until one
     * holds and one fails. */
    SafetyFactor::Outcome find_bracket(Search &search, double spread) const;

    SafetyFactor::Outcome bisect(Search &search, const Known &known) const;
    SafetyFactor::Outcome sweep(Search &search) const;

    const Scene<dim> &scene;
    const SplitMesh<dim> &split;
    const Blocks<dim> &blocks;
    RunParts<dim> run;
    StrengthTrials<dim> trials;
    SearchAdvance advance; ///< of the block that is looked at

    /** What those tried pressed on at the end of the last trial that held. */
    std::vector<unsigned int> pressed_at_end;

    /** Limit equilibrium of the state that was asked for last. */
    struct Judgement;
    mutable std::shared_ptr<const Judgement> judgement;
  };
} // namespace Keyblock

#endif
