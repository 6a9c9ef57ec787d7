// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_scene_step_count_h
#define keyblock_scene_step_count_h

#include <keyblock/scene/scene.h>

#include <cstdint>

namespace Keyblock
{
  /** Most steps of a stage: beyond, not every number is a double [-]. */
  constexpr double most_steps = 9007199254740992.;

  /**
   * Number of equal steps, of @p longest [s] at most, that make up the duration
   * of @p stage; a step may be longer by a billionth of it. Throws InputError
   * if the duration is none, if it rounds to no step, or if it takes more than
   * `most_steps`.
   */
  std::uint64_t count_steps(const Stage &stage, const double longest);

  /** Number of steps of length @p dt [s] that @p stage may take: those of its
   * duration, or its maximum. */
  std::uint64_t plan_steps(const Stage &stage, const double dt);
} // namespace Keyblock

#endif
