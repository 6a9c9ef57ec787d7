// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_base_stop_request_h
#define keyblock_base_stop_request_h

#include <keyblock/base/communicator.h>

namespace Keyblock
{
  /** Thrown on all ranks at the end of a step, when a signal asks the run to
   * stop. main() ends with 128 plus the signal. */
  struct StopRequest
  {
    int signal;
  };

  /**
   * From now on let SIGINT, SIGTERM and SIGUSR1 ask the run to stop; the second
   * one ends it at once. A limit on the size of files becomes an error of the
   * write that exceeds it.
   */
  void watch_signals();

  /** The signal that asked this rank to stop, or 0. */
  int signal_received();

  /** Throw StopRequest if a signal asks any rank to stop (collective). */
  void stop_if_asked(const Communicator &communicator);
} // namespace Keyblock

#endif
