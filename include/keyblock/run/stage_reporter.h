// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_run_stage_reporter_h
#define keyblock_run_stage_reporter_h

#include <keyblock/run/model.h>
#include <keyblock/run/run_record.h>

namespace Keyblock
{
  /** What a stage has come to, for summary.json; blocks that move are named in
   * its remark (collective). */
  template <int dim>
  StageReport report_stage(const Model<dim> &model,
                           StageProgress<dim> &progress);

  /** The same for people. */
  template <int dim>
  void print_stage(std::ostream &out,
                   const Model<dim> &model,
                   const Stage &stage,
                   const StageReport &report);

  /** Deepest overlap of nodes and other blocks, now or before (collective). */
  template <int dim>
  void note_overlap(const Model<dim> &model, StageProgress<dim> &progress);
} // namespace Keyblock

#endif
