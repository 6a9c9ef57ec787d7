// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_teams_h
#define keyblock_teams_h

namespace Keyblock
{
  // Teams of ranks. Each computes the same stages, on the ranks of world();
  // they share out the blocks whose safety factors are looked for. Only the
  // first team prints and writes.

  /** Split all ranks into @p wanted teams (collective over all ranks). Throws
   * InputError if their number does not divide that of the ranks. */
  void form_teams(const unsigned int wanted);

  unsigned int n_teams();

  unsigned int this_team();

  /** Until every rank of every team is here; throws StopRequest if a signal
   * comes while waiting. */
  void wait_for_all_teams();
} // namespace Keyblock

#endif
