// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_run_set_up_report_h
#define keyblock_run_set_up_report_h

#include <keyblock/output/output.h>
#include <keyblock/run/model.h>

namespace Keyblock
{
  /** What of the set-up deserves a look, one sentence each (collective).
   * @param report with the stable step */
  template <int dim>
  std::vector<std::string> warnings_of_set_up(const Model<dim> &model,
                                              const Monitors<dim> &monitors,
                                              const RunReport &report);

  /** Where the stable step is set, and by how much (collective). */
  template <int dim>
  void report_stable_step(const Model<dim> &model, RunReport &report);

  /** Mesh, stable step and liners, for people. */
  template <int dim>
  void print_mesh(std::ostream &out,
                  const Model<dim> &model,
                  const RunReport &report);

  /** Blocks and, if the scene wants it, their theory, for people. */
  template <int dim>
  void print_blocks(std::ostream &out, const Model<dim> &model);
} // namespace Keyblock

#endif
