// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_scene_entries_h
#define keyblock_scene_entries_h

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <utility>
#include <vector>

// Entries of a scene by their names, as `Joints/base/Dip`.
namespace Keyblock
{
  /** Entries and their values in the lines of a parameter file, in their order,
   * without comments. The lines are as a ParameterHandler writes them. */
  std::vector<std::pair<std::string, std::string>>
  list_entries(const std::string &text);

  /** Put what was derived into the entries of @p section that used.prm shows.
   */
  void
  set_entries(dealii::ParameterHandler &prm,
              const std::string &section,
              const std::vector<std::pair<std::string, std::string>> &entries);

  /** Lines of a parameter file that set the entry `Section/Sub/Entry`, by its
   * present name.
   * @param warnings takes a sentence for each name that has changed */
  std::string lines_setting(const std::string &entry,
                            const std::string &value,
                            std::vector<std::string> *warnings = nullptr);

  /** What follows the last slash of an entry. */
  std::string last_of(const std::string &entry);

  /** Whether an entry of a joint or a set, by its last part, says how strong it
   * is. */
  bool is_strength(const std::string &name);

  /** Whether an entry changes neither mesh nor blocks. */
  bool leaves_geometry(const std::string &entry);
} // namespace Keyblock

#endif
