// SPDX-License-Identifier: LGPL-2.1-or-later
// The contact step as published, for comparison.
#include <keyblock/contact/solver.h>
#include <keyblock/law/friction.h>

namespace Keyblock
{
  namespace
  {
    /** Velocity that a unit impulse on the slave gives each node of a point by
     * equation 20 of Chen, Xiao and Chen (2020): +1 / m on the slave,
     * -phi_j / (sum phi^2 M') on the masters. */
    template <int dim>
    std::array<double, ContactPoint<dim>::max_nodes>
    published_responses(const ContactPoint<dim> &point,
                        const ContactNodes<dim> &nodes)
    {
      std::array<double, ContactPoint<dim>::max_nodes> response{};
      double squares = 0., mass = 0.;
      bool is_fixed = false;
      for (int k = 1; k < point.n_nodes; ++k)
        {
          const double inverse = nodes.inverse_mass[point.node[k]];
          is_fixed = is_fixed || (inverse == 0. && point.weight[k] != 0.);
          squares += point.weight[k] * point.weight[k];
          if (inverse > 0.)
            mass -= point.weight[k] / inverse;
        }
      response[0] = nodes.inverse_mass[point.node[0]];
      if (!is_fixed)
        for (int k = 1; k < point.n_nodes; ++k)
          response[k] = point.weight[k] / mass;
      return response;
    }
  } // namespace



  template <int dim>
  void
  solve_as_published(std::vector<ContactPoint<dim>> &points,
                     const std::vector<PointStrength> &broken,
                     const ContactNodes<dim> &nodes,
                     const SolverSettings &settings)
  {
    std::vector<std::array<double, ContactPoint<dim>::max_nodes>> responses;
    for (unsigned int p = 0; p < points.size(); ++p)
      {
        ContactPoint<dim> &point = points[p];
        responses.push_back(published_responses<dim>(point, nodes));
        double w = 0.;
        for (int k = 0; k < point.n_nodes; ++k)
          w += point.weight[k] * responses[p][k];
        const Vector<dim> u =
          add<dim>(relative_velocity<dim>(point, nodes.velocity),
                   point.gap / settings.step,
                   point.normal);
        const Vector<dim> stick = add<dim>(Vector<dim>{}, -1. / w, u);
        const bool pulls        = dot<dim>(stick, point.normal) < 0.;
        const bool breaks =
          pulls ? norm<dim>(stick) > point.strength.cohesion
                : violation<dim>(stick, point.normal, point.strength) > 0.;
        PointResponse<dim> response{stick, ContactStatus::sticking};
        if (breaks)
          {
            point.is_intact = false;
            point.strength  = broken[p];
            if (pulls)
              response = {Vector<dim>{}, ContactStatus::open};
            else
              response =
                admissible_impulse<dim>(stick, point.normal, point.strength);
          }
        point.impulse = response.impulse;
        point.status  = response.status;
      }
    for (unsigned int p = 0; p < points.size(); ++p)
      for (int k = 0; k < points[p].n_nodes; ++k)
        for (int d = 0; d < dim; ++d)
          nodes.velocity[dim * points[p].node[k] + d] +=
            responses[p][k] * points[p].impulse[d];
  }

  template void solve_as_published(std::vector<ContactPoint<2>> &,
                                   const std::vector<PointStrength> &,
                                   const ContactNodes<2> &,
                                   const SolverSettings &);

  template void solve_as_published(std::vector<ContactPoint<3>> &,
                                   const std::vector<PointStrength> &,
                                   const ContactNodes<3> &,
                                   const SolverSettings &);
} // namespace Keyblock
