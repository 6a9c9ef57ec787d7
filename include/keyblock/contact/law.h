// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_contact_law_h
#define keyblock_contact_law_h

#include <array>
#include <cmath>

namespace Keyblock
{
  /** What a contact point did in the last step. */
  enum class ContactStatus : unsigned char
  {
    open,
    sticking,
    sliding
  };

  template <int dim>
  using Vector = std::array<double, dim>;

  template <int dim>
  inline double
  dot(const Vector<dim> &a, const Vector<dim> &b)
  {
    double sum = 0.;
    for (int d = 0; d < dim; ++d)
      sum += a[d] * b[d];
    return sum;
  }

  template <int dim>
  inline double
  norm(const Vector<dim> &a)
  {
    return std::sqrt(dot<dim>(a, a));
  }

  /** a + s b */
  template <int dim>
  inline Vector<dim>
  add(const Vector<dim> &a, const double s, const Vector<dim> &b)
  {
    Vector<dim> result;
    for (int d = 0; d < dim; ++d)
      result[d] = a[d] + s * b[d];
    return result;
  }

  /**
   * Strength of one contact point. Limits are impulses: stress times area times
   * the kick interval [N s]. An intact point resists tension and cohesion; a
   * frictional one has cohesion = residual cohesion and no tension.
   */
  struct PointStrength
  {
    double static_friction  = 0.; ///< tan(phi) while it sticks
    double kinetic_friction = 0.; ///< tan(phi) while it slides
    double cohesion         = 0.;
    double tension          = 0.;
  };

  /** An impulse and what it means. */
  template <int dim>
  struct PointResponse
  {
    Vector<dim> impulse;
    ContactStatus status;
  };

  /**
   * By how much @p impulse leaves the strength of an intact point, relative to
   * the point's scale: positive when violated. The Mohr-Coulomb cone with
   * tension cut-off: r_n >= -T, |r_t| <= C + mu r_n.
   */
  template <int dim>
  inline double
  violation(const Vector<dim> &impulse,
            const Vector<dim> &normal,
            const PointStrength &strength)
  {
    const double r_n     = dot<dim>(impulse, normal);
    const double r_t     = norm<dim>(add<dim>(impulse, -r_n, normal));
    const double tensile = -r_n - strength.tension;
    const double shear =
      r_t - strength.cohesion - strength.static_friction * r_n;
    return tensile > shear ? tensile : shear;
  }

  /**
   * The admissible impulse nearest to the impulse @p stick that would stop the
   * point: nothing in tension, the friction limit if that is exceeded. This is
   * the whole friction law; change it here.
   *
   *   r_n < -T opens;  |r_t| <= C + mu_s r_n sticks,
   *   else r_t = (C + mu_k r_n) r_t / |r_t|.
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
    const double r_n          = dot<dim>(stick, normal);
    const Vector<dim> tangent = add<dim>(stick, -r_n, normal);
    const double r_t          = norm<dim>(tangent);
    if (r_n < -strength.tension)
      return {Vector<dim>{}, ContactStatus::open};
    if (r_t <= strength.cohesion + strength.static_friction * r_n)
      return {stick, ContactStatus::sticking};
    const double limit = strength.cohesion + strength.kinetic_friction * r_n;
    Vector<dim> impulse;
    for (int d = 0; d < dim; ++d)
      impulse[d] =
        r_n * normal[d] + (limit > 0. ? limit / r_t : 0.) * tangent[d];
    return {impulse, ContactStatus::sliding};
  }
} // namespace Keyblock

#endif
