// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_run_program_h
#define keyblock_run_program_h

#include <keyblock/base/communicator.h>

namespace Keyblock
{
  /** One call of the program (collective): reads the command line and does what
   * it asks for. What went wrong is said in one line on standard error.
   * @return the exit code: 0; 1 for input that cannot be used; 2 for a
   * computation that failed; 128 and the signal that stopped it */
  int run_program(const Communicator &world,
                  const int argc,
                  const char *const argv[]);
} // namespace Keyblock

#endif
