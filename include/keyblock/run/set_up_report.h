// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_run_set_up_report_h
#define keyblock_run_set_up_report_h

#include <keyblock/output/output.h>
#include <keyblock/run/model.h>

namespace Keyblock
{
  /** What of the set-up deserves a look, one sentence each (collective). */
  template <int dim>
  std::vector<std::string> warnings_of_set_up(const Model<dim> &model,
                                              const Monitors<dim> &monitors);

  /** Where the stable step is set, and by how much (collective). */
  template <int dim>
  void report_stable_step(const Model<dim> &model, RunReport &report);

  /** Mesh, stable step and blocks, for people.
   * @param mass_scaling what it does, in words */
  template <int dim>
  void print_set_up(std::ostream &out,
                    const Model<dim> &model,
                    const RunReport &report,
                    const std::vector<std::string> &warnings,
                    const std::string &mass_scaling);
} // namespace Keyblock

#endif
