// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/python/bindings.h>

#include <cmath>

namespace Keyblock::Python
{
  namespace
  {
    using Callback = std::function<void(const Advance &)>;

    RunPointer
    run_of_scene(const std::shared_ptr<AnyScene> &scene,
                 const py::object &output,
                 const py::object &restart,
                 const bool is_verbose)
    {
      const auto path = [](const py::object &name) {
        return name.is_none() ? std::string()
                              : py::module_::import("os")
                                  .attr("fspath")(name)
                                  .cast<std::string>();
      };
      const std::string folder = path(output), checkpoint = path(restart);
      const RunPointer run = computed(is_verbose, [&]() {
        return AnyRun::start(scene, folder, checkpoint, is_verbose);
      });
      close_at_end(run);
      // what goes while another thread computes waits, without Python's lock
      return RunPointer(run.get(), [kept = RunPointer(run)](AnyRun *) mutable {
        const py::gil_scoped_release release;
        drop(std::move(kept));
      });
    }



    void
    finish(const RunPointer &run)
    {
      if (!run->is_finished)
        computed(run->is_verbose, [&]() {
          run->finish();
          return true;
        });
    }



    /** The next stage; after the last one the results are written. */
    StageResult
    run_stage(const RunPointer &run,
              const std::optional<Callback> &callback,
              const unsigned int interval)
    {
      const Callback watcher  = callback ? *callback : Callback();
      const StageResult stage = computed(run->is_verbose, [&]() {
        AssertThrow(run->has_stage_left(),
                    InputError("The run has no stage left to be run; start "
                               "another one."));
        return run->run_stage(watcher, interval);
      });
      if (!run->has_stage_left())
        finish(run);
      return stage;
    }



    std::vector<StageResult>
    complete(const RunPointer &run,
             const std::optional<Callback> &callback,
             const unsigned int interval)
    {
      std::vector<StageResult> stages;
      while (run->has_stage_left())
        stages.push_back(run_stage(run, callback, interval));
      finish(run);
      return stages;
    }



    StageResult
    next_stage(const RunPointer &run)
    {
      if (run->has_stage_left())
        return run_stage(run, {}, 1);
      finish(run);
      throw py::stop_iteration();
    }



    /** An array that all ranks gather. */
    template <typename Function>
    auto
    gathered(Function function)
    {
      return [function](const RunPointer &run) {
        return as_numpy(
          computed(false, [&]() { return ((*run).*function)(); }));
      };
    }



    void
    bind_advance(py::module_ &module)
    {
      py::class_<Advance>(module, "Progress", "How far a stage is.")
        .def_readonly("stage", &Advance::stage, "Name of the stage.")
        .def_readonly("step", &Advance::step, "Steps of the stage so far.")
        .def_readonly("time", &Advance::time, "Simulated time (s).")
        .def_readonly("unbalanced_ratio",
                      &Advance::unbalance,
                      "Unbalanced force ratio, as last measured.")
        .def_readonly("ramp_left",
                      &Advance::ramp_left,
                      "Share of the excavation's forces still to be taken "
                      "away, 1 to 0.")
        .def_readonly("open_points", &Advance::n_open, "Contact points.")
        .def_readonly("sliding_points", &Advance::n_sliding, "Contact points.")
        .def("__repr__", [](const Advance &advance) {
          return "<keyblock.Progress " + advance.stage + ", step " +
                 std::to_string(advance.step) + ">";
        });
    }



