// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_safety_trial_bracket_h
#define keyblock_safety_trial_bracket_h

#include <keyblock/safety/strength_trial.h>

#include <algorithm>
#include <cmath>

namespace Keyblock
{
  /** What trials have shown of a number below which a block holds and above
   * which it fails. */
  struct TrialBracket
  {
    double stable = 0., unstable = 0.; ///< 0: none known

    /** Numbers without a verdict; 0: none. */
    double undecided_lower = 0., undecided_upper = 0.;

    /** Take in what a trial at a @p number showed. */
    void
    add(const double number, const Trial &trial)
    {
      if (trial.is_stable)
        stable = std::max(stable, number);
      else if (trial.is_undecided)
        {
          ++n_undecided;
          undecided_lower =
            undecided_upper == 0. ? number : std::min(undecided_lower, number);
          undecided_upper = std::max(undecided_upper, number);
        }
      else
        unstable = number;
      forget_undecided_outside();
    }

    /** Whether @p number would tell something new. */
    bool
    is_open(const double number) const
    {
      return number > stable && (unstable == 0. || number < unstable) &&
             (number < undecided_lower || number > undecided_upper);
    }

    /** Whether the bracket is as narrow as a @p share of its upper end, but for
     * undecided numbers in it; or does not get narrower. */
    bool
    is_narrow(const double share) const
    {
      if (unstable == 0.)
        return false;
      const double width = share * unstable;
      return undecided_upper == 0.
               ? unstable - stable <= width
               : is_hopeless() || (undecided_lower - stable <= width &&
                                   unstable - undecided_upper <= width);
    }

    /** Whether so many trials were undecided that more are of no use. */
    bool
    is_hopeless() const
    {
      return n_undecided >= most_undecided;
    }

    /** The number to try next in a closed bracket. */
    double
    next() const
    {
      const auto middle = [](const double a, const double b) {
        return b > 2. * a ? std::sqrt(a * b) : 0.5 * (a + b);
      };
      if (undecided_upper == 0.)
        return middle(stable, unstable);
      return unstable - undecided_upper > undecided_lower - stable
               ? middle(undecided_upper, unstable)
               : middle(stable, undecided_lower);
    }

  private:
    /** Trials without a verdict after which a search ends. */
    static constexpr unsigned int most_undecided = 6;

    /** What holds or fails decides those below or above it. */
    void
    forget_undecided_outside()
    {
      if (undecided_upper == 0.)
        return;
      undecided_lower = std::max(undecided_lower, stable);
      if (unstable > 0.)
        undecided_upper = std::min(undecided_upper, unstable);
      if (undecided_upper <= stable ||
          (unstable > 0. && undecided_lower >= unstable))
        undecided_lower = undecided_upper = 0.;
    }

    unsigned int n_undecided = 0;
  };
} // namespace Keyblock

#endif
