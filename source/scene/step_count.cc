// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/errors.h>
#include <keyblock/base/number_text.h>
#include <keyblock/scene/step_count.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace Keyblock
{
  namespace
  {
    /** Share of a step that is not counted as one [-]. */
    constexpr double least_share = 1e-9;

  } // namespace



  std::uint64_t
  count_steps(const Stage &stage, const double longest)
  {
    const std::string entry = "'Stages/" + stage.name + "/Duration'";
    AssertThrow(std::isfinite(stage.duration) && stage.duration > 0.,
                InputError("The entry " + entry + " is " +
                           text_of(stage.duration) +
                           " s; it has to be a positive number."));
    AssertThrow(longest > 0. && std::isfinite(longest),
                InputError("The time step of the stage '" + stage.name +
                           "' would be " + text_of(longest) +
                           " s, as no cell that deforms bounds it; set 'Time "
                           "stepping/Maximum step'."));
    const double n_steps = std::ceil(stage.duration / longest - least_share);
    AssertThrow(n_steps >= 1.,
                InputError("The stage '" + stage.name + "' lasts " +
                           text_of(stage.duration) +
                           " s, which rounds to no time step of " +
                           text_of(longest) + " s; raise " + entry +
                           ", or leave the stage out."));
    AssertThrow(
      n_steps <= most_steps,
      InputError("The stage '" + stage.name + "' of " +
                 text_of(stage.duration) + " s would take " + text_of(n_steps) +
                 " time steps of " + text_of(longest) + " s, more than the " +
                 text_of(most_steps) + " that can be counted; lower " + entry +
                 ", or raise 'Time stepping/Maximum step'."));
    return static_cast<std::uint64_t>(n_steps);
  }



  std::uint64_t
  plan_steps(const Stage &stage, const double dt)
  {
    if (stage.duration == 0.)
      return stage.maximum_steps;
    // dt is a whole part of the duration, as count_steps has it
    const auto n_steps =
      static_cast<std::uint64_t>(std::round(stage.duration / dt));
    return stage.maximum_steps > 0
             ? std::min<std::uint64_t>(n_steps, stage.maximum_steps)
             : n_steps;
  }
} // namespace Keyblock
