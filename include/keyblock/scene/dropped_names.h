// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_scene_dropped_names_h
#define keyblock_scene_dropped_names_h

#include <keyblock/scene/text.h>

namespace Keyblock
{
  /** Materials/Names where nothing gives it. */
  constexpr const char *default_materials = "rock";

  /**
   * Leave out the subsections of names that the file's list, `Names`, has and
   * an override takes out of it, as --set "Joint sets/Names=" does: the file
   * need not be changed. Subsections that the file's own list does not have
   * stay, so that a wrong name is found.
   */
  void drop_names_taken_out(SceneText &scene);

  /**
   * The overrides with `Section/PATTERN/Entry=value`, as `Bolts/r?/Area=4e-4`,
   * once for each name of the section's list that the pattern is of; lists are
   * those of overrides, else of the file's @p text. Those of joints stay as
   * they are. Throws InputError if a pattern is of no name.
   */
  std::vector<std::string>
  without_patterns(const std::string &text,
                   const std::vector<std::string> &assignments);
} // namespace Keyblock

#endif
