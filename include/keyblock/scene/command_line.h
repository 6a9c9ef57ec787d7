// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_scene_command_line_h
#define keyblock_scene_command_line_h

#include <string>
#include <vector>

namespace Keyblock
{
  /** What the command line asks for. Throws InputError for what it cannot
   * mean. */
  struct CommandLine
  {
    CommandLine(int argc, const char *const argv[]);

    std::string scene;
    std::vector<std::string> overrides;
    std::string output;
    std::string restart; ///< checkpoint to continue from
    std::string factors; ///< folder or file of states to find factors from
    bool is_validation = false;
    bool is_study      = false; ///< of probabilities, in place of a run

    /** Text to print instead of running (--help, --version,
     * --print-parameters); empty: run. */
    std::string answer;
  };
} // namespace Keyblock

#endif
