// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/scene/command_line.h>

#include <keyblock/base/errors.h>
#include <keyblock/scene/scene.h>

#include <boost/program_options.hpp>

#include <sstream>

namespace Keyblock
{
  namespace
  {
    /** Throw InputError if an option was taken for the value of the one before
     * it. */
    void
    require_values(const boost::program_options::variables_map &values)
    {
      const auto require_value = [](const std::string &option,
                                    const std::string &value) {
        AssertThrow(value.compare(0, 2, "--") != 0,
                    InputError("The option --" + option + " is followed by '" +
                               value +
                               "', another option, where its value is "
                               "expected; write --" +
                               option +
                               (option == "set" ? " \"Section/Entry=value\"."
                                                : " and a name.")));
      };
      for (const auto &[option, value] : values)
        if (option == "set")
          for (const auto &text : value.as<std::vector<std::string>>())
            require_value(option, text);
        else if (const auto *text =
                   boost::any_cast<std::string>(&value.value()))
          require_value(option, *text);
    }
  } // namespace



  CommandLine::CommandLine(int argc, const char *const argv[])
  {
    namespace options = boost::program_options;
    options::options_description visible("Options"), all;
    visible.add_options()("validate",
                          "read, mesh and check; print blocks, their limit "
                          "equilibrium and what time and memory a run will "
                          "take; write nothing")(
      "study",
      "judge the samples that the section Study describes, by limit "
      "equilibrium or, with Study/Level full, those with critical blocks by "
      "runs")("set",
              options::value<std::vector<std::string>>(),
              "\"Section/Entry=value\": overrides an entry; may be repeated")(
      "restart",
      options::value<std::string>(),
      "checkpoint file to continue from, with the same scene")(
      "factors",
      options::value<std::string>(),
      "folder of a run with Output/Keep stages, or a file of a state: find the "
      "safety factors that the scene asks for now; no steps of stages")(
      "output", options::value<std::string>(), "output folder")(
      "print-parameters",
      "all entries of a scene, as Markdown")("help", "this text")("version",
                                                                  "version");
    all.add(visible).add_options()("scene",
                                   options::value<std::vector<std::string>>());
    options::positional_options_description positional;
    positional.add("scene", -1);
    options::variables_map values;
    try
      {
        options::store(options::command_line_parser(argc, argv)
                         .options(all)
                         .positional(positional)
                         .run(),
                       values);
      }
    catch (const options::error &error)
      {
        AssertThrow(false,
                    InputError(std::string("The command line cannot be "
                                           "understood: ") +
                               error.what() + "; see --help."));
      }
    std::ostringstream text;
    if (values.count("help"))
      text
        << "Usage: keyblock [options] SCENE.prm\n"
        << visible << "\nExamples:\n"
        << "  keyblock prm/tutorial/sliding_block.prm\n"
           "      run a scene; results go to output-sliding_block\n"
           "  keyblock prm/tutorial/first_tunnel.prm --validate \\\n"
           "      --set \"Joints/*/Friction angle=25\"\n"
           "      which blocks there are, with another friction angle\n"
           "  keyblock prm/tutorial/first_tunnel.prm --study --output study\n"
           "      probability of failure; `keyblock-report study` writes its "
           "report\n";
    else if (values.count("version"))
      text << "keyblock " << KEYBLOCK_VERSION << '\n';
    else if (values.count("print-parameters"))
      print_parameters(text);
    answer = text.str();
    if (!answer.empty())
      return;
    require_values(values);
    if (values.count("set"))
      overrides = values["set"].as<std::vector<std::string>>();
    if (values.count("output"))
      output = values["output"].as<std::string>();
    if (values.count("restart"))
      restart = values["restart"].as<std::string>();
    if (values.count("factors"))
      factors = values["factors"].as<std::string>();
    is_validation = values.count("validate") > 0;
    is_study      = values.count("study") > 0;
    AssertThrow(!is_study || (!is_validation && restart.empty()),
                InputError("The command line has --study together with "
                           "--validate or --restart; name one of them (a study "
                           "that was stopped goes on by itself)."));
    AssertThrow(!is_validation || restart.empty(),
                InputError("The command line has --validate together with "
                           "--restart; name one of them (what is validated is "
                           "the scene before its first step)."));
    AssertThrow(values.count("factors") == 0 ||
                  (!is_validation && !is_study && restart.empty()),
                InputError("The command line has --factors together with "
                           "--validate, --study or --restart; name one of "
                           "them."));
    const auto scenes = values.count("scene")
                          ? values["scene"].as<std::vector<std::string>>()
                          : std::vector<std::string>();
    AssertThrow(scenes.size() == 1,
                InputError("The command line names " +
                           std::to_string(scenes.size()) +
                           " scene files; name exactly one, as in `keyblock "
                           "prm/tutorial/sliding_block.prm`."));
    scene = scenes[0];
  }
} // namespace Keyblock
