// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/parameter_handler.h>

#include <keyblock/base/errors.h>
#include <keyblock/base/text_parts.h>
#include <keyblock/scene/complaints.h>
#include <keyblock/scene/decimal_commas.h>
#include <keyblock/scene/dropped_names.h>
#include <keyblock/scene/entries.h>
#include <keyblock/scene/old_names.h>
#include <keyblock/scene/text.h>

#include <boost/algorithm/string.hpp>
#include <boost/algorithm/string/trim_all.hpp>
#include <boost/locale/utf.hpp>

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

namespace Keyblock
{
  namespace
  {
    /** Throw a better sentence if deal.II's @p complaint is of a subsection of
     * a name that its section does not list. */
    void
    require_listed(const std::string &complaint, const std::string &source)
    {
      // as deal.II 9.4 says it, and 9.6
      auto found = parts_between(
        complaint, {"Line <", ">", "no such subsection to be entered: ", "."});
      if (found.empty())
        found = parts_between(
          complaint, {"Line <", ">", "to enter a subsection '", ".", "', but"});
      if (found.empty() || found[2].empty())
        return;
      const std::string name = excerpt(found[3]);
      throw InputError("In " + excerpt(source) + ", line " + found[0] +
                       ": there is a subsection '" + excerpt(found[2]) + "/" +
                       name + "', but '" + excerpt(found[2]) +
                       "/Names' does not list '" + name +
                       "'; add the name there, or take the subsection out.");
    }
  } // namespace



