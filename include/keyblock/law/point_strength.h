// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_law_point_strength_h
#define keyblock_law_point_strength_h

namespace Keyblock
{
  /** What a contact point did in the last step. */
  enum class ContactStatus : unsigned char
  {
    open,
    sticking,
    sliding
  };

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
    double dilation         = 0.; ///< tan(psi): opening over slip

    /** Largest shear [N s] under the normal impulse @p r_n: of a point that
     * sticks, and of one that slides. */
    double
    sticking_limit(const double r_n) const
    {
      return cohesion + static_friction * r_n;
    }
    double
    sliding_limit(const double r_n) const
    {
      return cohesion + kinetic_friction * r_n;
    }
  };
} // namespace Keyblock

#endif
