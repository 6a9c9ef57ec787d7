// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_mesh_report_warnings_h
#define keyblock_mesh_report_warnings_h

#include <keyblock/mesh/report.h>

namespace Keyblock
{
  /** What of the mesh's joints deserves a look, one sentence each. */
  template <int dim>
  std::vector<std::string>
  warnings_of_mesh_report(const MeshReport<dim> &report,
                          const Scene<dim> &scene);
} // namespace Keyblock

#endif
