// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/interrupt_scope.h>
#include <keyblock/base/stop_request.h>

#include <csignal>

namespace Keyblock
{
  namespace
  {
    volatile std::sig_atomic_t received = 0;

    void
    note(const int signal)
    {
      received = signal;
    }
  } // namespace



  void
  watch_signals()
  {
    struct sigaction action = {};
    action.sa_handler       = note;
    action.sa_flags         = SA_RESTART | SA_RESETHAND;
    for (const int signal : {SIGINT, SIGTERM, SIGUSR1})
      sigaction(signal, &action, nullptr);
    std::signal(SIGXFSZ, SIG_IGN);
  }



  int
  signal_received()
  {
    return received;
  }



  void
  stop_if_asked(const Communicator &communicator)
  {
    const int signal = communicator.max(signal_received());
    if (signal > 0)
      throw StopRequest{signal};
  }



  InterruptScope::InterruptScope()
  {
    received                = 0;
    struct sigaction action = {};
    action.sa_handler       = note;
    action.sa_flags         = SA_RESTART;
    sigaction(SIGINT, &action, &before);
  }



  InterruptScope::~InterruptScope()
  {
    sigaction(SIGINT, &before, nullptr);
    received = 0;
  }
} // namespace Keyblock
