// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_step_initial_state_h
#define keyblock_step_initial_state_h

#include <keyblock/rock/dofs.h>
#include <keyblock/rock/fields.h>
#include <keyblock/rock/internal_force.h>

namespace Keyblock
{
  /** Make room for all fields; all of them are zero but the positions. */
  template <int dim>
  void allocate_fields(const SplitMesh<dim> &split,
                       const Numbering<dim> &numbering,
                       Fields<dim> &fields);

  /** Put in the stress of the scene, by formulas or depth. */
  template <int dim>
  void set_initial_stress(const Scene<dim> &scene,
                          const Mesh<dim> &mesh,
                          CellArrays<dim> &cells);

  /** Put in the velocity of the scene, on nodes that are free. */
  template <int dim>
  void set_initial_velocity(const Scene<dim> &scene,
                            const Mesh<dim> &mesh,
                            const Numbering<dim> &numbering,
                            Fields<dim> &fields);
} // namespace Keyblock

#endif
