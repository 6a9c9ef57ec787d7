// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_run_safety_study_h
#define keyblock_run_safety_study_h

#include <keyblock/base/rank_groups.h>
#include <keyblock/run/checkpointing.h>
#include <keyblock/run/stage_observer.h>

namespace Keyblock
{
  /** Safety factors of the blocks at the end of a stage (all collective). */
  template <int dim>
  class SafetyStudy
  {
  public:
    SafetyStudy(Model<dim> &model,
                FiniteCheck<dim> &finite_check,
                Checkpointing<dim> &checkpointing,
                RunRecord<dim> &record);

    /** Blocks whose factor after the present stage is wanted and not known. */
    std::vector<unsigned int> list_wanted_blocks() const;

    /** Find the factors of those that this rank's group looks at. The state is
     * the same afterwards. */
    void find_remaining_factors(const RankGroups &groups);

    /** Record a factor and share its group, and print what is new of both.
     * @param is_printed whether the factor's own line has been printed */
    void record_factor(const SafetyFactor &factor, const bool is_printed);

    /** Find the factor of the block with this id after the present stage,
     * whatever the scene asks for. The state is the same afterwards; nothing
     * is recorded. Throws InputError if the block can have none. */
    SafetyFactor find_factor_of(const unsigned int id);

  private:
    std::vector<unsigned int>
    list_blocks_of_rank_group(const RankGroups &groups) const;
    bool is_class_wanted(const unsigned int block) const;

    /** Whether a block has a free face because others were taken away. */
    bool is_uncovered(const unsigned int block) const;

    /** Those of @p blocks that limit equilibrium calls critical, if only they
     * are asked for. */
    std::vector<unsigned int>
    select_critical(const std::vector<unsigned int> &blocks) const;

    /** Limit equilibrium of the blocks that have a free face after the present
     * stage. */
    std::vector<SafetyFactor> judge_by_statics() const;

    /** Factor of a block (by index) after the present stage; the state is that
     * of a trial afterwards. */
    SafetyFactor find_factor(StrengthReductionSearch<dim> &search,
                             const unsigned int block);

    /** Index of the block with this id. Throws InputError if it cannot have a
     * factor after the present stage. */
    unsigned int find_block(const unsigned int id) const;

    /** Factor of a block that was removed in the stage. */
    SafetyFactor factor_of_failed_block(StrengthReductionSearch<dim> &search,
                                        const unsigned int block);
    SafetyFactor factor_of_standing_block(StrengthReductionSearch<dim> &search,
                                          const unsigned int block);

    /** Find the support by which a block that nothing has held in the stage
     * holds at the wanted factor: the stage is run again with a pressure on it.
     */
    void add_demand_of_fallen_block(StrengthReductionSearch<dim> &search,
                                    SafetyFactor &result);

    /** Blocks (indices) that failed in the present stage, too, and touch @p
     * block or each other. */
    std::vector<unsigned int>
    list_failed_beside(const unsigned int block) const;

    /** Find the factor of the blocks that are @p tried, which failed in the
     * present stage, by running it again with their joints weaker and weaker:
     * in the state that it leaves with strong ones they hold at their own
     * strength, clamped by stress that the stage would have released. */
    void bracket_by_stage(const TriedBlocks &tried, SafetyFactor &result);

    /** Whether @p blocks (indices), which failed in the present stage, all hold
     * in it with the strength of their joints divided by @p factor, and with
     * @p pressure as Conditions::trial_pressure [Pa]. */
    bool hold_in_stage(const std::vector<unsigned int> &blocks,
                       const double factor,
                       const double pressure = 0.);

    Model<dim> &model;
    FiniteCheck<dim> &finite_check;
    Checkpointing<dim> &checkpointing;
    RunRecord<dim> &record;
  };

  /** The lines about a block whose group's factor was found after its own, and
   * with it what the group asks for. */
  template <int dim>
  void print_group(std::ostream &out,
                   const SafetyFactor &factor,
                   const Blocks<dim> &blocks,
                   const Scene<dim> &scene);

  /** The line about a factor on the screen. */
  template <int dim>
  void print_factor(std::ostream &out,
                    const SafetyFactor &factor,
                    const Blocks<dim> &blocks,
                    const Scene<dim> &scene);
} // namespace Keyblock

#endif
