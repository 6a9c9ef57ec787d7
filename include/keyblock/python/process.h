// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_python_process_h
#define keyblock_python_process_h

#include <keyblock/python/any_run.h>

#include <functional>

namespace Keyblock::Python
{
  /** Start MPI and deal.II, once, unless somebody else has started MPI. */
  void start_process();

  /** Close all runs and end MPI, if start_process() has started it; nothing
   * can be computed afterwards. */
  void end_process();

  /** Have @p run closed before MPI ends. */
  void close_at_end(const std::shared_ptr<AnyRun> &run);

  /** Let go of @p run when nothing is computed. */
  void drop(std::shared_ptr<AnyRun> run);

  /**
   * Do @p action, one at a time in this process, with SIGINT watched: it then
   * throws StopRequest.
   * @return whether SIGINT came and nothing has thrown
   */
  bool compute(const std::function<void()> &action);
} // namespace Keyblock::Python

#endif
