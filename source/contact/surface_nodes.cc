// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/contact/surface_nodes.h>

namespace Keyblock
{
  template <int dim>
  SurfaceNodes<dim>::SurfaceNodes(const PairTopology<dim> &topology,
                                  Fields<dim> &fields)
    : surface(topology.surface)
    , numbering(topology.numbering)
    , fields(fields)
  {
    for (auto *values :
         {&velocity, &old_velocity, &displacement, &position, &impulse})
      values->assign(dim * surface.n_nodes(), 0.);
    measure();
  }


  template <int dim>
  void
  SurfaceNodes<dim>::measure()
  {
    local_node.resize(surface.n_nodes());
    projection.assign(surface.n_nodes(), nullptr);
    inverse_mass.assign(surface.n_nodes(), 0.);
    std::vector<double> held(surface.n_nodes() * dim * dim, 0.);
    for (unsigned int node = 0; node < surface.n_nodes(); ++node)
      {
        const unsigned int local =
          numbering.local_node(surface.vertex_of_node[node]);
        local_node[node] = local;
        if (local >= numbering.n_owned())
          continue;
        inverse_mass[node] = fields.inverse_mass[local];
        const int support  = fields.support_of_node[local];
        if (support >= 0 && !fields.supports[support].is_fixed())
          for (unsigned int k = 0; k < fields.supports[support].n_directions;
               ++k)
            for (int d = 0; d < dim; ++d)
              for (int e = 0; e < dim; ++e)
                held[(node * dim + d) * dim + e] +=
                  fields.supports[support].directions[k][d] *
                  fields.supports[support].directions[k][e];
      }
    numbering.communicator.sum_lists(inverse_mass);
    numbering.communicator.sum_lists(held);

    projection_storage.resize(surface.n_nodes());
    for (unsigned int node = 0; node < surface.n_nodes(); ++node)
      {
        bool is_held = false;
        for (int i = 0; i < dim * dim; ++i)
          {
            const double h              = held[node * dim * dim + i];
            is_held                     = is_held || h != 0.;
            projection_storage[node][i] = (i % (dim + 1) == 0 ? 1. : 0.) - h;
          }
        if (is_held)
          projection[node] = projection_storage[node].data();
      }
    view = {velocity.data(), inverse_mass.data(), &projection};
  }



  template <int dim>
  void
  SurfaceNodes<dim>::activate(const std::vector<bool> &is_active)
  {
    active.clear();
    for (unsigned int node = 0; node < is_active.size(); ++node)
      if (is_active[node])
        active.push_back(node);
  }


  template <int dim>
  void
  SurfaceNodes<dim>::gather(const std::vector<unsigned int> &shared)
  {
    const auto copy = [&](const std::vector<double> &from,
                          std::vector<double> &to) {
      for (const unsigned int node : active)
        if (local_node[node] != none)
          for (int d = 0; d < dim; ++d)
            to[dim * node + d] = from[dim * local_node[node] + d];
      if (numbering.communicator.size() == 1 || shared.empty())
        return;
      std::vector<double> buffer(dim * shared.size(), 0.);
      for (unsigned int i = 0; i < shared.size(); ++i)
        if (local_node[shared[i]] < numbering.n_owned())
          for (int d = 0; d < dim; ++d)
            buffer[dim * i + d] = from[dim * local_node[shared[i]] + d];
      numbering.communicator.sum_lists(buffer);
      for (unsigned int i = 0; i < shared.size(); ++i)
        for (int d = 0; d < dim; ++d)
          to[dim * shared[i] + d] = buffer[dim * i + d];
    };
    if (active.empty())
      return;
    copy(fields.velocity, velocity);
    copy(fields.old_velocity, old_velocity);
    copy(fields.displacement, displacement);
    for (const unsigned int node : active)
      {
        const Point<dim> &x = surface.place_of_node[node];
        for (int d = 0; d < dim; ++d)
          position[dim * node + d] = x[d] + displacement[dim * node + d];
      }
    for (const unsigned int node : active)
      for (int d = 0; d < dim; ++d)
        impulse[dim * node + d] = 0.;
  }



  template <int dim>
  void
  SurfaceNodes<dim>::scatter(const double kick)
  {
    for (const unsigned int node : active)
      if (local_node[node] != none)
        for (int d = 0; d < dim; ++d)
          {
            const unsigned int dof    = dim * local_node[node] + d;
            fields.velocity[dof]      = velocity[dim * node + d];
            fields.contact_force[dof] = impulse[dim * node + d] / kick;
          }
  }



  template <int dim>
  std::vector<double>
  SurfaceNodes<dim>::gather_positions() const
  {
    std::vector<double> position(dim * surface.n_nodes(), 0.);
    for (unsigned int node = 0; node < surface.n_nodes(); ++node)
      if (local_node[node] < numbering.n_owned())
        for (int d = 0; d < dim; ++d)
          position[dim * node + d] =
            surface.place_of_node[node][d] +
            fields.displacement[dim * local_node[node] + d];
    if (numbering.communicator.size() > 1)
      numbering.communicator.sum_lists(position);
    return position;
  }

  template class SurfaceNodes<2>;
  template class SurfaceNodes<3>;
} // namespace Keyblock
