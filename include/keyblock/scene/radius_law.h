// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_scene_radius_law_h
#define keyblock_scene_radius_law_h

#include <keyblock/base/random_numbers.h>
#include <keyblock/scene/scene.h>

namespace Keyblock
{
  /**
   * The law of the radii of a set of discs (half lengths in 2D), cut off at its
   * bounds: constant; uniform; exponential; lognormal; power law, with a
   * density proportional to r^-exponent. Mean and standard deviation are those
   * before the law is cut off.
   */
  class RadiusLaw
  {
  public:
    /** Throws InputError if the entries of @p set make no law. */
    template <int dim>
    explicit RadiusLaw(const JointSet<dim> &set);

    /** E[r^k] of the law as it is cut off [m^k], k = 1 or 2. */
    double moment(const int k) const;

    /** The numbers that make a radius, and the radius but for round-off [m]. */
    struct Draw
    {
      RandomNumbers::Pair numbers;
      double estimate;
    };

    Draw draw(RandomNumbers &random) const;

    /** The radius of a draw [m]: by doubles, or by Real. */
    template <typename Number>
    Number radius_of(const RandomNumbers::Pair &numbers) const;

    /** The largest radius there can be [m]. */
    double
    maximum() const
    {
      return upper;
    }

  private:
    /** Probability that a lognormal radius times r^k / E[r^k] is within the
     * bounds. */
    double share_within_bounds(const int k) const;

    const RadiusDistribution law;
    const double mean, deviation, exponent;
    const double lower;
    double upper;
    double log_mean = 0., log_deviation = 0.;
    Real mu, sigma; ///< the same with more digits
  };
} // namespace Keyblock

#endif
