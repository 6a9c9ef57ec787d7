// SPDX-License-Identifier: LGPL-2.1-or-later
// The entries that a scene has, as a scene again and as what results depend on.
#include <deal.II/base/parameter_handler.h>

#include <keyblock/base/digest.h>
#include <keyblock/base/errors.h>
#include <keyblock/base/find_file.h>
#include <keyblock/scene/entries.h>
#include <keyblock/scene/joints.h>
#include <keyblock/scene/scene.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

namespace Keyblock
{
  namespace
  {
    /** Digest of the bytes of @p name, found from the folder of @p scene. */
    std::string
    digest_of_file(const std::string &scene, const std::string &name)
    {
      std::ifstream in(std::filesystem::path(scene).parent_path() / name,
                       std::ios::binary);
      std::ostringstream text;
      text << in.rdbuf();
      return digest_of(text.str());
    }

    /** The path of a file that @p scene names, from the folder of @p used; the
     * name itself if there is no such file. */
    std::string
    path_from(const std::string &scene,
              const std::string &used,
              const std::string &name)
    {
      namespace fs            = std::filesystem;
      const std::string found = find_file(scene, name);
      if (found.empty() || fs::path(name).is_absolute())
        return name;
      std::error_code error;
      const fs::path folder = fs::absolute(used, error).parent_path(),
                     path   = fs::proximate(found, folder, error);
      return error || path.empty() ? name : path.string();
    }

    /** @p entries of @p scene, as they are written to the file @p used, with
     * the files that they name as they are found from its folder. */
    std::string
    with_files_from(const std::string &scene,
                    const std::string &used,
                    const std::string &entries)
    {
      const std::set<std::string> names = {"File",
                                           "History file",
                                           "Measured points"};
      std::istringstream lines(entries);
      std::string text;
      for (std::string line; std::getline(lines, line);)
        {
          for (const auto &[entry, value] : list_entries(line))
            if (names.count(entry) > 0 && !value.empty())
              line.replace(line.find(value, line.find('=')),
                           value.size(),
                           path_from(scene, used, value));
          text += line + '\n';
        }
      return text;
    }
  } // namespace



  template <int dim>
  std::string
  Scene<dim>::print_entries(const bool has_descriptions) const
  {
    std::ostringstream out;
    prm->print_parameters(out,
                          (has_descriptions ? ParameterHandler::Text
                                            : ParameterHandler::ShortPRM) |
                            ParameterHandler::KeepDeclarationOrder);
    std::string text         = out.str();
    const std::string header = "subsection Joints\n";
    const auto section       = text.compare(0, header.size(), header) == 0
                                 ? 0
                                 : text.find("\n" + header);
    text.insert(text.find("\nend", section) + 1, print_joints(joints));
    return text;
  }



  template <int dim>
  void
  Scene<dim>::write_used(const std::string &file_name) const
  {
    std::ofstream out(file_name);
    out << with_files_from(file, file_name, print_entries(true));
    AssertThrow(out.flush(),
                InputError("The file '" + file_name +
                           "' cannot be written; check free space and "
                           "permissions."));
  }



  template <int dim>
  std::string
  Scene<dim>::used_entries() const
  {
    std::string text = print_entries(false);
    for (const auto &excavation : excavations)
      if (!excavation->file_digest.empty())
        text += "subsection Excavations\n  subsection " + excavation->name +
                "\n    set Digest of File = " + excavation->file_digest +
                "\n  end\nend\n";
    for (const auto &support : supports)
      if (!support->history_file.empty())
        text += "subsection Supports\n  subsection " + support->name +
                "\n    set Digest of History file = " +
                digest_of_file(file, support->history_file) + "\n  end\nend\n";
    if (!initial_state.measured_points.empty())
      text += "subsection Initial state\n  set Digest of Measured points = " +
              digest_of_file(file, initial_state.measured_points) + "\nend\n";
    return text;
  }

#define INSTANTIATE(dim)                                                       \
  template std::string Scene<dim>::print_entries(const bool) const;            \
  template void Scene<dim>::write_used(const std::string &) const;             \
  template std::string Scene<dim>::used_entries() const;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock
