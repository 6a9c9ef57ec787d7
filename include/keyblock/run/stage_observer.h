// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_run_stage_observer_h
#define keyblock_run_stage_observer_h

#include <keyblock/run/run_record.h>

namespace Keyblock
{
  /**
   * Whoever wants to know what happens in a stage (all collective). The
   * functions here look on and do nothing: a stage that is run on trial leaves
   * no trace.
   */
  template <int dim>
  class StageObserver
  {
  public:
    virtual ~StageObserver() = default;

    /** Steps, or a static solve, begin. */
    virtual void
    started()
    {}

    /** Numbers of the last step have been measured. */
    virtual void
    sampled(const StageProgress<dim> &)
    {}

    /** A step has been made, the last one of the stage or not. */
    virtual void
    stepped(StageProgress<dim> &, const Stage &)
    {}

    /** The state can be saved here. Throws StopRequest if a signal asks for an
     * end. */
    virtual void save_point(StageProgress<dim> &) = 0;

    /** The steps of the stage are made. */
    virtual void
    ended(StageProgress<dim> &, const Stage &)
    {}
  };
} // namespace Keyblock

#endif
