// SPDX-License-Identifier: LGPL-2.1-or-later
// Compliant contact points (doc/theory.md, equation 36).
#include <keyblock/contact/point_response.h>

namespace Keyblock
{
  template <int dim>
  Vector<dim>
  elastic_trial(const ContactPoint<dim> &point, const ContactNodes<dim> &nodes)
  {
    const PointSpring<dim> &spring = point.spring;
    const Vector<dim> bounded =
      spring.bounded_part(point.impulse, point.normal);
    const Vector<dim> u =
      add<dim>(relative_velocity<dim>(point, nodes.velocity),
               1.,
               spring.wanted_velocity(bounded, point.normal));
    const double w = point_inverse_mass<dim>(point, nodes);
    return add<dim>(bounded,
                    -1.,
                    scale_parts<dim>(
                      u,
                      point.normal,
                      1. / (spring.tau * w + spring.compliance()),
                      1. / (spring.tau_shear * w + spring.shear_compliance())));
  }



  namespace
  {
    /** As respond_elastically(), of a compliant point with some node that is
     * partly held, for which both directions have one share tau: the fixed
     * point of b = admissible(b - rho (W' b + u)) as in respond_with_matrix().
     */
    template <int dim>
    PointResponse<dim>
    respond_elastically_with_matrix(const ContactPoint<dim> &point,
                                    const ContactNodes<dim> &nodes)
    {
      const PointSpring<dim> &spring = point.spring;
      Matrix<dim> w                  = inverse_mass_matrix<dim>(point, nodes);
      const Vector<dim> free_velocity =
        add<dim>(add<dim>(relative_velocity<dim>(point, nodes.velocity),
                          -1.,
                          multiply<dim>(w, point.impulse)),
                 1.,
                 add<dim>(multiply<dim>(w, spring.known_impulse(point.normal)),
                          1.,
                          spring.wanted_velocity({}, point.normal)));
      const Vector<dim> &n = point.normal;
      for (int d = 0; d < dim; ++d)
        for (int e = 0; e < dim; ++e)
          w[d][e] =
            spring.tau * w[d][e] +
            spring.shear_compliance() * (d == e ? 1. : 0.) +
            (spring.compliance() - spring.shear_compliance()) * n[d] * n[e];
      ContactPoint<dim> bounded = point;
      bounded.impulse = spring.bounded_part(point.impulse, point.normal);
      PointResponse<dim> response =
        respond_with_matrix<dim>(bounded, w, free_velocity);
      response.impulse = spring.whole_impulse(response.impulse, point.normal);
      return response;
    }
  } // namespace



  template <int dim>
  PointResponse<dim>
  respond_elastically(const ContactPoint<dim> &point,
                      const ContactNodes<dim> &nodes)
  {
    if (is_partly_held<dim>(point, nodes))
      return respond_elastically_with_matrix<dim>(point, nodes);
    const PointSpring<dim> &spring = point.spring;
    PointStrength strength         = point.strength;
    if (strength.dilation > 0.)
      {
        // what slips is worth more or less than what opens
        const double w = point_inverse_mass<dim>(point, nodes);
        strength.dilation *=
          spring.tau_shear *
          (spring.tau_shear * w + spring.shear_compliance()) /
          (spring.tau * (spring.tau * w + spring.compliance()));
      }
    PointResponse<dim> response =
      admissible_impulse<dim>(elastic_trial<dim>(point, nodes),
                              point.normal,
                              strength);
    response.impulse = spring.whole_impulse(response.impulse, point.normal);
    return response;
  }

#define INSTANTIATE(dim)                                                       \
  template Vector<dim> elastic_trial<dim>(const ContactPoint<dim> &,           \
                                          const ContactNodes<dim> &);          \
  template PointResponse<dim> respond_elastically(const ContactPoint<dim> &,   \
                                                  const ContactNodes<dim> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock
