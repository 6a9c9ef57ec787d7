// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_run_run_h
#define keyblock_run_run_h

#include <keyblock/run/checkpointing.h>
#include <keyblock/run/safety_study.h>

namespace Keyblock
{
  /**
   * A model that has been set up, and all that looks after it while it is
   * stepped: what is measured, written, checked and saved.
   */
  template <int dim>
  struct Run
  {
    /** @param folder of output, with '/' at its end; empty: nothing is written
     * @param command that starts the run anew
     * @param wall_start when the run began [s]
     * Throws InputError. */
    Run(Model<dim> &model,
        const std::string &folder,
        const std::string &command,
        const double wall_start);

    Monitors<dim> monitors;
    RunRecord<dim> record;
    Output<dim> output;
    FiniteCheck<dim> finite_check;
    Checkpointing<dim> checkpointing;
    SafetyStudy<dim> safety;
  };
} // namespace Keyblock

#endif
