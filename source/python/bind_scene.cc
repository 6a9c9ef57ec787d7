// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/python/bindings.h>
#include <keyblock/scene/entries.h>

namespace Keyblock::Python
{
  namespace
  {
    using ScenePointer = std::shared_ptr<const AnyScene>;

    /** A value of Python as a scene has it: true, 1.5, or "1, 2, 3". */
    std::string
    entry_text(const py::handle &value)
    {
      if (py::isinstance<py::bool_>(value))
        return value.cast<bool>() ? "true" : "false";
      if (py::isinstance<py::str>(value))
        return value.cast<std::string>();
      if (!py::hasattr(value, "__iter__"))
        return py::str(value).cast<std::string>();
      std::string text;
      for (const py::handle one : value)
        text += (text.empty() ? "" : ", ") + entry_text(one);
      return text;
    }



    std::vector<std::string>
    assignments(const py::dict &overrides)
    {
      std::vector<std::string> list;
      for (const auto &[entry, value] : overrides)
        list.push_back(entry.cast<std::string>() + "=" + entry_text(value));
      return list;
    }



    ScenePointer
    read_scene(const py::object &file,
               const std::optional<std::string> &text,
               const py::dict &overrides,
               const bool is_alone)
    {
      SceneSource source;
      source.overrides = assignments(overrides);
      source.is_alone  = is_alone;
      if (!file.is_none())
        source.file =
          py::module_::import("os").attr("fspath")(file).cast<std::string>();
      return computed(false, [&]() {
        AssertThrow(source.file.empty() != !text,
                    InputError("A scene was given " +
                               std::string(text ? "both a file and a text"
                                                : "neither a file nor a text") +
                               "; name one of them."));
        if (text)
          {
            source.text = std::make_shared<const SceneInMemory>(*text);
            source.file = source.text->name();
          }
        return AnyScene::read(source);
      });
    }



    ScenePointer
    change_scene(const AnyScene &scene, const py::dict &overrides)
    {
      SceneSource source = scene.source;
      for (const std::string &assignment : assignments(overrides))
        source.overrides.push_back(assignment);
      return computed(false, [&]() { return AnyScene::read(source); });
    }



    ScenePointer
    read_alone(const AnyScene &scene)
    {
      SceneSource source = scene.source;
      source.is_alone    = true;
      return computed(false, [&]() { return AnyScene::read(source); });
    }



    py::dict
    entries(const AnyScene &scene)
    {
      py::dict values;
      for (const auto &[entry, value] : list_entries(scene.used_entries()))
        values[py::str(entry)] = value;
      return values;
    }
  } // namespace



  void
  bind_scene(py::module_ &module)
  {
    py::class_<AnyScene, std::shared_ptr<AnyScene>>(
      module,
      "Scene",
      "A scene, read and checked. It does not change; with_overrides() gives "
      "another one.")
      .def(
        py::init([](const py::object &file,
                    const std::optional<std::string> &text,
                    const py::dict &overrides,
                    const bool is_alone) {
          return std::const_pointer_cast<AnyScene>(
            read_scene(file, text, overrides, is_alone));
        }),
        py::arg("file") = py::none(),
        py::kw_only(),
        py::arg("text")      = py::none(),
        py::arg("overrides") = py::dict(),
        py::arg("alone")     = false,
        "Read a .prm file, or the text of one.\n\n"
        "overrides: values by \"Section/Entry\"; numbers, words, booleans, "
        "or sequences of numbers. \"Joints/*/Friction angle\" is that of all "
        "joints.\n"
        "alone: under mpirun this scene, and what is made of it, is this "
        "rank's; otherwise all ranks must do the same with it, and share "
        "the work.\n"
        "Raises Error, with one sentence.")
      .def(
        "with_overrides",
        [](const AnyScene &scene, const py::dict &overrides) {
          return std::const_pointer_cast<AnyScene>(
            change_scene(scene, overrides));
        },
        py::arg("overrides"),
        "The scene read again with these values by \"Section/Entry\" besides "
        "those it has.")
      .def(
        "alone_again",
        [](const AnyScene &scene) {
          return std::const_pointer_cast<AnyScene>(read_alone(scene));
        },
        "The same scene, read again for this rank alone.")
      .def_property_readonly("dimension",
                             &AnyScene::dimension,
                             "2 (plane strain, forces per metre) or 3.")
      .def_property_readonly("title", &AnyScene::title, "Its entry Title.")
      .def_property_readonly(
        "file",
        [](const AnyScene &scene) { return scene.source.file; },
        "Name of its file, or one that stands for its text.")
      .def_property_readonly(
        "alone",
        [](const AnyScene &scene) { return scene.source.is_alone; },
        "Whether it is this rank's.")
      .def_property_readonly("warnings",
                             &AnyScene::warnings,
                             "What is allowed and probably not meant, one "
                             "sentence each.")
      .def_property_readonly("joints",
                             &AnyScene::joints,
                             "Names of all joints, those of tables and sets "
                             "included, in the order of the mesh's.")
      .def_property_readonly("stages",
                             &AnyScene::stages,
                             "Names of the stages.")
      .def_property_readonly("materials",
                             &AnyScene::materials,
                             "Names of the materials.")
      .def_property_readonly("entries",
                             entries,
                             "All entries with the values used, as texts, by "
                             "\"Section/Entry\"; every joint is written out.")
      .def("__repr__", [](const AnyScene &scene) {
        return "<keyblock.Scene '" + scene.source.file + "', " +
               std::to_string(scene.dimension()) + "D, " +
               std::to_string(scene.joints().size()) + " joints>";
      });
    module.def(
      "leaves_geometry",
      leaves_geometry,
      py::arg("entry"),
      "Whether another value of \"Section/Entry\" leaves mesh and "
      "blocks as they are: strengths of joints, water, loads, stages.");
    module.def(
      "validate",
      [](const std::shared_ptr<AnyScene> &scene, const bool is_verbose) {
        return computed(is_verbose,
                        [&]() { return AnyRun::validate(scene, is_verbose); });
      },
      py::arg("scene"),
      py::kw_only(),
      py::arg("verbose") = false,
      "Mesh the scene, find its blocks and set up a run, without a step. "
      "Returns the warnings; raises Error. verbose prints what keyblock "
      "--validate does.");
  }
} // namespace Keyblock::Python
