// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/contact_solver.h>

#include <algorithm>

namespace Keyblock
{
  template <int dim>
  double
  point_inverse_mass(const ContactPoint<dim> &point,
                     const ContactNodes<dim> &nodes)
  {
    double w = 0.;
    for (int k = 0; k < point.n_nodes; ++k)
      w +=
        point.weight[k] * point.weight[k] * nodes.inverse_mass[point.node[k]];
    return w;
  }



  template <int dim>
  Vector<dim>
  relative_velocity(const ContactPoint<dim> &point, const double *velocity)
  {
    Vector<dim> c{};
    for (int k = 0; k < point.n_nodes; ++k)
      for (int d = 0; d < dim; ++d)
        c[d] += point.weight[k] * velocity[dim * point.node[k] + d];
    return c;
  }



  template <int dim>
  void
  apply_impulse(const ContactPoint<dim> &point,
                const Vector<dim> &impulse,
                const ContactNodes<dim> &nodes)
  {
    for (int k = 0; k < point.n_nodes; ++k)
      {
        const double factor =
          point.weight[k] * nodes.inverse_mass[point.node[k]];
        double *v       = nodes.velocity + dim * point.node[k];
        const double *p = nodes.projection_of(point.node[k]);
        if (p == nullptr)
          for (int d = 0; d < dim; ++d)
            v[d] += factor * impulse[d];
        else
          for (int d = 0; d < dim; ++d)
            for (int e = 0; e < dim; ++e)
              v[d] += factor * p[dim * d + e] * impulse[e];
      }
  }



  namespace
  {
    template <int dim>
    using Matrix = std::array<std::array<double, dim>, dim>;

    /** Whether some node of the point is held in some directions only. */
    template <int dim>
    bool
    is_partly_held(const ContactPoint<dim> &point,
                   const ContactNodes<dim> &nodes)
    {
      for (int k = 0; k < point.n_nodes; ++k)
        if (nodes.projection_of(point.node[k]) != nullptr)
          return true;
      return false;
    }

    /** Inverse mass matrix W = sum a_k^2 P_k / m_k of a point. */
    template <int dim>
    Matrix<dim>
    inverse_mass_matrix(const ContactPoint<dim> &point,
                        const ContactNodes<dim> &nodes)
    {
      Matrix<dim> w{};
      for (int k = 0; k < point.n_nodes; ++k)
        {
          const double factor = point.weight[k] * point.weight[k] *
                                nodes.inverse_mass[point.node[k]];
          const double *p = nodes.projection_of(point.node[k]);
          for (int d = 0; d < dim; ++d)
            for (int e = 0; e < dim; ++e)
              w[d][e] += factor * (p ? p[dim * d + e] : (d == e ? 1. : 0.));
        }
      return w;
    }

    template <int dim>
    Vector<dim>
    multiply(const Matrix<dim> &w, const Vector<dim> &x)
    {
      Vector<dim> y{};
      for (int d = 0; d < dim; ++d)
        y[d] = dot<dim>(w[d], x);
      return y;
    }

    /**
     * Response of a point with different inverse masses by direction: the fixed
     * point of r = admissible(r - rho (W r + u)), rho = 1 / trace W, which
     * contracts for symmetric W. Held directions keep their impulse.
     */
    template <int dim>
    PointResponse<dim>
    respond_with_matrix(const ContactPoint<dim> &point,
                        const Matrix<dim> &w,
                        const Vector<dim> &free_velocity)
    {
      double trace = 0.;
      for (int d = 0; d < dim; ++d)
        trace += w[d][d];
      PointResponse<dim> response{point.impulse, point.status};
      for (int iteration = 0; iteration < 5000; ++iteration)
        {
          const Vector<dim> velocity =
            add<dim>(free_velocity, 1., multiply<dim>(w, response.impulse));
          const PointResponse<dim> next = admissible_impulse<dim>(
            add<dim>(response.impulse, -1. / trace, velocity),
            point.normal,
            point.strength);
          const double change =
            norm<dim>(add<dim>(next.impulse, -1., response.impulse));
          response = next;
          if (change <= 1e-13 * norm<dim>(next.impulse))
            break;
        }
      return response;
    }

