// SPDX-License-Identifier: LGPL-2.1-or-later
// Scenes that cannot be used, and what is said of them.
//
// usage: error_cases CASES PRM_FOLDER OUTPUT [NAME...]
//
// Every line of CASES, or those with the names given, is a call of the program:
// name | scene | arguments separated by ;; | what the message must contain. It
// passes if the exit code is 1, the message on standard error is a single line
// with that in it, and no folder OUTPUT_name is made.
#include <deal.II/base/mpi.h>

#include <keyblock/run/program.h>

#include <boost/algorithm/string.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>

namespace
{
  struct Case
  {
    std::string name, scene, fragment;
    std::vector<std::string> arguments;
  };



  std::vector<Case>
  read_cases(const std::string &file)
  {
    std::ifstream in(file);
    std::vector<Case> cases;
    for (std::string line; std::getline(in, line);)
      {
        if (line.empty() || line[0] == '#')
          continue;
        std::vector<std::string> parts;
        // the message may have a bar in it, too
        for (std::size_t begin = 0; parts.size() < 3;)
          {
            const std::size_t end = line.find('|', begin);
            AssertThrow(end != std::string::npos,
                        dealii::ExcMessage("no case: " + line));
            parts.push_back(boost::trim_copy(line.substr(begin, end - begin)));
            begin = end + 1;
            if (parts.size() == 3)
              parts.push_back(boost::trim_copy(line.substr(begin)));
          }
        Case next{parts[0], parts[1], parts[3], {}};
        for (std::size_t begin = 0; begin < parts[2].size();)
          {
            const std::size_t end =
              std::min(parts[2].find(";;", begin), parts[2].size());
            next.arguments.push_back(parts[2].substr(begin, end - begin));
            begin = end + 2;
          }
        cases.push_back(next);
      }
    return cases;
  }



  /** What is wrong with the program's answer; empty: nothing. */
  std::string
  find_fault(const int code,
             const std::string &message,
             const Case &expected,
             const std::string &output)
  {
    if (code != 1)
      return "exit code " + std::to_string(code);
    if (!boost::starts_with(message, "Error: ") ||
        message.find('\n') != message.size() - 1)
      return "not one line";
    if (message.find(expected.fragment) == std::string::npos)
      return "without '" + expected.fragment + "'";
    if (std::filesystem::exists(output))
      return "something was written";
    return "";
  }



  std::string
  try_case(const Case &expected,
           const std::string &prm,
           const std::string &output)
  {
    std::vector<std::string> words{"keyblock",
                                   "--output",
                                   output,
                                   prm + "/" + expected.scene};
    words.insert(words.end(),
                 expected.arguments.begin(),
                 expected.arguments.end());
    std::vector<const char *> argv;
    for (const std::string &word : words)
      argv.push_back(word.c_str());
    std::ostringstream out, err;
    std::streambuf *const screen = std::cout.rdbuf(out.rdbuf());
    std::streambuf *const errors = std::cerr.rdbuf(err.rdbuf());
    const int code =
      Keyblock::run_program(Keyblock::Communicator(MPI_COMM_WORLD),
                            argv.size(),
                            argv.data());
    std::cout.rdbuf(screen);
    std::cerr.rdbuf(errors);
    const std::string fault = find_fault(code, err.str(), expected, output);
    std::cout << expected.name << ": " << err.str();
    if (!fault.empty())
      std::cout << "FAULT: " << fault << std::endl;
    return fault;
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
  const std::vector<std::string> wanted(argv + 4, argv + argc);
  unsigned int n_tried = 0, n_wrong = 0;
  for (const Case &expected : read_cases(argv[1]))
    if (wanted.empty() ||
        std::find(wanted.begin(), wanted.end(), expected.name) != wanted.end())
      {
        ++n_tried;
        if (!try_case(expected,
                      argv[2],
                      std::string(argv[3]) + "_" + expected.name)
               .empty())
          ++n_wrong;
      }
  std::cout << n_tried << " cases, " << n_wrong << " wrong" << std::endl;
  return n_wrong > 0 || n_tried == 0;
}
