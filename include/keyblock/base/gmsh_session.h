// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_base_gmsh_session_h
#define keyblock_base_gmsh_session_h

#include <functional>
#include <string>

namespace Keyblock
{
  /** Keeps Gmsh initialized, silent and free of anybody's configuration file
   * for as long as it lives. There may be one at a time. */
  class GmshSession
  {
  public:
    GmshSession();
    ~GmshSession();
    GmshSession(const GmshSession &)            = delete;
    GmshSession &operator=(const GmshSession &) = delete;
  };

  /** Run @p action, in which Gmsh (which throws strings) or a reader of files
   * may fail, and return why it failed; empty if it did not. */
  std::string reason_of_failure(const std::function<void()> &action);
} // namespace Keyblock

#endif
