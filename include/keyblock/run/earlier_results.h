// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_run_earlier_results_h
#define keyblock_run_earlier_results_h

#include <keyblock/scene/scene.h>

#include <filesystem>
#include <string>
#include <vector>

namespace Keyblock
{
  /**
   * Files that an earlier run has written to an output @p folder, with '/' at
   * its end: those with names that runs give, if its used.prm is there. What
   * the @p scene reads is none of them.
   */
  template <int dim>
  std::vector<std::filesystem::path>
  list_earlier_results(const std::string &folder, const Scene<dim> &scene);

  /**
   * Remove @p files of an earlier run from the @p folder, but for the
   * checkpoint of one that has not ended, which gets another name. Returns
   * what was done in a line, or nothing.
   */
  std::string
  remove_earlier_results(const std::vector<std::filesystem::path> &files,
                         const std::string &folder);
} // namespace Keyblock

#endif
