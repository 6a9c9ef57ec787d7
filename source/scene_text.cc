// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/parameter_handler.h>

#include <keyblock/errors.h>
#include <keyblock/scene_text.h>

#include <boost/algorithm/string.hpp>
#include <boost/algorithm/string/trim_all.hpp>

#include <filesystem>
#include <fstream>
#include <sstream>

namespace Keyblock
{
  void
  parse_entries(dealii::ParameterHandler &prm,
                const std::string &text,
                const std::string &file_name,
                const std::string &source,
                const bool skip_unknown)
  {
    try
      {
        std::istringstream in(text);
        prm.parse_input(in, file_name, "", skip_unknown);
      }
    catch (const dealii::ExceptionBase &exception)
      {
        std::ostringstream words;
        exception.print_info(words);
        const std::string sentence =
          boost::trim_all_copy(boost::replace_all_copy(words.str(), "\n", " "));
        AssertThrow(false,
                    InputError(
                      "In " + source + ": " + sentence +
                      " Entries, ranges and units are listed in "
                      "doc/parameters.md (or by --print-parameters)."));
      }
  }



  namespace
  {
    std::string
    read_file(const std::string &file_name, const std::string &what)
    {
      std::ifstream in(file_name);
      AssertThrow(in && !std::filesystem::is_directory(file_name),
                  InputError("The " + what + " '" + file_name +
                             "' cannot be read; check its path."));
      std::ostringstream text;
      text << in.rdbuf();
      return text.str();
    }

    /** A line without comment, with single blanks only, as it is parsed. */
    std::string
    significant(std::string line)
    {
      line.erase(std::min(line.find('#'), line.size()));
      boost::trim_all(line, std::locale::classic());
      return line;
    }

    /** Whether a line begins with @p word, in small or capital letters. */
    bool
    begins_with(const std::string &line, const std::string &word)
    {
      return boost::starts_with(line, word) ||
             boost::starts_with(line, boost::to_upper_copy(word));
    }

    /** Put the text of included files in the place of `include FILE`. */
    std::string
    include_files(const std::string &text, const unsigned int depth)
    {
      if (text.find("include ") == std::string::npos &&
          text.find("INCLUDE ") == std::string::npos)
        return text;
      AssertThrow(depth < 20,
                  InputError("Scene files include each other more than twenty "
                             "deep; remove the 'include' that leads back."));
      std::istringstream lines(text);
      std::string all;
      for (std::string line; std::getline(lines, line);)
        {
          const std::string words = significant(line);
          all += begins_with(words, "include ")
                   ? include_files(read_file(words.substr(8), "included file"),
                                   depth + 1)
                   : line;
          all += '\n';
        }
      return all;
    }

    /** Move the subsections of `subsection Joints` out of the text. */
    void
    set_joints_apart(SceneText &scene)
    {
      std::istringstream lines(scene.text);
      std::string rest, previous;
      std::vector<std::string> sections;
      unsigned int number = 0;
      for (std::string line; std::getline(lines, line); previous = line)
        {
          ++number;
          const std::string words = significant(line);
          const bool is_continued = boost::ends_with(previous, "\\");
          const bool opens = !is_continued && begins_with(words, "subsection ");
          const bool closes =
            !is_continued && (words == "end" || words == "END");
          const auto is_in_joint = [&]() {
            return sections.size() >= 2 && sections[0] == "Joints";
          };
          const bool was_in_joint = is_in_joint();
          if (closes && !sections.empty())
            sections.pop_back();
          if (was_in_joint && is_in_joint())
            scene.joint_subsections.back().text += line + '\n';
          if (opens)
            sections.push_back(words.substr(11));
          if (!was_in_joint && is_in_joint())
            scene.joint_subsections.push_back({sections[1],
                                               "",
                                               "'" + scene.file_name +
                                                 "', from line " +
                                                 std::to_string(number) + " on",
                                               number});
          rest += (was_in_joint || is_in_joint() ? "" : line) + '\n';
        }
      scene.text = rest;
    }

    /** "Section/Sub/Entry=value" taken apart. */
    void
    add_override(const std::string &assignment, SceneText &scene)
    {
      const auto equal = assignment.find('=');
      AssertThrow(equal != std::string::npos && equal > 0,
                  InputError("The override '" + assignment +
                             "' of --set has no '='; write "
                             "--set \"Section/Entry=value\"."));
      std::vector<std::string> parts;
      const std::string path = assignment.substr(0, equal);
      boost::split(parts, path, boost::is_any_of("/"));
      const std::string set =
        "set " + parts.back() + " = " + assignment.substr(equal + 1) + "\n";
      if (parts.size() == 3 && parts[0] == "Joints")
        {
          scene.joint_overrides.push_back(
            {parts[1], set, "--set \"" + assignment + "\"", 0});
          return;
        }
      std::string text;
      for (unsigned int i = 0; i + 1 < parts.size(); ++i)
        text += "subsection " + parts[i] + "\n";
      text += set;
      for (unsigned int i = 0; i + 1 < parts.size(); ++i)
        text += "end\n";
      scene.overrides.push_back({assignment, text});
    }
  } // namespace



  SceneText::SceneText(const std::string &file_name,
                       const std::vector<std::string> &overrides)
    : file_name(file_name)
    , text(include_files(read_file(file_name, "scene file"), 0))
  {
    set_joints_apart(*this);
    for (const std::string &assignment : overrides)
      add_override(assignment, *this);
  }



  void
  SceneText::parse(dealii::ParameterHandler &prm, const bool skip_unknown) const
  {
    parse_entries(prm, text, file_name, "'" + file_name + "'", skip_unknown);
    for (const Override &entry : overrides)
      parse_entries(prm,
                    entry.text,
                    "",
                    "--set \"" + entry.assignment + "\"",
                    skip_unknown);
  }
} // namespace Keyblock
