// SPDX-License-Identifier: LGPL-2.1-or-later
// What earlier runs have left in their output folders.
#include <keyblock/base/delimited_text.h>
#include <keyblock/base/find_file.h>
#include <keyblock/run/checkpointing.h>
#include <keyblock/run/earlier_results.h>
#include <keyblock/run/kept_states.h>
#include <keyblock/scene/entries.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

namespace Keyblock
{
  namespace
  {
    /** Files of states that @p source means (collective). */
    std::vector<std::string>
    list_files(const Communicator &communicator,
               const std::string &source,
               const unsigned int n_stages)
    {
      std::string list;
      communicator.on_root([&]() {
        std::error_code error;
        AssertThrow(std::filesystem::exists(source, error),
                    InputError("The folder or file '" + source +
                               "' of --factors does not exist; name the "
                               "output folder of a run, or the file of a "
                               "state."));
        if (!std::filesystem::is_directory(source, error))
          {
            list = source + '\n';
            return;
          }
        for (unsigned int n = 1; n <= n_stages; ++n)
          {
            const std::string name =
              (std::filesystem::path(source) / name_of_kept_stage(n)).string();
            if (std::filesystem::exists(name, error))
              list += name + '\n';
          }
        AssertThrow(!list.empty(),
                    InputError("The folder '" + source +
                               "' of --factors has no state of a stage of "
                               "this scene (stage_1.h5, ...); run it with "
                               "--set \"Output/Keep stages=true\", or name a "
                               "checkpoint file of a finished stage."));
      });
      std::istringstream lines(communicator.text_of_root(list));
      std::vector<std::string> files;
      for (std::string line; std::getline(lines, line);)
        files.push_back(line);
      return files;
    }

    /** The state in a @p file. Throws InputError if it cannot answer. */
    template <int dim>
    KeptState
    look_at(const Communicator &communicator,
            const std::string &file_name,
            const Scene<dim> &scene)
    {
      StateFile file(communicator, file_name);
      check_origin(file, file_name, scene, StateUse::factors);
      KeptState state;
      state.file       = file_name;
      bool is_reported = false, has_before = false;
      std::vector<unsigned int> removal_stage;
      file.exchange("run/stage", state.stage);
      file.exchange("run/is_reported", is_reported);
      file.exchange("run/has_before", has_before);
      file.exchange("run/removal_stage", removal_stage);
      const std::string &name = scene.stages[state.stage]->name;
      state.is_wanted         = scene.safety.wants_stage(name);
      AssertThrow(is_reported,
                  InputError("The checkpoint '" + file_name +
                             "' is of the middle of the stage '" + name +
                             "', at whose end factors are looked for; go on "
                             "from it by --restart first."));
      AssertThrow(has_before || !state.is_wanted ||
                    std::find(removal_stage.begin(),
                              removal_stage.end(),
                              state.stage + 2) == removal_stage.end(),
                  InputError("The checkpoint '" + file_name +
                             "' lacks the beginning of the stage '" + name +
                             "', from which the factors of blocks that failed "
                             "in it are found; run the scene with 'Output/Keep "
                             "stages', or leave that stage out of 'Safety "
                             "factor/Stages'."));
      return state;
    }
  } // namespace



  template <int dim>
  std::vector<KeptState>
  list_kept_states(const Communicator &communicator,
                   const std::string &source,
                   const Scene<dim> &scene)
  {
    AssertThrow(scene.safety.is_wanted() &&
                  scene.contact.method != ContactMethod::none,
                InputError("The command line has --factors, but the scene "
                           "asks for no factor; set 'Safety factor/Blocks' to "
                           "all, exposed, critical or numbers of blocks, and "
                           "leave 'Contact/Method' at one that computes "
                           "joints."));
    std::vector<KeptState> states;
    for (const std::string &file :
         list_files(communicator, source, scene.stages.size()))
      states.push_back(look_at(communicator, file, scene));
    for (const std::string &name : scene.safety.stages)
      AssertThrow(std::any_of(states.begin(),
                              states.end(),
                              [&](const KeptState &state) {
                                return scene.stages[state.stage]->name == name;
                              }),
                  InputError("The entry 'Safety factor/Stages' names '" + name +
                             "', whose end is not in '" + source +
                             "' of --factors; name stages that it has, or run "
                             "the scene with 'Output/Keep stages'."));
    std::vector<KeptState> used;
    for (const KeptState &state : states)
      if (state.is_wanted || &state == &states.back())
        used.push_back(state);
    return used;
  }