    void
    bind_stage(py::module_ &module)
    {
      const auto of = [](auto member) {
        return
          [member](const StageResult &stage) { return stage.report.*member; };
      };
      py::class_<StageResult>(module, "Stage", "A stage that was run.")
        .def_property_readonly("name", of(&StageReport::name), "Its name.")
        .def_property_readonly("steps",
                               of(&StageReport::steps),
                               "Their number.")
        .def_property_readonly(
          "time",
          [](const StageResult &stage) { return stage.time; },
          "Simulated time at its end (s).")
        .def_property_readonly("time_step",
                               of(&StageReport::time_step),
                               "Length of its last step (s).")
        .def_property_readonly("unbalanced_ratio",
                               of(&StageReport::unbalanced_ratio),
                               "Unbalanced over driving force at its end.")
        .def_property_readonly(
          "converged",
          [](const StageResult &stage) {
            return stage.report.is_timed
                     ? std::nullopt
                     : std::make_optional(stage.report.is_converged);
          },
          "Whether forces balance as the scene asks for; "
          "None: it ended after its duration, not in "
          "balance.")
        .def_property_readonly("max_displacement",
                               of(&StageReport::max_displacement),
                               "Largest displacement since the start of the "
                               "rock that is there (m).")
        .def_property_readonly("remark",
                               of(&StageReport::remark),
                               "What moves, or has failed, in words.")
        .def_property_readonly(
          "energy_residual",
          [](const StageResult &stage) {
            return stage.report.energies.relative_residual();
          },
          "What the energies leave unexplained, over the work done.")
        .def_property_readonly(
          "energies",
          [](const StageResult &stage) {
            py::dict energies;
            for (const Energies::Term &term : Energies::terms())
              energies[py::str(term.name)] = stage.report.energies.*term.value;
            return energies;
          },
          "The ledger at its end, by name: J (2D: J/m).")
        .def_property_readonly(
          "points",
          [](const StageResult &stage) {
            const JointPoints &points = stage.report.points;
            py::dict numbers;
            numbers["open"]     = points.open;
            numbers["sliding"]  = points.sliding;
            numbers["sticking"] = points.sticking;
            numbers["intact"]   = points.intact;
            return numbers;
          },
          "Numbers of contact points by state.")
        .def("__repr__", [](const StageResult &stage) {
          return "<keyblock.Stage " + stage.report.name + ", " +
                 std::to_string(stage.report.steps) + " steps>";
        });
    }



    void
    bind_factor(py::module_ &module)
    {
      py::class_<FactorResult>(module,
                               "Factor",
                               "A safety factor by strength reduction.")
        .def_readonly("block", &FactorResult::block, "Id of the block.")
        .def_readonly("stage", &FactorResult::stage, "After this stage.")
        .def_readonly(
          "outcome",
          &FactorResult::outcome,
          "In words: value, falls freely, immovable, above 100, held "
          "by clamping, undecided, above what is wanted, or carried "
          "along.")
        .def_readonly("value",
                      &FactorResult::value,
                      "Middle of the bracket; nan: the outcome says why there "
                      "is none.")
        .def_readonly("lower",
                      &FactorResult::lower,
                      "Highest factor at which it held; 0: none.")
        .def_readonly("upper",
                      &FactorResult::upper,
                      "Lowest factor at which it failed; inf: none.")
        .def_readonly("failure_mode",
                      &FactorResult::failure_mode,
                      "In words: falling, sliding on J1, ...")
        .def_readonly(
          "group",
          &FactorResult::group,
          "Ids of blocks that move together when it fails; empty: it "
          "moves alone.")
        .def_readonly(
          "limit_factor",
          &FactorResult::limit_factor,
          "Factor by limit equilibrium, without the in-situ stress; "
          "inf: it cannot move.")
        .def_readonly("limit_mode", &FactorResult::limit_mode, "Its mode.")
        .def_readonly("stress_ratio",
                      &FactorResult::stress_ratio,
                      "Shear strength over shear force on the faces it slides "
                      "on, with the present forces; nan: none.")
        .def_readonly("trials", &FactorResult::n_trials, "Their number.")
        .def_readonly("seconds", &FactorResult::seconds, "They took (s).")
        .def("__repr__", [](const FactorResult &factor) {
          return "<keyblock.Factor of block " + std::to_string(factor.block) +
                 " after " + factor.stage + ": " +
                 (std::isnan(factor.value)
                    ? factor.outcome
                    : py::str(py::float_(factor.value)).cast<std::string>()) +
                 ">";
        });
    }



