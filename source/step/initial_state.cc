// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/step/initial_state.h>

#include <keyblock/base/expression.h>
#include <keyblock/rock/initial_stress.h>

namespace Keyblock
{
  template <int dim>
  void
  allocate_fields(const SplitMesh<dim> &split,
                  const Numbering<dim> &numbering,
                  Fields<dim> &fields)
  {
    const std::size_t n_dofs = std::size_t(dim) * numbering.n_local();
    for (auto *field : {&fields.reference,
                        &fields.displacement,
                        &fields.velocity,
                        &fields.old_velocity,
                        &fields.internal_force,
                        &fields.load,
                        &fields.contact_force})
      field->assign(n_dofs, 0.);
    for (unsigned int node = 0; node < numbering.n_local(); ++node)
      for (int d = 0; d < dim; ++d)
        fields.reference[dim * node + d] =
          split.mesh.vertices[numbering.vertex_of_node[node]][d];
    fields.is_in_cluster.assign(numbering.n_local(), 0);
  }



  template <int dim>
  void
  set_initial_stress(const Scene<dim> &scene,
                     const Mesh<dim> &mesh,
                     CellArrays<dim> &cells)
  {
    if (scene.initial_state.stress.empty() &&
        !scene.initial_state.has_depth_stress())
      return;
    const InitialStress<dim> stress(scene.initial_state);
    for (unsigned int c = 0; c < cells.nodes.size(); ++c)
      for (int q = 0; q < (1 << dim); ++q)
        {
          Point<dim> place;
          for (int v = 0; v < (1 << dim); ++v)
            place += shape<dim>.value[q][v] *
                     mesh.vertices[mesh.cells[cells.mesh_cell[c]][v]];
          typename StressArray<dim>::Stress value;
          stress.evaluate(place, value.data());
          cells.set_stress(c, q, value);
        }
  }



  template <int dim>
  void
  set_initial_velocity(const Scene<dim> &scene,
                       const Mesh<dim> &mesh,
                       const Numbering<dim> &numbering,
                       Fields<dim> &fields)
  {
    if (scene.initial_state.velocity.empty())
      return;
    const Expression<dim> velocity(scene.initial_state.velocity,
                                   dim,
                                   "Initial state/Velocity");
    for (unsigned int node = 0; node < numbering.n_local(); ++node)
      if (fields.inverse_mass[node] > 0.)
        for (int d = 0; d < dim; ++d)
          fields.velocity[dim * node + d] =
            velocity.value(mesh.vertices[numbering.vertex_of_node[node]],
                           0.,
                           d);
    numbering.interpolate_hanging(fields.velocity);
  }

#define INSTANTIATE(dim)                                                       \
  template void allocate_fields(const SplitMesh<dim> &,                        \
                                const Numbering<dim> &,                        \
                                Fields<dim> &);                                \
  template void set_initial_stress(const Scene<dim> &,                         \
                                   const Mesh<dim> &,                          \
                                   CellArrays<dim> &);                         \
  template void set_initial_velocity(const Scene<dim> &,                       \
                                     const Mesh<dim> &,                        \
                                     const Numbering<dim> &,                   \
                                     Fields<dim> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock
