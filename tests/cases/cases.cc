// SPDX-License-Identifier: LGPL-2.1-or-later
// Calls of the program from tables, all in one process: starting the program
// takes longer than most of them.
//
// usage: cases TABLE PRM_FOLDER OUTPUT [NAME...]
//
// A case of a table begins with a line
//   name | scene | arguments separated by ;; | message
// With a message it passes if the exit code is 1 and standard error is a single
// line with the message in it. Without one the scene must be valid; the
// argument `run` runs it. Where the scene is the name of an earlier case, the
// case begins with the entries of that one. Indented lines follow:
//   Section/Entry=value   is set
//   says: text            must be printed on one line; ... stands for any text
//   not: text             must not be printed
//   row: block | stage | factor | tolerance | mode | words
// Rows are all those of the table of limit equilibrium that --validate prints.
// The factor is correct within the tolerance, relative to it; - stands for a
// stable block. The words, separated by semicolons, stand in the row; after a !
// they do not. Only runs may write files.
#include <deal.II/base/mpi.h>

#include <keyblock/run/program.h>

#include <boost/algorithm/string.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <regex>
#include <sstream>

namespace
{
  using Strings = std::vector<std::string>;

  struct Case
  {
    std::string name, scene, message;
    Strings arguments, texts, unwanted, rows;
    bool is_run = false;
  };

  /** What the program answers to a case. */
  struct Answer
  {
    int code;
    std::string out, error;
    bool has_written;
  };



  /** Trimmed parts between separators, at most @p most: the last has the rest.
   */
  Strings
  split(const std::string &text,
        const std::string &separator,
        const std::size_t most = std::numeric_limits<std::size_t>::max())
  {
    Strings parts;
    for (std::size_t begin = 0; begin <= text.size();)
      {
        const std::size_t found = parts.size() + 1 < most
                                    ? text.find(separator, begin)
                                    : std::string::npos,
                          end   = std::min(found, text.size());
        parts.push_back(boost::trim_copy(text.substr(begin, end - begin)));
        begin = end == text.size() ? end + 1 : end + separator.size();
      }
    return parts;
  }



  /** Begins a case; @p earlier are those before it. */
  Case
  make_case(const std::string &line, const std::vector<Case> &earlier)
  {
    const Strings parts = split(line, "|", 4);
    AssertThrow(parts.size() > 1, dealii::ExcMessage("no case: " + line));
    Case made;
    made.name  = parts[0];
    made.scene = parts[1];
    const auto base =
      std::find_if(earlier.begin(), earlier.end(), [&](const Case &other) {
        return other.name == made.scene;
      });
    if (base != earlier.end())
      {
        made.scene     = base->scene;
        made.arguments = base->arguments;
      }
    made.is_run = parts.size() > 2 && parts[2] == "run";
    if (parts.size() > 2 && !made.is_run && !parts[2].empty())
      for (const std::string &argument : split(parts[2], ";;"))
        made.arguments.push_back(argument);
    if (parts.size() > 3)
      made.message = parts[3];
    return made;
  }



  void
  add_line(Case &to, const std::string &line)
  {
    const auto take = [&line](const std::string &head, Strings &list) {
      const bool is_there = boost::starts_with(line, head);
      if (is_there)
        list.push_back(boost::trim_copy(line.substr(head.size())));
      return is_there;
    };
    if (!take("says:", to.texts) && !take("not:", to.unwanted) &&
        !take("row:", to.rows))
      to.arguments.push_back("--set=" + line);
  }



  std::vector<Case>
  read_cases(const std::string &file)
  {
    std::ifstream in(file);
    std::vector<Case> cases;
    for (std::string line; std::getline(in, line);)
      if (line.empty() || line[0] == '#')
        continue;
      else if (line[0] != ' ')
        cases.push_back(make_case(line, cases));
      else
        add_line(cases.at(cases.size() - 1), boost::trim_copy(line));
    return cases;
  }



  Answer
  call(const Case &asked, const std::string &prm, const std::string &output)
  {
    Strings words{"keyblock", "--output", output, prm + "/" + asked.scene};
    if (!asked.is_run && asked.message.empty())
      words.push_back("--validate");
    words.insert(words.end(), asked.arguments.begin(), asked.arguments.end());
    std::vector<const char *> argv;
    for (const std::string &word : words)
      argv.push_back(word.c_str());
    std::filesystem::remove_all(output);
    std::ostringstream out, error;
    std::streambuf *const screen = std::cout.rdbuf(out.rdbuf());
    std::streambuf *const errors = std::cerr.rdbuf(error.rdbuf());
    const int code =
      Keyblock::run_program(Keyblock::Communicator(MPI_COMM_WORLD),
                            argv.size(),
                            argv.data());
    std::cout.rdbuf(screen);
    std::cerr.rdbuf(errors);
    return {code, out.str(), error.str(), std::filesystem::exists(output)};
  }



