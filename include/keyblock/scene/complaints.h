// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_scene_complaints_h
#define keyblock_scene_complaints_h

#include <string>

namespace dealii
{
  class ParameterHandler;
}

namespace Keyblock
{
  /** Throw InputError with the line of a subsection without its end, or of an
   * end too many.
   * @param file_name of which this is the @p text, with what it includes */
  void require_ends(const std::string &text, const std::string &file_name);

  /**
   * A sentence for the @p complaint of deal.II about a @p text that @p prm
   * could not parse: place, entry, value, and what would be right.
   * @param source of the text, for messages
   * @param has_lines whether the text has the lines of a file
   */
  std::string explain_complaint(const dealii::ParameterHandler &prm,
                                const std::string &complaint,
                                const std::string &text,
                                const std::string &source,
                                const bool has_lines);
} // namespace Keyblock

#endif
