// SPDX-License-Identifier: LGPL-2.1-or-later
// The elastic part of a compliant contact point; pure functions.
#ifndef keyblock_contact_point_spring_h
#define keyblock_contact_point_spring_h

#include <keyblock/base/vector.h>
#include <keyblock/law/point_strength.h>

namespace Keyblock
{
  /** @p v with its part along the unit vector @p n times @p along, the rest
   * times @p across. */
  template <int dim>
  inline Vector<dim>
  scale_parts(const Vector<dim> &v,
              const Vector<dim> &n,
              const double along,
              const double across)
  {
    const double v_n = dot<dim>(v, n);
    Vector<dim> result;
    for (int d = 0; d < dim; ++d)
      result[d] = across * (v[d] - v_n * n[d]) + along * v_n * n[d];
    return result;
  }

  /** @p v turned as the unit vector @p from is turned to @p to. */
  template <int dim>
  inline Vector<dim>
  turn(const Vector<dim> &v, const Vector<dim> &from, const Vector<dim> &to)
  {
    const double one_plus_cosine = 1. + dot<dim>(from, to);
    if (one_plus_cosine < 1e-12) // opposite: no turn is the least one
      return v;
    const Vector<dim> sum = add<dim>(from, 1., to);
    return add<dim>(add<dim>(v, -dot<dim>(v, sum) / one_plus_cosine, sum),
                    2. * dot<dim>(v, from),
                    to);
  }

  /** What a compliant point remembers from step to step. */
  template <int dim>
  struct SpringState
  {
    Vector<dim> force{}; ///< on the plus side (slave), last step [N]

    /** Elastic displacement of the plus side against the other, now [m]; along
     * the normal, where it counts when open, too, negative when pressed. */
    Vector<dim> stretch{};
  };

  /**
   * The spring of a contact point in one step. Its force is that at the share
   * tau of the coming move,
   *
   *   F = -K (s + tau dt c),
   *
   * with the stretch s at the start of the move and the velocity c after the
   * kick; the strength of the joint bounds F. The impulse of the kick h is
   * r = h ((1 - tau) F_before + tau F). With tau = 1/2 that keeps energy to
   * round-off, with tau = 1 it is implicit and tends to the rigid point as the
   * stiffness grows (doc/theory.md, section 15).
   */
  template <int dim>
  struct PointSpring
  {
    bool is_elastic  = false; ///< else the point is rigid
    double normal    = 0.;    ///< stiffness along the normal [N/m]
    double shear     = 0.;    ///< stiffness across it [N/m]
    double tau       = 0.5;   ///< of the normal direction [-]
    double tau_shear = 0.5;   ///< of the others [-]
    double kick      = 0.;    ///< [s]
    double step      = 0.;    ///< [s]
    SpringState<dim> before;

    /** Compliance F / h over velocity: 1 / (h K tau dt), [1/kg]. */
    double
    compliance() const
    {
      return 1. / (kick * normal * tau * step);
    }
    double
    shear_compliance() const
    {
      return 1. / (kick * shear * tau_shear * step);
    }

    /** The part of the impulse that is known from the step before [N s]. */
    Vector<dim>
    known_impulse(const Vector<dim> &n) const
    {
      return scale_parts<dim>(before.force,
                              n,
                              kick * (1. - tau),
                              kick * (1. - tau_shear));
    }

    /** h F, which strength bounds, of the impulse @p r. */
    Vector<dim>
    bounded_part(const Vector<dim> &r, const Vector<dim> &n) const
    {
      return scale_parts<dim>(add<dim>(r, -1., known_impulse(n)),
                              n,
                              1. / tau,
                              1. / tau_shear);
    }

    /** The impulse of @p bounded = h F. */
    Vector<dim>
    whole_impulse(const Vector<dim> &bounded, const Vector<dim> &n) const
    {
      return add<dim>(known_impulse(n),
                      1.,
                      scale_parts<dim>(bounded, n, tau, tau_shear));
    }

    /** What c and this have to add up to zero, as long as the spring bears
     * @p bounded within its strength: -(c the spring asks for) [m/s]. */
    Vector<dim>
    wanted_velocity(const Vector<dim> &bounded, const Vector<dim> &n) const
    {
      return add<dim>(
        scale_parts<dim>(
          before.stretch, n, 1. / (tau * step), 1. / (tau_shear * step)),
        1.,
        scale_parts<dim>(bounded, n, compliance(), shear_compliance()));
    }

    /** Energy stored under a force [J]. */
    double
    energy(const Vector<dim> &force, const Vector<dim> &n) const
    {
      return 0.5 *
             dot<dim>(force,
                      scale_parts<dim>(force, n, 1. / normal, 1. / shear));
    }
  };

  /** What a step has made of a spring. */
  template <int dim>
  struct SpringChange
  {
    SpringState<dim> after;
    Vector<dim> slip{}; ///< for good, along the joint [m]
  };

  /**
   * The state of @p spring after a step.
   * @param impulse of the point [N s]
   * @param n its normal
   * @param velocity c of the point after the kick [m/s]
   * @param strength of the point, for its dilation
   */
  template <int dim>
  inline SpringChange<dim>
  advance_spring(const PointSpring<dim> &spring,
                 const Vector<dim> &impulse,
                 const Vector<dim> &n,
                 const Vector<dim> &velocity,
                 const ContactStatus status,
                 const PointStrength &strength)
  {
    SpringChange<dim> change;
    SpringState<dim> &after = change.after;
    after.stretch = add<dim>(spring.before.stretch, spring.step, velocity);
    if (status == ContactStatus::open)
      {
        after.stretch = scale_parts<dim>(after.stretch, n, 1., 0.);
        return change;
      }
    after.force = scale_parts<dim>(spring.bounded_part(impulse, n),
                                   n,
                                   1. / spring.kick,
                                   1. / spring.kick);
    if (status == ContactStatus::sticking)
      return change;
    // what strength has not let the force take up has slipped for good
    const Vector<dim> wanted =
      add<dim>(spring.before.stretch, spring.tau_shear * spring.step, velocity);
    const Vector<dim> elastic =
      add<dim>(Vector<dim>{}, -1. / spring.shear, after.force);
    change.slip   = scale_parts<dim>(add<dim>(wanted, -1., elastic), n, 0., 1.);
    after.stretch = add<dim>(after.stretch, -1., change.slip);
    after.stretch =
      add<dim>(after.stretch, -strength.dilation * norm<dim>(change.slip), n);
    return change;
  }
} // namespace Keyblock

#endif
