// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_tests_unit_world_h
#define keyblock_tests_unit_world_h

#include <deal.II/base/conditional_ostream.h>

#include <keyblock/base/communicator.h>

#include <iostream>

namespace Keyblock
{
  /** All ranks of the tests. */
  inline const Communicator world(MPI_COMM_WORLD);

  /** For messages that nobody reads. */
  inline const dealii::ConditionalOStream silent(std::cout, false);
} // namespace Keyblock

#endif
