// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/python/process.h>

#include <deal.II/base/mpi.h>

#include <keyblock/base/interrupt_scope.h>
#include <keyblock/base/single_process.h>

#include <algorithm>
#include <mutex>

namespace Keyblock::Python
{
  namespace
  {
    /** What this process keeps from its first computation to its end. */
    struct Process
    {
      /** Gmsh and MPI are there once; a callback may compute, too. */
      std::recursive_mutex mutex;
      std::unique_ptr<InterruptScope> interrupts; ///< while it computes
      bool is_started = false, is_ended = false;
      std::unique_ptr<dealii::Utilities::MPI::MPI_InitFinalize> mpi;
      std::vector<std::weak_ptr<AnyRun>> runs;
    };

    Process &
    process()
    {
      // never destroyed: static objects of libraries may go before it
      static Process *const one = new Process;
      return *one;
    }
  } // namespace



  void
  start_process()
  {
    Process &p = process();
    AssertThrow(!p.is_ended,
                InputError("The program ends, and nothing can be computed any "
                           "more; compute before."));
    if (p.is_started)
      return;
    p.is_started     = true;
    int is_somebodys = 0;
    MPI_Initialized(&is_somebodys);
    if (is_somebodys == 0)
      {
        start_no_daemon();
        int n_names  = 1;
        char name[]  = "keyblock";
        char *all[]  = {name, nullptr};
        char **names = all;
        p.mpi =
          std::make_unique<dealii::Utilities::MPI::MPI_InitFinalize>(n_names,
                                                                     names,
                                                                     1);
      }
    dealii::deal_II_exceptions::disable_abort_on_exception();
  }



  void
  end_process()
  {
    Process &p = process();
    const std::lock_guard<std::recursive_mutex> lock(p.mutex);
    p.is_ended = true;
    for (const std::weak_ptr<AnyRun> &one : p.runs)
      if (const std::shared_ptr<AnyRun> run = one.lock())
        run->close();
    p.mpi = nullptr;
  }



  void
  close_at_end(const std::shared_ptr<AnyRun> &run)
  {
    auto &runs = process().runs;
    runs.erase(std::remove_if(runs.begin(),
                              runs.end(),
                              [](const auto &one) { return one.expired(); }),
               runs.end());
    runs.push_back(run);
  }



  void
  drop(std::shared_ptr<AnyRun> run)
  {
    const std::lock_guard<std::recursive_mutex> lock(process().mutex);
    run = nullptr;
  }



  bool
  compute(const std::function<void()> &action)
  {
    Process &p = process();
    const std::lock_guard<std::recursive_mutex> lock(p.mutex);
    if (p.interrupts) // called from a callback
      {
        action();
        return false;
      }
    p.interrupts = std::make_unique<InterruptScope>();
    try
      {
        start_process();
        action();
      }
    catch (...)
      {
        p.interrupts = nullptr;
        throw;
      }
    const bool was_asked = signal_received() > 0;
    p.interrupts         = nullptr;
    return was_asked;
  }
} // namespace Keyblock::Python
