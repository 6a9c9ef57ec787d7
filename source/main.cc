// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/mpi.h>

#include <keyblock/base/communicator.h>
#include <keyblock/base/last_resort.h>
#include <keyblock/base/stop_request.h>
#include <keyblock/run/probability_study.h>
#include <keyblock/run/simulation.h>
#include <keyblock/scene/command_line.h>

#include <iostream>

namespace
{
  template <int dim>
  void
  run(const Keyblock::Communicator &world,
      const Keyblock::CommandLine &arguments)
  {
    if (arguments.is_study)
      {
        Keyblock::watch_signals();
        Keyblock::ProbabilityStudy<dim>(world,
                                        arguments.scene,
                                        arguments.overrides,
                                        arguments.output)
          .run();
        return;
      }
    Keyblock::Simulation<dim> simulation(world,
                                         arguments.scene,
                                         arguments.overrides,
                                         arguments.output,
                                         arguments.restart);
    if (arguments.is_validation)
      {
        simulation.validate();
        return;
      }
    Keyblock::watch_signals();
    if (!arguments.factors.empty())
      simulation.find_factors(arguments.factors);
    else
      simulation.run();
  }
} // namespace

int
main(int argc, char *argv[])
{
  // the libraries that are started here need not see the scene's arguments
  int n_names       = 1;
  char *only_name[] = {argv[0], nullptr}, **names = only_name;
  dealii::Utilities::MPI::MPI_InitFinalize mpi(n_names, names, 1);
  const Keyblock::Communicator world(MPI_COMM_WORLD);
  dealii::deal_II_exceptions::disable_abort_on_exception();
  std::set_terminate(Keyblock::end_with_a_sentence);
  int exit_code = 0;
  try
    {
      const Keyblock::CommandLine arguments(argc, argv);
      if (!arguments.answer.empty())
        {
          if (world.is_root())
            std::cout << arguments.answer << std::flush;
          AssertThrow(std::cout,
                      Keyblock::ComputationError(
                        "The answer cannot be written; check free space."));
        }
      else if (Keyblock::read_dimension(world,
                                        arguments.scene,
                                        arguments.overrides) == 2)
        run<2>(world, arguments);
      else
        run<3>(world, arguments);
    }
  catch (const Keyblock::InputError &error)
    {
      if (world.is_root())
        std::cerr << "Error: " << Keyblock::in_one_line(error.message)
                  << std::endl;
      exit_code = 1;
    }
  catch (const Keyblock::ComputationError &error)
    {
      if (world.is_root())
        std::cerr << "Failed: " << Keyblock::in_one_line(error.message)
                  << std::endl;
      exit_code = 2;
    }
  catch (const Keyblock::StopRequest &request)
    {
      exit_code = 128 + request.signal;
    }
  catch (...)
    {
      std::cerr << "Failed: " << Keyblock::describe_present_exception()
                << std::endl;
      if (world.size() > 1)
        MPI_Abort(world, 2);
      exit_code = 2;
    }
  return exit_code;
}