    /** What can be looked at between stages. */
    void
    bind_state(RunClass &run)
    {
      run
        .def_property_readonly("has_stage_left",
                               &AnyRun::has_stage_left,
                               "Whether a stage is still to be run.")
        .def_property_readonly(
          "factors",
          [](const RunPointer &run) {
            return computed(false, [&]() { return run->factors(); });
          },
          "Those that the scene asks for: list of Factor.")
        .def_property_readonly(
          "warnings",
          &AnyRun::warnings,
          "Of scene, set-up and the stages run so far, one "
          "sentence each.")
        .def_property_readonly("time", &AnyRun::time, "Simulated time (s).")
        .def_property_readonly(
          "blocks",
          [](const RunPointer &run) {
            return BlockList(computed(false, [&]() { return run->blocks(); }));
          },
          "A copy of its Blocks, which outlives the run.")
        .def_property_readonly(
          "displacement",
          gathered(&AnyRun::displacement),
          "Of blocks.vertices since the start, shape (n_vertices, "
          "dimension): m. Where all is dug away, or its block was taken away, "
          "the last value, which stages' max_displacement leaves out.")
        .def_property_readonly("velocity",
                               gathered(&AnyRun::velocity),
                               "The same: m/s.")
        .def_property_readonly("stress",
                               gathered(&AnyRun::stress),
                               "Mean stress of blocks.cells, tension positive, "
                               "shape (n_cells, 3, 3): "
                               "Pa. nan: rigid, or dug away.")
        .def_property_readonly(
          "history",
          [](const RunPointer &run) {
            const auto [names, table] =
              computed(false, [&]() { return run->history(); });
            return py::make_tuple(names, as_numpy(table));
          },
          "Names of the columns of history.csv, with units, and its rows, "
          "shape "
          "(n_rows, n_columns) (on rank 0).");
    }
  } // namespace



  void
  bind_run(py::module_ &module)
  {
    bind_advance(module);
    bind_stage(module);
    bind_factor(module);
    const auto callback_text =
      "callback(progress) is called about every `every` steps, at least 10; "
      "what it raises stops the stage, which the next call goes on with, and "
      "so "
      "does Ctrl-C (KeyboardInterrupt).";
    RunClass run(
      module,
      "Run",
      "A run of a scene, stage by stage: `for stage in run:` runs one a time. "
      "Arrays have the mesh of its blocks; under mpirun all ranks must ask for "
      "them, and have the same ones.");
    bind_state(run);
    bind_joint_points(run);
    run
      .def(py::init(&run_of_scene),
           py::arg("scene"),
           py::kw_only(),
           py::arg("output")  = py::none(),
           py::arg("restart") = py::none(),
           py::arg("verbose") = false,
           "Mesh, set-up and initial state. Raises Error.\n\n"
           "output: folder of the files that the program writes; none of them "
           "without it.\n"
           "restart: checkpoint.h5 to go on from.\n"
           "verbose: print what the program does.")
      .def("__iter__", [](const RunPointer &run) { return run; })
      .def("__next__",
           next_stage,
           "Run the next stage to its end: Stage. After the last one the "
           "results are written.")
      .def("run_stage",
           run_stage,
           py::arg("callback") = py::none(),
           py::arg("every")    = 100,
           (std::string(
              "Run the next stage to its end: Stage. Safety factors "
              "that the scene wants are found, too, and after the last "
              "stage the results are written.\n\n") +
            callback_text)
             .c_str())
      .def("complete",
           complete,
           py::arg("callback") = py::none(),
           py::arg("every")    = 100,
           (std::string("Run all stages that are left, and write the results: "
                        "list of Stage.\n\n") +
            callback_text)
             .c_str())
      .def(
        "find_factor",
        [](const RunPointer &run, const unsigned int block) {
          return computed(run->is_verbose,
                          [&]() { return run->find_factor(block); });
        },
        py::arg("block"),
        "Safety factor by strength reduction of the block with this id after "
        "the last stage that was run: Factor. The state is the same "
        "afterwards. Raises Error.")
      .def(
        "close",
        [](const RunPointer &run) {
          computed(false, [&]() {
            run->close();
            return true;
          });
        },
        "Free what it keeps; nothing else can be asked for afterwards.")
      .def("__enter__", [](const RunPointer &run) { return run; })
      .def("__exit__", [](const RunPointer &run, const py::args &) {
        computed(false, [&]() {
          run->close();
          return true;
        });
      });
  }
} // namespace Keyblock::Python
