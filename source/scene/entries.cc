// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/scene/entries.h>

#include <deal.II/base/parameter_handler.h>

#include <keyblock/law/joint_strength.h>
#include <keyblock/scene/old_names.h>

#include <boost/algorithm/string.hpp>

#include <set>
#include <sstream>

namespace Keyblock
{
  std::vector<std::pair<std::string, std::string>>
  list_entries(const std::string &text)
  {
    const auto trimmed = [](const std::string &piece) {
      const auto begin = piece.find_first_not_of(' ');
      return begin == std::string::npos
               ? ""
               : piece.substr(begin, piece.find_last_not_of(' ') - begin + 1);
    };
    std::vector<std::pair<std::string, std::string>> values;
    std::vector<std::string> sections;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
      {
        line             = trimmed(line.substr(0, line.find('#')));
        const auto equal = line.find('=');
        if (line.compare(0, 11, "subsection ") == 0)
          sections.push_back(line.substr(11) + '/');
        else if (line == "end" && !sections.empty())
          sections.pop_back();
        else if (line.compare(0, 4, "set ") == 0 && equal != std::string::npos)
          {
            std::string name;
            for (const std::string &section : sections)
              name += section;
            values.emplace_back(name + trimmed(line.substr(4, equal - 4)),
                                trimmed(line.substr(equal + 1)));
          }
      }
    return values;
  }



  void
  set_entries(dealii::ParameterHandler &prm,
              const std::string &section,
              const std::vector<std::pair<std::string, std::string>> &entries)
  {
    prm.enter_subsection(section);
    for (const auto &[entry, value] : entries)
      prm.set(entry, value);
    prm.leave_subsection();
  }



  std::string
  lines_setting(const std::string &entry,
                const std::string &value,
                std::vector<std::string> *warnings)
  {
    std::vector<std::string> parts;
    boost::split(parts, entry, boost::is_any_of("/"));
    std::string text;
    for (unsigned int i = 0; i + 1 < parts.size(); ++i)
      text += "subsection " + parts[i] + "\n";
    text += "set " + parts.back() + " = " + value + "\n";
    for (unsigned int i = 0; i + 1 < parts.size(); ++i)
      text += "end\n";
    const std::vector<std::string> sentences = replace_old_names(text);
    if (warnings)
      warnings->insert(warnings->end(), sentences.begin(), sentences.end());
    return text;
  }



  std::string
  last_of(const std::string &entry)
  {
    return entry.substr(entry.rfind('/') + 1);
  }



  bool
  is_strength(const std::string &name)
  {
    static const std::set<std::string> names = []() {
      JointStrength strength;
      dealii::ParameterHandler prm;
      strength.declare_strength(prm);
      std::ostringstream text;
      prm.print_parameters(text, dealii::ParameterHandler::ShortPRM);
      std::set<std::string> all;
      for (const auto &[entry, value] : list_entries(text.str()))
        all.insert(entry);
      return all;
    }();
    return names.count(name) > 0;
  }



  bool
  leaves_geometry(const std::string &entry)
  {
    static const std::set<std::string> sections = {
      "Water", "Tractions", "Safety factor", "Initial state", "Stages"};
    const std::string section = entry.substr(0, entry.find('/'));
    return sections.count(section) > 0 ||
           ((section == "Joints" || section == "Joint sets") &&
            is_strength(last_of(entry))) ||
           entry == "Contact/Default friction angle";
  }
} // namespace Keyblock
