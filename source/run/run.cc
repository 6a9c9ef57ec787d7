// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/run/run.h>

namespace Keyblock
{
  template <int dim>
  Run<dim>::Run(Model<dim> &model,
                const std::string &folder,
                const std::string &command,
                const double wall_start)
    : monitors(model.scene,
               model.split,
               model.blocks,
               *model.numbering,
               model.cells,
               model.fields,
               model.contact.get())
    , output(model.scene,
             model.split,
             model.blocks,
             *model.numbering,
             model.cells,
             model.fields,
             model.contact.get(),
             record.safety_factors,
             folder)
    , finite_check(model, monitors, output, folder)
    , checkpointing(model,
                    monitors,
                    output,
                    finite_check,
                    record,
                    folder,
                    command,
                    wall_start)
    , safety(model, finite_check, checkpointing, record)
  {
    record.wall_start = wall_start;
    AssertThrow(model.scene.checks.closed_form != ClosedForm::value ||
                  monitors.history.has(model.scene.checks.quantity),
                InputError("The entry 'Check/Quantity' is '" +
                           model.scene.checks.quantity +
                           "', which is no column of history.csv; name a "
                           "monitor and its quantity, for example tip.u_x."));
  }

  template struct Run<2>;
  template struct Run<3>;
} // namespace Keyblock