  /** Whether all parts of the text, at ..., stand on one line in this order. */
  bool
  has_text(const Strings &lines, const std::string &text)
  {
    const Strings parts = split(text, "...");
    return std::any_of(lines.begin(),
                       lines.end(),
                       [&parts](const std::string &line) {
                         std::size_t at = 0;
                         for (const std::string &part : parts)
                           {
                             at = line.find(part, at);
                             if (at == std::string::npos)
                               return false;
                             at += part.size();
                           }
                         return true;
                       });
  }



  /** What is wrong with a row: block, stage, factor, mode, remarks. */
  std::string
  fault_of_row(const std::smatch &found, const std::string &expected)
  {
    const Strings columns = split(expected, "|", 6);
    AssertThrow(columns.size() == 6, dealii::ExcMessage("no row: " + expected));
    const double tolerance = std::stod(columns[3]);
    if (found[1] != columns[0] || found[2] != columns[1] ||
        found[4] != columns[4])
      return "another block, stage or mode";
    const std::string factor = found[3];
    if ((factor == "-" || columns[2] == "-")
          ? factor != columns[2]
          : !(std::abs(std::stod(factor) - std::stod(columns[2])) <=
              tolerance * std::stod(columns[2])))
      return "another factor";
    const std::string remarks = found[5];
    for (const std::string &words : split(columns[5], ";"))
      if (words[0] == '!' ? remarks.find(words.substr(1)) != std::string::npos
                          : remarks.find(words) == std::string::npos)
        return "not as '" + words + "' asks for";
    return "";
  }



  /** The same of all rows. */
  std::string
  fault_of_rows(const Strings &lines, const Strings &expected)
  {
    const std::regex form(" *(\\d+)  (.+?)  +(\\S+)  (.+?): (.*)");
    auto line =
      std::find_if(lines.begin(), lines.end(), [](const std::string &text) {
        return boost::starts_with(text, "  id  after ");
      });
    std::size_t n_rows = 0;
    std::smatch found;
    while (line != lines.end() && ++line != lines.end() &&
           std::regex_match(*line, found, form))
      {
        if (n_rows == expected.size())
          return "one more row: " + *line;
        const std::string fault = fault_of_row(found, expected[n_rows]);
        if (!fault.empty())
          return fault + ":\n  " + *line + "\n  expected " + expected[n_rows];
        ++n_rows;
      }
    return n_rows == expected.size() ? "" : "no row for " + expected[n_rows];
  }



  /** What is wrong with an answer; empty: nothing. */
  std::string
  find_fault(const Answer &answer, const Case &expected)
  {
    if (answer.has_written && !expected.is_run)
      return "something was written";
    const bool is_refused = !expected.message.empty();
    if (answer.code != (is_refused ? 1 : 0))
      return "exit code " + std::to_string(answer.code);
    if (is_refused)
      return !boost::starts_with(answer.error, "Error: ") ||
                 answer.error.find('\n') != answer.error.size() - 1
               ? "not one line"
             : answer.error.find(expected.message) == std::string::npos
               ? "without '" + expected.message + "'"
               : "";
    const Strings lines = split(answer.out + answer.error, "\n");
    for (const std::string &text : expected.texts)
      if (!has_text(lines, text))
        return "without '" + text + "'";
    for (const std::string &text : expected.unwanted)
      if (has_text(lines, text))
        return "with '" + text + "'";
    // (with the blanks at which a line begins)
    Strings printed;
    boost::split(printed, answer.out, boost::is_any_of("\n"));
    return expected.rows.empty() ? "" : fault_of_rows(printed, expected.rows);
  }
} // namespace



int
main(int argc, char *argv[])
{
  if (argc < 4)
    return 2;
  int n_names       = 1;
  char *only_name[] = {argv[0], nullptr}, **names = only_name;
  dealii::Utilities::MPI::MPI_InitFinalize mpi(n_names, names, 1);
  dealii::deal_II_exceptions::disable_abort_on_exception();
  const Strings wanted(argv + 4, argv + argc);
  unsigned int n_tried = 0, n_wrong = 0;
  for (const Case &expected : read_cases(argv[1]))
    if (wanted.empty() ||
        std::find(wanted.begin(), wanted.end(), expected.name) != wanted.end())
      {
        ++n_tried;
        std::cout << expected.name << ": " << std::flush;
        const Answer answer =
          call(expected, argv[2], std::string(argv[3]) + "_" + expected.name);
        const std::string fault = find_fault(answer, expected);
        std::cout << (fault.empty() ? "ok" : "FAULT: " + fault) << std::endl;
        if (!fault.empty() || !wanted.empty())
          std::cout << answer.out << answer.error;
        n_wrong += !fault.empty();
      }
  std::cout << n_tried << " cases, " << n_wrong << " wrong" << std::endl;
  return n_wrong > 0 || n_tried == 0;
}
