// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_base_single_process_h
#define keyblock_base_single_process_h

namespace Keyblock
{
  /**
   * Before MPI starts: a process that nobody started as one of several
   * starts no others. Open MPI 4 runs a daemon beside it for that case, which
   * costs a fifth of a second. Without effect under mpirun, with other MPIs,
   * and if the user has set `OMPI_MCA_ess_singleton_isolated`.
   */
  void start_no_daemon();
} // namespace Keyblock

#endif
