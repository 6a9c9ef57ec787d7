// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/mpi.h>

#include <keyblock/base/last_resort.h>
#include <keyblock/base/single_process.h>
#include <keyblock/run/program.h>

int
main(int argc, char *argv[])
{
  Keyblock::start_no_daemon();
  // the libraries that are started here need not see the scene's arguments
  int n_names       = 1;
  char *only_name[] = {argv[0], nullptr}, **names = only_name;
  dealii::Utilities::MPI::MPI_InitFinalize mpi(n_names, names, 1);
  dealii::deal_II_exceptions::disable_abort_on_exception();
  std::set_terminate(Keyblock::end_with_a_sentence);
  return Keyblock::run_program(Keyblock::Communicator(MPI_COMM_WORLD),
                               argc,
                               argv);
}
