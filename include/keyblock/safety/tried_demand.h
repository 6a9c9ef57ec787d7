// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_safety_tried_demand_h
#define keyblock_safety_tried_demand_h

#include <keyblock/safety/strength_trial.h>

#include <string>
#include <utility>
#include <vector>

namespace Keyblock
{
  /** What a wanted factor of a block asks for by strength reduction: the
   * pressure on the faces that SupportDemand's acts on, with which it holds at
   * that factor. */
  struct TriedDemand
  {
    enum class Outcome
    {
      not_sought,
      met,          ///< it holds without
      bracketed,    ///< it fails at lower, holds at upper
      out_of_reach, ///< it holds at no pressure, or has no face for it
      undecided     ///< it neither holds nor fails wherever it was tried
    };
    Outcome outcome = Outcome::not_sought;
    double lower    = 0.; ///< greatest pressure at which it fails [Pa]
    double upper    = 0.; ///< least one at which it holds [Pa]

    /** Pressures in the bracket at which it did neither; 0: none [Pa]. */
    double undecided_lower = 0., undecided_upper = 0.;

    double area = 0.; ///< size of the faces' vector sum [m^(dim-1)]

    /** Bolts of the sets of which the block has none, as
     * SupportDemand::numbers. */
    std::vector<std::pair<std::string, unsigned int>> numbers;

    std::vector<Trial> trials;

    /** [Pa] */
    double
    pressure() const
    {
      return 0.5 * (lower + upper);
    }

    /** [N] */
    double
    force() const
    {
      return pressure() * area;
    }
  };

  /** The outcome in words: met, support, out of reach or undecided. */
  std::string describe_outcome(const TriedDemand &demand);
} // namespace Keyblock

#endif
