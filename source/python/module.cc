// SPDX-License-Identifier: LGPL-2.1-or-later
// The Python module: errors, ranks, and its parts.
#include <keyblock/base/last_resort.h>
#include <keyblock/base/stop_request.h>
#include <keyblock/python/bindings.h>

#include <csignal>

namespace Keyblock::Python
{
  namespace
  {
    /** Exceptions become Python's, with the sentence that main() would print.
     */
    void
    bind_errors(py::module_ &module)
    {
      // never destroyed: the interpreter goes before static objects do
      static PyObject *const input_error =
        py::exception<InputError>(module, "Error", PyExc_ValueError)
          .release()
          .ptr();
      static PyObject *const computation_error =
        py::exception<ComputationError>(module,
                                        "ComputationError",
                                        PyExc_RuntimeError)
          .release()
          .ptr();
      module.attr("Error").attr("__doc__") =
        "A scene, or what is asked of it, cannot be used. The message is one "
        "sentence: what is wrong, the value found, the entry, the remedy.";
      module.attr("ComputationError").attr("__doc__") =
        "The computation failed: a number is not finite, a file cannot be "
        "written, or nothing converged where the scene demands it.";
      py::register_exception_translator([](std::exception_ptr pointer) {
        if (!pointer)
          return;
        try
          {
            std::rethrow_exception(pointer);
          }
        catch (const InputError &error)
          {
            PyErr_SetString(input_error, in_one_line(error.message).c_str());
          }
        catch (const ComputationError &error)
          {
            PyErr_SetString(computation_error,
                            in_one_line(error.message).c_str());
          }
        catch (const StopRequest &request)
          {
            if (request.signal == SIGINT)
              PyErr_SetNone(PyExc_KeyboardInterrupt);
            else
              PyErr_SetString(computation_error,
                              "A signal stopped the computation.");
          }
        catch (const std::bad_alloc &)
          {
            PyErr_SetString(PyExc_MemoryError,
                            describe_present_exception().c_str());
          }
        catch (const dealii::ExceptionBase &)
          {
            PyErr_SetString(PyExc_RuntimeError,
                            describe_present_exception().c_str());
          }
        catch (const std::string &)
          {
            // Gmsh's
            PyErr_SetString(PyExc_RuntimeError,
                            describe_present_exception().c_str());
          }
      });
    }



    py::array_t<double>
    sum_over_ranks(
      const py::array_t<double, py::array::c_style | py::array::forcecast>
        &numbers)
    {
      std::vector<double> values(numbers.data(),
                                 numbers.data() + numbers.size());
      values = computed(false, [&]() {
        Communicator(MPI_COMM_WORLD).sum_lists(values);
        return values;
      });
      return py::array_t<double>(std::vector<py::ssize_t>(numbers.shape(),
                                                          numbers.shape() +
                                                            numbers.ndim()),
                                 values.data());
    }



    void
    bind_ranks(py::module_ &module)
    {
      module.def(
        "rank",
        []() {
          return computed(false,
                          []() { return Communicator(MPI_COMM_WORLD).rank(); });
        },
        "Number of this rank of MPI, from 0 on.");
      module.def(
        "size",
        []() {
          return computed(false,
                          []() { return Communicator(MPI_COMM_WORLD).size(); });
        },
        "Number of ranks of MPI: 1 without mpirun.");
      module.def(
        "sum_over_ranks",
        sum_over_ranks,
        py::arg("numbers"),
        "The array of numbers (any shape, the same on all ranks), each "
        "summed over the ranks. All ranks must call it.");
    }
  } // namespace
} // namespace Keyblock::Python

PYBIND11_MODULE(_core, module)
{
  using namespace Keyblock::Python;
  module.doc()               = "Compiled part of the package keyblock.";
  module.attr("__version__") = KEYBLOCK_VERSION;
  bind_errors(module);
  bind_ranks(module);
  bind_scene(module);
  bind_blocks(module);
  bind_run(module);
  // before the interpreter's objects go, some of which need MPI
  py::module_::import("atexit").attr("register")(
    py::cpp_function(end_process, py::call_guard<py::gil_scoped_release>()));
}
