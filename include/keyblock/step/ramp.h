// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_step_ramp_h
#define keyblock_step_ramp_h

namespace Keyblock
{
  /** The way from all of something to nothing of it, as half a cosine. */
  struct Ramp
  {
    double duration = 0.; ///< [s]
    double progress = 1.; ///< share of the duration that has passed [-]
    double pace     = 1.; ///< below 1 where it would outrun the rock [-]

    /** At the start of a ramp, or at its end if @p duration is zero [s]. */
    static Ramp over(const double duration);

    bool
    is_running() const
    {
      return progress < 1.;
    }

    /** Share that is left now [-]. */
    double share_left() const;

    /** Share that goes in the next step of this length [s -> -]. */
    double share_of_step(const double step) const;

    /** Move on by a step [s] times the pace. */
    void advance(const double step);

  private:
    double progress_after(const double step) const;
  };
} // namespace Keyblock

#endif
