// SPDX-License-Identifier: LGPL-2.1-or-later
// All unit tests in one program, on any number of ranks.
#define BOOST_TEST_NO_MAIN
#define BOOST_TEST_ALTERNATIVE_INIT_API
#include <deal.II/base/mpi.h>

#include <boost/test/included/unit_test.hpp>

#include <filesystem>

int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  dealii::deal_II_exceptions::disable_abort_on_exception();
  // what tests write lies beside the program, wherever it is started from
  const std::filesystem::path files =
    std::filesystem::absolute(argv[0]).parent_path() / "unit_files";
  std::filesystem::create_directories(files);
  std::filesystem::current_path(files);
  const auto do_nothing = []() { return true; };
  return boost::unit_test::unit_test_main(do_nothing, argc, argv);
}
