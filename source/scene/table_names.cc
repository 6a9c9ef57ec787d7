// SPDX-License-Identifier: LGPL-2.1-or-later
// Names of joints and of columns in their tables: which are refused, or left
// out.
#include <keyblock/base/errors.h>
#include <keyblock/scene/joint_columns.h>
#include <keyblock/scene/joint_table.h>

#include <boost/algorithm/string/trim_all.hpp>

#include <algorithm>
#include <filesystem>

namespace Keyblock
{
  void
  check_name(const std::string &name, const std::string &owner)
  {
    const auto bad = name.find_first_of(",;/#*?[]={}|\\\"\n\t");
    AssertThrow(!name.empty() && bad == std::string::npos &&
                  name == boost::trim_all_copy(name),
                InputError(owner + " is called '" + name +
                           "', but names must not be empty and have no double "
                           "blanks and none of , ; / # * ? [ ] = { } | \\ \"; "
                           "give it another name."));
  }



  template <int dim>
  std::vector<std::string>
  warnings_of_table(const Scene<dim> &scene)
  {
    if (scene.network.is_resolved || scene.network.file.empty())
      return {};
    std::vector<std::string> warnings;
    const std::filesystem::path path =
      std::filesystem::path(scene.file).parent_path() / scene.network.file;
    const DelimitedText table =
      read_delimited_text(path.lexically_normal().string(), "Joints/File");
    std::string titles;
    for (const std::string &title : columns_left_out(table))
      titles += (titles.empty() ? "" : ", ") + title;
    if (!titles.empty())
      warnings.push_back("The table '" + scene.network.file +
                         "' of the entry 'Joints/File' has columns that are "
                         "not known and left out: " +
                         titles +
                         "; call them by what the entry says if they are "
                         "meant for the joints.");
    const bool has_row =
      std::any_of(scene.joints.begin(),
                  scene.joints.end(),
                  [](const auto &joint) {
                    return joint->origin.rfind("Line ", 0) == 0;
                  });
    if (!has_row)
      warnings.push_back(
        "The table '" + scene.network.file +
        "' of the entry 'Joints/File' has a header and no rows, so that it "
        "gives no joint; give each joint a row, or leave the entry out.");
    return warnings;
  }

  template std::vector<std::string> warnings_of_table(const Scene<2> &);
  template std::vector<std::string> warnings_of_table(const Scene<3> &);
} // namespace Keyblock