  std::string
  significant_part(std::string line)
  {
    line.erase(std::min(line.find('#'), line.size()));
    boost::trim_all(line, std::locale::classic());
    return line;
  }



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
        std::string sentence =
          boost::trim_all_copy(boost::replace_all_copy(words.str(), "\n", " "));
        require_listed(sentence, source);
        if (!boost::ends_with(sentence, "."))
          sentence += '.';
        throw InputError(
          explain_complaint(prm, sentence, text, source, !file_name.empty()) +
          " Entries, ranges and units are listed in doc/parameters.md (or by "
          "--print-parameters).");
      }
  }



  namespace
  {
    constexpr std::size_t largest_text = std::size_t(1) << 26; // [bytes]

    /** Texts by the name that stands for them: of pipes, which can be read only
     * once, and by one process only, and of scenes that are in no file. */
    std::map<std::string, std::string> &
    kept_texts()
    {
      static std::map<std::string, std::string> texts;
      return texts;
    }

    /** The bytes of a file. */
    std::string
    read_bytes(const Communicator &communicator,
               const std::string &file_name,
               const std::string &what)
    {
      const auto kept = kept_texts().find(file_name);
      if (kept != kept_texts().end())
        return kept->second;
      std::string text;
      std::vector<unsigned int> is_pipe(1, 0);
      communicator.on_root([&]() {
        std::error_code error;
        std::ifstream in(file_name, std::ios::binary);
        AssertThrow(in && !std::filesystem::is_directory(file_name, error),
                    InputError("The " + what + " '" + file_name +
                               "' cannot be read; check its path."));
        is_pipe[0] = !std::filesystem::is_regular_file(file_name, error);
        // a device may have no end
        std::vector<char> piece(1u << 16);
        while (in.read(piece.data(), piece.size()) || in.gcount() > 0)
          {
            text.append(piece.data(), in.gcount());
            AssertThrow(text.size() <= largest_text,
                        InputError("The " + what + " '" + file_name +
                                   "' has more than 64 MB; name a scene "
                                   "file."));
          }
      });
      text = communicator.text_of_root(text);
      communicator.broadcast(is_pipe);
      if (is_pipe[0])
        kept_texts()[file_name] = text;
      return text;
    }

    bool
    is_utf_8(const std::string &text)
    {
      using Decoder = boost::locale::utf::utf_traits<char>;
      for (auto next = text.begin(); next != text.end();)
        if (!boost::locale::utf::is_valid_codepoint(
              Decoder::decode(next, text.end())))
          return false;
      return true;
    }

    /** Throw InputError if a line of the @p text is not UTF-8 before its
     * comment. */
    void
    require_utf_8(const std::string &text,
                  const std::string &file_name,
                  const std::string &what)
    {
      std::istringstream in(text);
      std::string line;
      for (unsigned int number = 1; std::getline(in, line); ++number)
        AssertThrow(is_utf_8(line.substr(0, line.find('#'))),
                    InputError("Line " + std::to_string(number) + " of the " +
                               what + " '" + file_name +
                               "' contains a byte that is not UTF-8; save the "
                               "file as UTF-8."));
    }

    /** The text of a file without byte order mark, with '\n' at the end of
     * each line. */
    std::string
    read_file(const Communicator &communicator,
              const std::string &file_name,
              const std::string &what)
    {
      const std::string raw = read_bytes(communicator, file_name, what);
      AssertThrow(raw.find('\0') == std::string::npos &&
                    !boost::starts_with(raw, "\xFF\xFE") &&
                    !boost::starts_with(raw, "\xFE\xFF"),
                  InputError("The " + what + " '" + file_name +
                             "' is no plain text (it contains a byte 0, as "
                             "UTF-16 does); save it as UTF-8."));
      std::string text =
        raw.substr(boost::starts_with(raw, "\xEF\xBB\xBF") ? 3 : 0);
      boost::replace_all(text, "\r\n", "\n");
      boost::replace_all(text, "\r", "\n");
      require_utf_8(text, file_name, what);
      return text;
    }

    /** Whether a line begins with @p word, in small or capital letters. */
    bool
    begins_with(const std::string &line, const std::string &word)
    {
      return boost::starts_with(line, word) ||
             boost::starts_with(line, boost::to_upper_copy(word));
    }

    std::string include_file(const Communicator &communicator,
                             const std::string &file_name,
                             std::vector<std::string> chain);

    /** Put the text of included files in the place of `include FILE`;
     * @p chain: the files that led here. */
    std::string
    include_files(const Communicator &communicator,
                  const std::string &text,
                  const std::vector<std::string> &chain)
    {
      if (text.find("include ") == std::string::npos &&
          text.find("INCLUDE ") == std::string::npos)
        return text;
      std::istringstream lines(text);
      std::string all;
      for (std::string line; std::getline(lines, line);)
        {
          const std::string words = significant_part(line);
          all += begins_with(words, "include ")
                   ? include_file(communicator, words.substr(8), chain)
                   : line;
          all += '\n';
          AssertThrow(all.size() <= largest_text,
                      InputError("The scene file '" + chain.front() +
                                 "' has more than 64 MB with all files that "
                                 "it includes; include each of them once."));
        }
      return all;
    }

    /** A file that @p by includes: beside it, else where the program runs. */
    std::string
    find_included(const std::string &file_name, const std::string &by)
    {
      std::error_code error;
      const std::filesystem::path beside =
        std::filesystem::path(by).parent_path() / file_name;
      return std::filesystem::exists(beside, error) ? beside.string()
                                                    : file_name;
    }

    std::string
    include_file(const Communicator &communicator,
                 const std::string &name,
                 std::vector<std::string> chain)
    {
      const std::string file_name = find_included(name, chain.back());
      std::error_code error;
      for (const std::string &before : chain)
        AssertThrow(before != file_name &&
                      !std::filesystem::equivalent(before, file_name, error),
                    InputError("The file '" + chain.back() + "' includes '" +
                               file_name +
                               "', which includes itself in this way; remove "
                               "that 'include'."));
      chain.push_back(file_name);
      return include_files(communicator,
                           read_file(communicator, file_name, "included file"),
                           chain);
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
          const std::string words = significant_part(line);
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
                  InputError("The override '" + excerpt(assignment) +
                             "' of --set has no '='; write "
                             "--set \"Section/Entry=value\"."));
      std::vector<std::string> parts;
      const std::string path = assignment.substr(0, equal);
      boost::split(parts, path, boost::is_any_of("/"));
      if (parts.size() == 3 && parts[0] == "Joints")
        {
          scene.joint_overrides.push_back({parts[1],
                                           "set " + parts.back() + " = " +
                                             assignment.substr(equal + 1) +
                                             "\n",
                                           "--set \"" + assignment + "\"",
                                           0});
          return;
        }
      scene.overrides.push_back(
        {assignment,
         lines_setting(path, assignment.substr(equal + 1), &scene.warnings)});
    }
  } // namespace



  SceneInMemory::SceneInMemory(const std::string &text)
  {
    static unsigned int n_made = 0;
    scene_name                 = "text " + std::to_string(++n_made);
    kept_texts()[scene_name]   = text;
  }



  SceneInMemory::~SceneInMemory()
  {
    kept_texts().erase(scene_name);
  }



  SceneText::SceneText(const Communicator &communicator,
                       const std::string &file_name,
                       const std::vector<std::string> &overrides)
    : file_name(file_name)
    , text(include_files(communicator,
                         read_file(communicator, file_name, "scene file"),
                         {file_name}))
  {
    require_ends(text, file_name);
    warnings = replace_old_names(text);
    set_joints_apart(*this);
    for (const std::string &assignment : without_patterns(text, overrides))
      add_override(assignment, *this);
    std::string all = text;
    for (const Override &entry : this->overrides)
      all += "\n" + entry.text;
    for (const std::string &warning : warnings_of_decimal_commas(all))
      warnings.push_back(warning);
    drop_names_taken_out(*this);
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



  bool
  SceneText::gives(const std::string &section, const std::string &entry) const
  {
    dealii::ParameterHandler probe;
    probe.enter_subsection(section);
    probe.declare_entry(entry, "", dealii::Patterns::Anything(), "", true);
    probe.leave_subsection();
    parse(probe, true);
    return probe.get_entries_wrongly_not_set().empty();
  }
} // namespace Keyblock
