// SPDX-License-Identifier: LGPL-2.1-or-later
// Reads a scene by the installed library and prints its dimension.
#include <keyblock/scene/scene.h>

#include <deal.II/base/mpi.h>

#include <iostream>

int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  std::cout << "dimension "
            << Keyblock::read_dimension(Keyblock::Communicator(MPI_COMM_WORLD),
                                        argv[1],
                                        {})
            << '\n';
}
