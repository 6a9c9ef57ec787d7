// SPDX-License-Identifier: LGPL-2.1-or-later
// What is written wrongly in the text of a scene.
#include <deal.II/base/parameter_handler.h>

#include <keyblock/base/errors.h>
#include <keyblock/base/number_text.h>
#include <keyblock/base/text_parts.h>
#include <keyblock/scene/complaints.h>
#include <keyblock/scene/decimal_commas.h>
#include <keyblock/scene/entries.h>
#include <keyblock/scene/text.h>

#include <boost/algorithm/string.hpp>

#include <algorithm>
#include <cctype>
#include <numeric>
#include <set>
#include <sstream>

namespace Keyblock
{
  namespace
  {
    /** Whether a value would be a number if its comma were a point. */
    bool
    is_number_with_comma(const std::string &value)
    {
      double number    = 0.;
      const auto comma = value.find(',');
      return comma != std::string::npos && comma > 0 &&
             comma + 1 < value.size() && read_number(value, true, number);
    }
  } // namespace



  std::vector<std::string>
  warnings_of_decimal_commas(const std::string &text)
  {
    // (others want as many numbers as the scene has dimensions, or one)
    static const std::set<std::string> names = {"K0",
                                                "Lateral ratios",
                                                "Spacing"};
    std::vector<std::string> warnings;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
      if (line.find(',') != std::string::npos)
        for (const auto &[entry, value] : list_entries(significant_part(line)))
          if (names.count(entry) > 0 && is_number_with_comma(value))
            warnings.push_back(
              "The entry '" + entry + "' is '" + excerpt(value) +
              "', which are two numbers; write " +
              excerpt(boost::replace_all_copy(value, ",", ".")) +
              " if it is one, or '" +
              excerpt(boost::replace_all_copy(value, ",", ", ")) + "'.");
    return warnings;
  }


  namespace
  {
    /** A line of a scene that opens or closes a subsection. */
    struct OpenSection
    {
      std::string name;
      unsigned int line, indent;
    };

    /** Calls an action with number, indent and significant part of each line
     * that does not go on with the one before. */
    template <typename Action>
    void
    for_each_statement(const std::string &text, const Action &action)
    {
      std::istringstream lines(text);
      unsigned int number = 0;
      bool is_continued   = false;
      for (std::string line; std::getline(lines, line);)
        {
          ++number;
          if (!is_continued)
            action(number,
                   std::min(line.find_first_not_of(" \t"), line.size()),
                   significant_part(line));
          is_continued = boost::ends_with(line, "\\");
        }
    }
  } // namespace



  void
  require_ends(const std::string &text, const std::string &file_name)
  {
    const std::string where = "In '" + file_name + "', line ";
    std::vector<OpenSection> open;
    OpenSection suspect{"", 0, 0};
    bool is_indented = false;
    for_each_statement(
      text,
      [&](const unsigned int line,
          const unsigned int indent,
          const std::string &words) {
        is_indented      = is_indented || (indent > 0 && !words.empty());
        const bool opens = boost::istarts_with(words, "subsection "),
                   ends  = boost::iequals(words, "end");
        // what stands farther left than it should tells where an end is missing
        if (suspect.line == 0 && !open.empty() &&
            ((opens && indent <= open.back().indent) ||
             (ends && indent < open.back().indent)))
          suspect = open.back();
        if (opens)
          open.push_back({words.substr(11), line, indent});
        AssertThrow(!ends || !open.empty(),
                    InputError(where + std::to_string(line) +
                               ": this 'end' closes no subsection; take it "
                               "out, or add the 'subsection' that it ends."));
        if (ends)
          open.pop_back();
      });
    if (open.empty())
      return;
    const OpenSection &lacking =
      is_indented && suspect.line > 0 ? suspect : open.back();
    throw InputError(where + std::to_string(lacking.line) +
                     ": the subsection '" + lacking.name +
                     "' has no 'end'; add one after its last entry.");
  }



  namespace
  {
    /** Sections in which a line of the text stands, as `Materials/rock/`. */
    std::string
    path_of_line(const std::string &text, const unsigned int number)
    {
      std::vector<std::string> sections;
      for_each_statement(text,
                         [&](const unsigned int line,
                             const unsigned int,
                             const std::string &words) {
                           if (line >= number)
                             return;
                           if (boost::istarts_with(words, "subsection "))
                             sections.push_back(words.substr(11));
                           else if (boost::iequals(words, "end") &&
                                    !sections.empty())
                             sections.pop_back();
                         });
      std::string path;
      for (const std::string &section : sections)
        path += section + '/';
      return path;
    }

    /** Letters to be put in, left out or changed from one word to another. */
    unsigned int
    distance_of(const std::string &a, const std::string &b)
    {
      std::vector<unsigned int> row(b.size() + 1);
      std::iota(row.begin(), row.end(), 0u);
      for (unsigned int i = 1; i <= a.size(); ++i)
        {
          unsigned int diagonal = row[0];
          row[0]                = i;
          for (unsigned int j = 1; j <= b.size(); ++j)
            {
              const unsigned int changed =
                diagonal + (std::tolower(a[i - 1]) != std::tolower(b[j - 1]));
              diagonal = row[j];
              row[j]   = std::min(changed, 1 + std::min(row[j], row[j - 1]));
            }
        }
      return row.back();
    }

    /** The name that is meant, for the end of a sentence. */
    std::string
    remedy_of_name(const std::string &wrong, const std::set<std::string> &names)
    {
      std::string nearest;
      unsigned int least = 1 + wrong.size() / 3;
      for (const std::string &name : names)
        if (const unsigned int distance = distance_of(wrong, name);
            distance < least + nearest.empty())
          {
            least   = distance;
            nearest = name;
          }
      return nearest.empty() ? "correct its name, or take it out."
                             : "is '" + nearest + "' meant?";
    }