    /** One visit of a point: its new response to the present velocities, of
     * which its present impulse is a part. */
    template <int dim>
    PointResponse<dim>
    respond(const ContactPoint<dim> &point,
            const ContactNodes<dim> &nodes,
            const double step)
    {
      // the velocity the point must not have: its own plus what closes the gap
      Vector<dim> u     = relative_velocity<dim>(point, nodes.velocity);
      const double bias = std::max(point.gap, 0.) / step;
      u                 = add<dim>(u, bias, point.normal);
      if (is_partly_held<dim>(point, nodes))
        {
          const Matrix<dim> w = inverse_mass_matrix<dim>(point, nodes);
          const Vector<dim> free_velocity =
            add<dim>(u, -1., multiply<dim>(w, point.impulse));
          return respond_with_matrix<dim>(point, w, free_velocity);
        }
      const double w = point_inverse_mass<dim>(point, nodes);
      return admissible_impulse<dim>(add<dim>(point.impulse, -1. / w, u),
                                     point.normal,
                                     point.strength);
    }

    template <int dim>
    SolverReport
    iterate(std::vector<ContactPoint<dim>> &points,
            const ContactNodes<dim> &nodes,
            const SolverSettings &settings)
    {
      SolverReport report;
      for (; report.n_iterations < settings.maximum_iterations;)
        {
          ++report.n_iterations;
          double change = 0., largest = 0.;
          for (ContactPoint<dim> &point : points)
            {
              const PointResponse<dim> response =
                respond<dim>(point, nodes, settings.step);
              const Vector<dim> difference =
                add<dim>(response.impulse, -1., point.impulse);
              apply_impulse<dim>(point, difference, nodes);
              point.impulse = response.impulse;
              point.status  = response.status;
              change        = std::max(change, norm<dim>(difference));
              largest       = std::max(largest, norm<dim>(response.impulse));
            }
          if (change <= settings.tolerance * largest || points.size() == 1)
            return report;
        }
      report.is_capped = true;
      return report;
    }

    /** The intact point whose strength falls shortest of what would stop it,
     * or -1 if all of them stick. */
    template <int dim>
    int
    worst_intact_point(const std::vector<ContactPoint<dim>> &points,
                       const ContactNodes<dim> &nodes)
    {
      int worst      = -1;
      double largest = 0.;
      for (unsigned int p = 0; p < points.size(); ++p)
        if (points[p].is_intact && points[p].status != ContactStatus::sticking)
          {
            const Vector<dim> u =
              relative_velocity<dim>(points[p], nodes.velocity);
            const double w          = point_inverse_mass<dim>(points[p], nodes);
            const Vector<dim> stick = add<dim>(points[p].impulse, -1. / w, u);
            const double excess =
              violation<dim>(stick, points[p].normal, points[p].strength);
            if (worst < 0 || excess > largest)
              {
                worst   = p;
                largest = excess;
              }
          }
      return worst;
    }
  } // namespace



  template <int dim>
  SolverReport
  solve_group(std::vector<ContactPoint<dim>> &points,
              const std::vector<PointStrength> &broken,
              const ContactNodes<dim> &nodes,
              const SolverSettings &settings)
  {
    for (ContactPoint<dim> &point : points)
      apply_impulse<dim>(point, point.impulse, nodes);
    SolverReport report = iterate<dim>(points, nodes, settings);
    for (int worst = worst_intact_point<dim>(points, nodes); worst >= 0;
         worst     = worst_intact_point<dim>(points, nodes))
      {
            points[worst].is_intact  = false;
            points[worst].strength   = broken[worst];
            const SolverReport again = iterate<dim>(points, nodes, settings);
            report.n_iterations += again.n_iterations;
            report.is_capped = report.is_capped || again.is_capped;
      }
    return report;
  }

  namespace
  {
    /** Velocity that a unit impulse on the slave gives each node of a point by
     * (20): +1 / m on the slave, -phi_j / (sum phi^2 M') on the masters. */
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

#define INSTANTIATE(dim)                                                       \
  template double point_inverse_mass(const ContactPoint<dim> &,                \
                                     const ContactNodes<dim> &);               \
  template Vector<dim> relative_velocity<dim>(const ContactPoint<dim> &,       \
                                              const double *);                 \
  template void apply_impulse<dim>(const ContactPoint<dim> &,                  \
                                   const Vector<dim> &,                        \
                                   const ContactNodes<dim> &);                 \
  template SolverReport solve_group(std::vector<ContactPoint<dim>> &,          \
                                    const std::vector<PointStrength> &,        \
                                    const ContactNodes<dim> &,                 \
                                    const SolverSettings &);                   \
  template void solve_as_published(std::vector<ContactPoint<dim>> &,           \
                                   const std::vector<PointStrength> &,         \
                                   const ContactNodes<dim> &,                  \
                                   const SolverSettings &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock
