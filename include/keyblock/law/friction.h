// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_law_friction_h
#define keyblock_law_friction_h

#include <keyblock/base/vector.h>
#include <keyblock/law/point_strength.h>

namespace Keyblock
{
  /** An impulse and what it means. */
  template <int dim>
  struct PointResponse
  {
    Vector<dim> impulse;
    ContactStatus status;
  };

  /** What an impulse has beyond a strength [N s]; positive: too much. */
  struct Excess
  {
    double tension, shear;
  };

  /** What @p impulse has beyond the Mohr-Coulomb cone with tension cut-off:
   * r_n >= -T, |r_t| <= C + mu_s r_n. */
  template <int dim>
  inline Excess
  excess_over_strength(const Vector<dim> &impulse,
                       const Vector<dim> &normal,
                       const PointStrength &strength)
  {
    const double r_n = dot<dim>(impulse, normal);
    const double r_t = norm<dim>(add<dim>(impulse, -r_n, normal));
    return {-r_n - strength.tension, r_t - strength.sticking_limit(r_n)};
  }

  /** The larger of the two: positive when an intact point breaks. */
  template <int dim>
  inline double
  violation(const Vector<dim> &impulse,
            const Vector<dim> &normal,
            const PointStrength &strength)
  {
    const Excess excess = excess_over_strength<dim>(impulse, normal, strength);
    return excess.tension > excess.shear ? excess.tension : excess.shear;
  }

  /**
   * The admissible impulse nearest to the impulse @p stick that would stop the
   * point: nothing in tension, the friction limit if that is exceeded. How
   * strong the point is, its joint's law says (law/joint_law.h).
   *
   *   r_n < -T opens;  |r_t| <= C + mu_s r_n sticks,
   *   else r_t = (C + mu_k r_n) r_t / |r_t|.
   *
   * A joint that dilates opens by tan(psi) of what it slips, for which its
   * normal impulse grows: r_n = (r_n + tan(psi) (|r_t| - C)) / (1 + tan(psi)
   * mu_k).
   *
   * The solution of the contact problem of one point if its inverse mass is
   * the same in all directions.
   */
  template <int dim>
  inline PointResponse<dim>
  admissible_impulse(const Vector<dim> &stick,
                     const Vector<dim> &normal,
                     const PointStrength &strength)
  {
    double r_n                = dot<dim>(stick, normal);
    const Vector<dim> tangent = add<dim>(stick, -r_n, normal);
    const double r_t          = norm<dim>(tangent);
    const bool sticks         = r_t <= strength.sticking_limit(r_n);
    if (strength.dilation > 0. && !sticks)
      r_n = (r_n + strength.dilation * (r_t - strength.cohesion)) /
            (1. + strength.dilation * strength.kinetic_friction);
    if (r_n < -strength.tension)
      return {Vector<dim>{}, ContactStatus::open};
    if (sticks)
      return {stick, ContactStatus::sticking};
    const double limit = strength.sliding_limit(r_n);
    Vector<dim> impulse;
    for (int d = 0; d < dim; ++d)
      impulse[d] =
        r_n * normal[d] + (limit > 0. ? limit / r_t : 0.) * tangent[d];
    return {impulse, ContactStatus::sliding};
  }
} // namespace Keyblock

#endif
