// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_step_snapshot_h
#define keyblock_step_snapshot_h

#include <keyblock/step/step.h>

namespace Keyblock
{
  /** The whole state of a run on this rank: enough to go on from it. */
  template <int dim>
  struct Snapshot
  {
    StepState step;
    StageState stage;
    Fields<dim> fields;
    CellArrays<dim> cells;
    ContactMemory<dim> contact;
  };

  /** The modules whose state a run consists of. */
  template <int dim>
  struct RunParts
  {
    Conditions<dim> &conditions;
    CellArrays<dim> &cells;
    Fields<dim> &fields;
    Contact<dim> *contact; ///< may be null
    ExplicitStep<dim> &step;
  };

  /** Copy the state of @p run (collective). */
  template <int dim>
  Snapshot<dim>
  take_snapshot(const RunParts<dim> &run)
  {
    return {run.step.remember(),
            run.conditions.remember(),
            run.fields,
            run.cells,
            run.contact ? run.contact->remember() : ContactMemory<dim>()};
  }

  /** Go back, to strengths that are not reduced; the next thing must be
   * ExplicitStep::begin_stage, or a trial. */
  template <int dim>
  void
  recall(const Snapshot<dim> &snapshot, const RunParts<dim> &run)
  {
    run.conditions.recall(snapshot.stage); // makes cells of another stage anew
    run.cells  = snapshot.cells;
    run.fields = snapshot.fields;
    run.conditions.reduce_strength(StrengthReduction());
    if (run.contact)
      {
        run.contact->recall(snapshot.contact);
        run.contact->reduce_strength(StrengthReduction());
      }
    run.step.recall(snapshot.step);
  }
} // namespace Keyblock

#endif
