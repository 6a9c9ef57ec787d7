// SPDX-License-Identifier: LGPL-2.1-or-later
// How one contact point answers: what the solver's sweeps are made of.
#ifndef keyblock_contact_point_response_h
#define keyblock_contact_point_response_h

#include <keyblock/contact/solver.h>
#include <keyblock/law/friction.h>

namespace Keyblock
{
  template <int dim>
  using Matrix = std::array<std::array<double, dim>, dim>;

  /** Whether some node of the point is held in some directions only. */
  template <int dim>
  inline bool
  is_partly_held(const ContactPoint<dim> &point, const ContactNodes<dim> &nodes)
  {
    for (int k = 0; k < point.n_nodes; ++k)
      if (nodes.projection_of(point.node[k]) != nullptr)
        return true;
    return false;
  }

  /** Inverse mass matrix W = sum a_k^2 P_k / m_k of a point. */
  template <int dim>
  inline Matrix<dim>
  inverse_mass_matrix(const ContactPoint<dim> &point,
                      const ContactNodes<dim> &nodes)
  {
    Matrix<dim> w{};
    for (int k = 0; k < point.n_nodes; ++k)
      {
        const double factor =
          point.weight[k] * point.weight[k] * nodes.inverse_mass[point.node[k]];
        const double *p = nodes.projection_of(point.node[k]);
        for (int d = 0; d < dim; ++d)
          for (int e = 0; e < dim; ++e)
            w[d][e] += factor * (p ? p[dim * d + e] : (d == e ? 1. : 0.));
      }
    return w;
  }

  template <int dim>
  inline Vector<dim>
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
  inline PointResponse<dim>
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

  /**
   * What strength has to bound if the spring of a compliant point is to take up
   * all of its motion [N s] (PointSpring::bounded_part), at the present
   * velocities, of which its present impulse is a part. Exact if no node is
   * partly held.
   */
  template <int dim>
  Vector<dim> elastic_trial(const ContactPoint<dim> &point,
                            const ContactNodes<dim> &nodes);

  /** Response of a compliant point to the present velocities, of which its
   * present impulse is a part. */
  template <int dim>
  PointResponse<dim> respond_elastically(const ContactPoint<dim> &point,
                                         const ContactNodes<dim> &nodes);
} // namespace Keyblock

#endif
