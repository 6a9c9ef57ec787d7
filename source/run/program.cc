// SPDX-License-Identifier: LGPL-2.1-or-later
// What a command line asks for.
#include <keyblock/base/last_resort.h>
#include <keyblock/base/stop_request.h>
#include <keyblock/run/folded_lines.h>
#include <keyblock/run/probability_study.h>
#include <keyblock/run/program.h>
#include <keyblock/run/progress_line.h>
#include <keyblock/run/simulation.h>
#include <keyblock/scene/command_line.h>

#include <iostream>

namespace Keyblock
{
  namespace
  {
    template <int dim>
    void
    run(const Communicator &world, const CommandLine &arguments)
    {
      if (arguments.is_study)
        {
          watch_signals();
          ProbabilityStudy<dim>(world,
                                arguments.scene,
                                arguments.overrides,
                                arguments.output)
            .run();
          return;
        }
      Simulation<dim> simulation(world,
                                 arguments.scene,
                                 arguments.overrides,
                                 arguments.output,
                                 arguments.restart);
      if (arguments.is_validation)
        {
          simulation.validate();
          return;
        }
      watch_signals();
      if (!arguments.factors.empty())
        simulation.find_factors(arguments.factors);
      else
        simulation.run();
    }
  } // namespace



  int
  run_program(const Communicator &world,
              const int argc,
              const char *const argv[])
  {
    const FoldedLines folded(std::cout, []() { return terminal_width(); });
    try
      {
        const CommandLine arguments(argc, argv);
        if (!arguments.answer.empty())
          {
            if (world.is_root())
              std::cout << arguments.answer << std::flush;
            AssertThrow(std::cout,
                        ComputationError(
                          "The answer cannot be written; check free space."));
          }
        else if (read_dimension(world, arguments.scene, arguments.overrides) ==
                 2)
          run<2>(world, arguments);
        else
          run<3>(world, arguments);
        return 0;
      }
    catch (const InputError &error)
      {
        if (world.is_root())
          std::cerr << "Error: " << in_one_line(error.message) << std::endl;
        return 1;
      }
    catch (const ComputationError &error)
      {
        if (world.is_root())
          {
            clear_progress(std::cout);
            std::cerr << "Failed: " << in_one_line(error.message) << std::endl;
          }
        return 2;
      }
    catch (const StopRequest &request)
      {
        return 128 + request.signal;
      }
    catch (...)
      {
        std::cerr << "Failed: " << describe_present_exception() << std::endl;
        if (world.size() > 1)
          MPI_Abort(world, 2);
        return 2;
      }
  }
} // namespace Keyblock