  namespace
  {
    namespace fs = std::filesystem;

    /** The first line of used.prm that only Keyblock writes. */
    const std::string mark_of_used = "# Number of dimensions: 2 (plane strain";

    /** Whether a file is the used.prm of a run. */
    bool
    is_used_scene(const fs::path &file)
    {
      std::error_code error;
      if (!fs::is_regular_file(file, error)) // a device may have no end
        return false;
      std::ifstream in(file);
      std::string line;
      for (unsigned int n = 0; n < 5 && std::getline(in, line); ++n)
        if (line.compare(0, mark_of_used.size(), mark_of_used) == 0)
          return true;
      return false;
    }

    /** Files that a scene reads, by their full paths. */
    template <int dim>
    std::set<std::string>
    list_inputs(const Scene<dim> &scene)
    {
      std::set<std::string> inputs;
      std::error_code error;
      for (const auto &[entry, value] : list_entries(scene.used_entries()))
        if (const std::string name = last_of(entry); name == "File" ||
                                                     name == "History file" ||
                                                     name == "Measured points")
          if (const std::string found = find_file(scene.file, value);
              !value.empty() && !found.empty())
            inputs.insert(fs::weakly_canonical(found, error).string());
      return inputs;
    }
  } // namespace



  template <int dim>
  std::vector<fs::path>
  list_earlier_results(const std::string &folder, const Scene<dim> &scene)
  {
    static const std::regex names(
      "(joints|geostress|history|blocks|factors)\\.csv|joints\\.vtu|"
      "summary\\.json|(solution|bolts|liners)\\.pvd|"
      "(rock|interface)_[0-9]{4,}(\\.[0-9]+)?\\.vtu|"
      "(rock|interface)_[0-9]{4,}\\.pvtu|(bolts|liners)_[0-9]{4,}\\.vtu|"
      "(checkpoint|stage_[0-9]+)\\.h5(\\.part)?");
    std::vector<fs::path> files;
    if (!is_used_scene(folder + "used.prm"))
      return files;
    const std::set<std::string> inputs = list_inputs(scene);
    std::error_code error;
    for (fs::directory_iterator file(folder, error), end; file != end && !error;
         file.increment(error))
      if (file->symlink_status(error).type() == fs::file_type::regular &&
          std::regex_match(file->path().filename().string(), names) &&
          inputs.count(fs::weakly_canonical(file->path(), error).string()) == 0)
        files.push_back(file->path());
    std::sort(files.begin(), files.end());
    return files;
  }



  std::string
  remove_earlier_results(const std::vector<fs::path> &files,
                         const std::string &folder)
  {
    const fs::path saved = folder + "checkpoint.h5",
                   kept  = folder + "earlier_checkpoint.h5",
                   ended = folder + "summary.json";
    std::error_code error;
    const bool is_broken_off =
      fs::exists(saved, error) &&
      (!fs::exists(ended, error) ||
       fs::last_write_time(saved, error) > fs::last_write_time(ended, error));
    std::vector<std::string> removed;
    bool has_kept = false;
    for (const fs::path &file : files)
      if (is_broken_off && file.filename() == saved.filename())
        {
          fs::rename(file, kept, error);
          has_kept = !error;
        }
      else if (fs::remove(file, error))
        removed.push_back(file.filename().string());
    std::string text;
    if (!removed.empty())
      text = "Folder  " + count_text(removed.size(), "file") +
             " of an earlier run removed from " + folder + ": " +
             removed.front() +
             (removed.size() > 1 ? " to " + removed.back() : "") + '\n';
    if (has_kept)
      text += "Folder  the earlier run was broken off: its checkpoint is now " +
              kept.string() + '\n';
    return text;
  }

  template std::vector<fs::path> list_earlier_results(const std::string &,
                                                      const Scene<2> &);
  template std::vector<fs::path> list_earlier_results(const std::string &,
                                                      const Scene<3> &);
  template std::vector<KeptState>
  list_kept_states(const Communicator &, const std::string &, const Scene<2> &);
  template std::vector<KeptState>
  list_kept_states(const Communicator &, const std::string &, const Scene<3> &);
} // namespace Keyblock