    /** What is declared in the sections of a @p path: their sections, or their
     * entries. */
    std::set<std::string>
    names_in_section(const dealii::ParameterHandler &prm,
                     const std::string &path,
                     const bool of_sections)
    {
      std::ostringstream text;
      prm.print_parameters(text, dealii::ParameterHandler::ShortPRM);
      std::set<std::string> names;
      for (const auto &[entry, value] : list_entries(text.str()))
        if (entry.compare(0, path.size(), path) == 0)
          {
            const std::string rest = entry.substr(path.size());
            const auto slash       = rest.find('/');
            if ((slash != std::string::npos) == of_sections)
              names.insert(rest.substr(0, slash));
          }
      return names;
    }

    /** What a pattern of deal.II asks for, in words. */
    std::string
    words_of_pattern(const std::string &pattern)
    {
      const bool is_double = boost::starts_with(pattern, "[Double ");
      if (is_double || boost::starts_with(pattern, "[Integer "))
        if (const auto parts =
              parts_between(boost::replace_first_copy(pattern, " range ", " "),
                            {is_double ? "[Double " : "[Integer ", "...", " "});
            !parts.empty())
          {
            const std::string kind = is_double ? "a number" : "a whole number",
                              low = parts[0], high = parts[1];
            const bool has_low  = low.find("MAX") == std::string::npos,
                       has_high = high.find("MAX") == std::string::npos &&
                                  high.size() < 10;
            // the least number that deal.II is told of stands for 0
            return kind +
                   (low == "1e-300" ? " above 0"
                    : has_low       ? " from " + low
                                    : "") +
                   (has_high                     ? " to " + high
                    : has_low && low != "1e-300" ? " on"
                                                 : "");
          }
      if (const auto parts = parts_between(pattern, {"[Selection ", " ]"});
          !parts.empty())
        return "one of " + boost::replace_all_copy(parts[0], "|", ", ");
      if (pattern == "[Bool]")
        return "true or false";
      return pattern;
    }

    /** The first item of a list of numbers that is none, for the end of a
     * sentence; empty if all are. */
    std::string
    wrong_item(const std::string &value, const std::string &pattern)
    {
      if (!boost::starts_with(pattern, "[List of ") ||
          (pattern.find("[Double ") == std::string::npos &&
           pattern.find("[Integer ") == std::string::npos))
        return "";
      std::vector<std::string> items;
      boost::split(items, value, boost::is_any_of(",;"));
      double number = 0.;
      for (unsigned int i = 0; i < items.size(); ++i)
        if (const std::string item = boost::trim_copy(items[i]);
            !read_number(item, false, number))
          return "number " + std::to_string(i + 1) + " of it is '" +
                 excerpt(item) + "'; ";
      return "";
    }

    /** What is wrong with a value. */
    std::string
    complain_of_value(const std::string &entry,
                      const std::string &value,
                      const std::string &pattern)
    {
      std::string remedy = "correct it.";
      if (is_number_with_comma(value))
        remedy = "numbers have a point: write " +
                 excerpt(boost::replace_all_copy(value, ",", ".")) + ".";
      return "the entry '" + excerpt(entry) + "' is '" + excerpt(value) +
             "', which is not " + words_of_pattern(pattern) + "; " +
             wrong_item(value, pattern) + remedy;
    }
  } // namespace



  std::string
  explain_complaint(const dealii::ParameterHandler &prm,
                    const std::string &complaint,
                    const std::string &text,
                    const std::string &source,
                    const bool has_lines)
  {
    std::vector<std::string> part;
    const auto is_like = [&](std::vector<std::string> words) {
      words.insert(words.begin(), {"Line <", "> of file <"});
      part = parts_between(complaint, words);
      return !part.empty();
    };
    std::string sentence;
    const auto path = [&]() { return path_of_line(text, std::stoul(part[0])); };
    // as deal.II 9.4 says it, and 9.6
    if (is_like({"No entry with name <", "> was declared "}))
      sentence = "there is no entry '" + path() + excerpt(part[2]) + "'; " +
                 remedy_of_name(part[2], names_in_section(prm, path(), false));
    else if (is_like({"no such subsection to be entered: "}) ||
             is_like({"to enter a subsection '", "', but"}))
      {
        const std::string names =
                            boost::trim_right_copy_if(part[2],
                                                      boost::is_any_of(".")),
                          name = names.substr(names.rfind('.') + 1);
        sentence = "there is no section '" + path() + excerpt(name) + "'; " +
                   remedy_of_name(name, names_in_section(prm, path(), true));
      }
    else if (is_like({"The entry value",
                      " for the entry named ",
                      " does not match the given pattern: "}))
      sentence = complain_of_value(path() + part[3],
                                   boost::trim_copy(part[2]),
                                   part[4].substr(0, part[4].rfind('.')));
    else if (is_like({"The line <", "> could not be parsed: "}))
      sentence = "'" + excerpt(part[2]) +
                 "' begins with none of set, subsection, end and include; "
                 "correct its first word.";
    else
      return "In " + excerpt(source) + ": " + complaint;
    std::string place = excerpt(source);
    if (has_lines)
      {
        const std::string from = ", from line ";
        const auto passage     = parts_between(source, {from, " on"});
        place = source.substr(0, source.find(from)) + ", line " + part[0] +
                (passage.empty() ? "" : passage[1]);
      }
    return "In " + place + ": " + sentence;
  }
} // namespace Keyblock
