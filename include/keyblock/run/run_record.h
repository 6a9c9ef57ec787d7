// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_run_run_record_h
#define keyblock_run_run_record_h

#include <keyblock/output/output.h>
#include <keyblock/safety/slip_record.h>
#include <keyblock/safety/support_state.h>

namespace Keyblock
{
  /** How far a stage has come. */
  template <int dim>
  struct StageProgress
  {
    unsigned int index       = 0; ///< into Scene::stages
    std::uint64_t first_step = 0; ///< of the run, when the stage began
    std::uint64_t n_planned  = 0; ///< steps
    std::uint64_t n_done     = 0;
    unsigned int n_vtu       = 0; ///< outputs written
    Overlap<dim> overlap;         ///< the deepest in them, so far
    bool has_removed   = false;   ///< a block, in the last step
    bool is_reported   = false;   ///< only safety factors are left
    bool wants_factors = false;
    bool is_converged  = true;
    SlipRecord slips; ///< since the ramp has ended

    /** Of each block the angle [rad] and the error of its weight's arm [-] when
     * that was largest (BlockTurn); empty in large kinematics. */
    std::vector<double> turns;

    /** When these were recorded last; empty: not yet. */
    SupportState<dim> support;

    /** Number of the stage in which each block was removed; 0: it is there. */
    std::vector<unsigned int> removal_stage;

    /** Displacement of local nodes when the stage began [m]. */
    std::vector<double> start_displacement;

    /** Displacement of local nodes since then [m]. */
    std::vector<double>
    way_in_stage(const Fields<dim> &fields) const
    {
      std::vector<double> way = fields.displacement;
      for (unsigned int i = 0; i < way.size(); ++i)
        way[i] -= start_displacement[i];
      return way;
    }

    /** Forget what blocks have done up to now. */
    void
    restart_slips()
    {
      slips.restart(n_done);
      support.numbers.clear();
    }

    /** Number of the stage (Scene::stage_number). */
    unsigned int
    number() const
    {
      return index + 2;
    }

    /** Blocks, by index, that were taken away before this stage. */
    std::vector<bool>
    removed_before() const
    {
      std::vector<bool> is_removed;
      for (const unsigned int stage : removal_stage)
        is_removed.push_back(stage > 0 && stage < number());
      return is_removed;
    }

    /** Those that were taken away in it. */
    std::vector<bool>
    removed_since() const
    {
      std::vector<bool> is_removed;
      for (const unsigned int stage : removal_stage)
        is_removed.push_back(stage == number());
      return is_removed;
    }
  };

  /** What a run has come to. */
  template <int dim>
  struct RunRecord
  {
    StageProgress<dim> present;
    Snapshot<dim> before;    ///< the state the present stage began with, if it
                             ///< wants safety factors or is kept
    bool has_before = false; ///< whether that is there
    std::vector<StageReport> stage_reports;
    std::vector<SafetyFactor> safety_factors;
    RunReport report;
    double wall_start = 0.; ///< less the time of earlier parts of the run [s]
  };
} // namespace Keyblock

#endif
