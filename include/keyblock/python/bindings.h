// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_python_bindings_h
#define keyblock_python_bindings_h

#include <keyblock/python/process.h>

#include <pybind11/functional.h>
#include <pybind11/iostream.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <iostream>
#include <optional>

// What the parts of the Python module share.
namespace Keyblock::Python
{
  namespace py = pybind11;

  void bind_scene(py::module_ &module);
  void bind_blocks(py::module_ &module);
  void bind_run(py::module_ &module);

  using RunPointer = std::shared_ptr<AnyRun>;
  using RunClass   = py::class_<AnyRun, RunPointer>;
  void bind_joint_points(RunClass &run);

  /** Blocks with their rows, which are asked for again and again. */
  struct BlockList
  {
    explicit BlockList(const std::shared_ptr<const AnyBlocks> &blocks)
      : blocks(blocks)
      , rows(blocks->rows())
    {}

    std::shared_ptr<const AnyBlocks> blocks;
    std::vector<BlockRow> rows;
  };

  /** The value of @p action, done by compute() while other threads of Python
   * can go on; its messages go to Python's standard output. */
  template <typename Action>
  auto
  computed(const bool is_verbose, const Action &action)
  {
    std::optional<decltype(action())> value;
    bool was_asked = false;
    {
      std::optional<py::scoped_ostream_redirect> screen;
      if (is_verbose)
        screen.emplace(std::cout, py::module_::import("sys").attr("stdout"));
      py::gil_scoped_release release;
      was_asked = compute([&]() { value.emplace(action()); });
    }
    // nothing has looked for the signal: Python does
    if (was_asked)
      PyErr_SetInterrupt();
    return std::move(*value);
  }

  template <typename Number>
  py::array_t<Number>
  as_numpy(const Array<Number> &array)
  {
    return py::array_t<Number>(array.shape, array.values.data());
  }
} // namespace Keyblock::Python

#endif
