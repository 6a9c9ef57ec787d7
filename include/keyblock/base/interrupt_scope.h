// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_base_interrupt_scope_h
#define keyblock_base_interrupt_scope_h

#include <csignal>

namespace Keyblock
{
  /**
   * For as long as it lives SIGINT asks to stop, as after watch_signals(), but
   * never ends the process; then it does what it did before, and a request that
   * came is forgotten. For programs that go on after a run, as an interpreter.
   */
  class InterruptScope
  {
  public:
    InterruptScope();
    ~InterruptScope();
    InterruptScope(const InterruptScope &)            = delete;
    InterruptScope &operator=(const InterruptScope &) = delete;

  private:
    struct sigaction before;
  };
} // namespace Keyblock

#endif
