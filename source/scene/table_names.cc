// SPDX-License-Identifier: LGPL-2.1-or-later
// Names of joints and of columns in their tables: which are refused, or left
// out.
#include <keyblock/base/errors.h>
#include <keyblock/base/number_text.h>
#include <keyblock/base/text_parts.h>
#include <keyblock/scene/joint_columns.h>
#include <keyblock/scene/joint_table.h>
#include <keyblock/scene/joints.h>
#include <keyblock/scene/text.h>

#include <boost/algorithm/string/predicate.hpp>
#include <boost/algorithm/string/trim_all.hpp>

#include <algorithm>
#include <filesystem>
#include <sstream>

namespace Keyblock
{
  void
  check_name(const std::string &name, const std::string &owner)
  {
    const auto bad = name.find_first_of(",;/#*?[]={}|\\\"\n\t");
    AssertThrow(!name.empty() && bad == std::string::npos &&
                  name == boost::trim_all_copy(name),
                InputError(owner + " is called '" + excerpt(name) +
                           "', but names must not be empty and have no double "
                           "blanks and none of , ; / # * ? [ ] = { } | \\ \"; "
                           "give it another name."));
  }



  namespace
  {
    /** Whether lines of a scene set an entry. */
    bool
    sets_entry(const std::string &text, const std::string &entry)
    {
      std::istringstream lines(text);
      for (std::string line; std::getline(lines, line);)
        {
          const std::string words = significant_part(line);
          if (boost::trim_copy(words.substr(0, words.find('='))) ==
                "set " + entry &&
              words.find('=') != std::string::npos)
            return true;
        }
      return false;
    }

    /** Whether the scene gives this joint its friction by an entry: of its own,
     * of its set, or of a study. */
    template <int dim>
    bool
    is_friction_given(const Scene<dim> &scene,
                      const SceneText &text,
                      const Joint<dim> &joint)
    {
      const std::string entry = "Friction angle";
      const auto gives        = [&](const JointPassage &passage) {
        return (matches_name(passage.joint, joint.name) ||
                matches_name(passage.joint, joint.set)) &&
               sets_entry(passage.text, entry);
      };
      return std::any_of(text.joint_subsections.begin(),
                         text.joint_subsections.end(),
                         gives) ||
             std::any_of(text.joint_overrides.begin(),
                         text.joint_overrides.end(),
                         gives) ||
             std::any_of(scene.joint_sets.begin(),
                         scene.joint_sets.end(),
                         [&](const auto &set) {
                           return set->name == joint.set;
                         }) ||
             std::any_of(scene.study_variables.begin(),
                         scene.study_variables.end(),
                         [&](const auto &variable) {
                           const std::string &of = variable->entry;
                           const auto first      = of.find('/');
                           return of.compare(0, first, "Joints") == 0 &&
                                  boost::ends_with(of, "/" + entry) &&
                                  matches_name(of.substr(first + 1,
                                                         of.size() -
                                                           entry.size() -
                                                           first - 2),
                                               joint.name);
                         });
    }

    /** What is to be said of joints of the table that have no friction; empty:
     * nothing. */
    template <int dim>
    std::string
    warning_of_friction(const Scene<dim> &scene,
                        const SceneText &text,
                        const DelimitedText &table)
    {
      constexpr unsigned int most = 5;
      const auto columns          = find_joint_columns(table, dim);
      const auto column           = columns.find(JointColumn::friction_angle);
      std::string lines;
      unsigned int n = 0;
      // joints of the table stand in its order
      auto row = table.rows.begin();
      for (const auto &joint : scene.joints)
        if (joint->table_line > 0)
          {
            while (row != table.rows.end() && row->line < joint->table_line)
              ++row;
            if (row == table.rows.end())
              break;
            const bool has_none = column == columns.end() ||
                                  row->fields[column->second.index].empty();
            // the only law without it has its friction otherwise
            if (!has_none || joint->law == "barton-bandis" ||
                is_friction_given(scene, text, *joint))
              continue;
            if (n++ < most)
              lines += (n == 1 ? "" : ", ") + std::to_string(row->line);
          }
      if (n == 0)
        return "";
      const std::string angle =
        text_of(JointStrength().friction_angle) + " degrees, is taken";
      const std::string where = "The table '" + scene.network.file +
                                "' of the entry 'Joints/File' has no ";
      return where +
             (column == columns.end()
                ? "column of friction: the default, " + angle +
                    "; add a column 'friction angle', or give 'Joints/NAME/"
                : "friction in " + count_text(n, "row") + " (line " + lines +
                    (n > most ? ", ..." : "") + "): the default, " + angle +
                    " there; fill in the cells, or give 'Joints/NAME/") +
             "Friction angle'.";
    }
  } // namespace



  template <int dim>
  std::vector<std::string>
  warnings_of_table(const Scene<dim> &scene, const SceneText &text)
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
                  [](const auto &joint) { return joint->table_line > 0; });
    if (!has_row)
      warnings.push_back(
        "The table '" + scene.network.file +
        "' of the entry 'Joints/File' has a header and no rows, so that it "
        "gives no joint; give each joint a row, or leave the entry out.");
    const std::string friction = warning_of_friction(scene, text, table);
    if (!friction.empty())
      warnings.push_back(friction);
    return warnings;
  }

  template std::vector<std::string> warnings_of_table(const Scene<2> &,
                                                      const SceneText &);
  template std::vector<std::string> warnings_of_table(const Scene<3> &,
                                                      const SceneText &);
} // namespace Keyblock
