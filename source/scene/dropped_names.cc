// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/errors.h>
#include <keyblock/scene/dropped_names.h>

#include <boost/algorithm/string.hpp>

#include <fnmatch.h>

#include <algorithm>
#include <map>
#include <set>
#include <sstream>

namespace Keyblock
{
  namespace
  {
    using NamesBySection = std::map<std::string, std::set<std::string>>;

    std::set<std::string>
    names_in(const std::string &list)
    {
      std::set<std::string> names;
      std::istringstream in(list);
      for (std::string name; std::getline(in, name, ',');)
        names.insert(boost::trim_copy(name));
      names.erase("");
      return names;
    }

    /** The sections and the entry that an override names. */
    std::vector<std::string>
    override_path(const std::string &assignment)
    {
      std::vector<std::string> path;
      const std::string left = assignment.substr(0, assignment.find('='));
      boost::split(path, left, boost::is_any_of("/"));
      for (std::string &part : path)
        boost::trim(part);
      return path;
    }

    /** Lists that overrides give, the last of each section. */
    NamesBySection
    names_of_overrides(const std::vector<std::string> &assignments)
    {
      NamesBySection names;
      for (const std::string &assignment : assignments)
        {
          const auto equal                    = assignment.find('=');
          const std::vector<std::string> path = override_path(assignment);
          if (equal != std::string::npos && path.size() == 2 &&
              path[1] == "Names")
            names[path[0]] = names_in(assignment.substr(equal + 1));
        }
      return names;
    }

    /** Calls an action with each line of the text, its significant part, and
     * the subsections that it stands in; that which a line opens or ends is
     * one of them. */
    template <typename Action>
    void
    for_each_line(const std::string &text, const Action &action)
    {
      std::istringstream lines(text);
      std::vector<std::string> sections;
      bool is_continued = false;
      for (std::string line; std::getline(lines, line);)
        {
          const std::string words = significant_part(line);
          const std::string lower = boost::to_lower_copy(words.substr(0, 11));
          if (!is_continued && lower == "subsection ")
            sections.push_back(words.substr(11));
          action(line, words, sections);
          if (!is_continued && boost::to_lower_copy(words) == "end" &&
              !sections.empty())
            sections.pop_back();
          is_continued = boost::ends_with(line, "\\");
        }
    }

    /** Lists that the file gives. */
    NamesBySection
    names_of_file(const std::string &text)
    {
      NamesBySection names = {{"Materials", {default_materials}}};
      std::string section;
      std::string list;
      for_each_line(text,
                    [&](const std::string &,
                        std::string words,
                        const std::vector<std::string> &sections) {
                      if (section.empty())
                        {
                          const auto equal = words.find('=');
                          if (sections.size() != 1 ||
                              !boost::istarts_with(words, "set ") ||
                              equal == std::string::npos ||
                              boost::trim_copy(words.substr(4, equal - 4)) !=
                                "Names")
                            return;
                          section = sections[0];
                          list.clear();
                          words = words.substr(equal + 1);
                        }
                      const bool goes_on = boost::ends_with(words, "\\");
                      list += words.substr(0, words.size() - goes_on);
                      if (goes_on)
                        return;
                      names[section] = names_in(list);
                      section.clear();
                    });
      return names;
    }
  } // namespace



  std::vector<std::string>
  without_patterns(const std::string &text,
                   const std::vector<std::string> &assignments)
  {
    NamesBySection names;
    std::vector<std::string> all;
    for (const std::string &assignment : assignments)
      {
        const std::vector<std::string> path = override_path(assignment);
        const auto equal                    = assignment.find('=');
        if (path.size() != 3 || path[0] == "Joints" ||
            path[1].find_first_of("*?[") == std::string::npos ||
            equal == std::string::npos)
          {
            all.push_back(assignment);
            continue;
          }
        if (names.empty())
          {
            names = names_of_overrides(assignments);
            names.merge(names_of_file(text));
          }
        bool is_used = false;
        std::string list;
        for (const std::string &name : names[path[0]])
          {
            list += (list.empty() ? "" : ", ") + name;
            if (fnmatch(path[1].c_str(), name.c_str(), 0) != 0)
              continue;
            all.push_back(path[0] + "/" + name + "/" + path[2] +
                          assignment.substr(equal));
            is_used = true;
          }
        AssertThrow(is_used,
                    InputError("The override --set \"" + assignment +
                               "\" matches no name of '" + path[0] +
                               "/Names' (" + (list.empty() ? "none" : list) +
                               "); name one, or use * for all of them."));
      }
    return all;
  }



  void
  drop_names_taken_out(SceneText &scene)
  {
    std::vector<std::string> assignments;
    for (const SceneText::Override &entry : scene.overrides)
      assignments.push_back(entry.assignment);
    const NamesBySection wanted = names_of_overrides(assignments);
    if (wanted.empty())
      return;
    NamesBySection dropped = names_of_file(scene.text);
    for (auto &[section, names] : dropped)
      {
        const auto list = wanted.find(section);
        if (list == wanted.end())
          names.clear();
        else
          for (const std::string &name : list->second)
            names.erase(name);
      }
    // blank lines in their place: messages name lines of the file
    std::string rest;
    for_each_line(scene.text,
                  [&](const std::string &line,
                      const std::string &,
                      const std::vector<std::string> &sections) {
                    const bool is_dropped =
                      sections.size() >= 2 &&
                      dropped[sections[0]].count(sections[1]) > 0;
                    rest += (is_dropped ? "" : line) + '\n';
                  });
    scene.text      = rest;
    auto &joints    = scene.joint_subsections;
    const auto &off = dropped["Joints"];
    joints.erase(std::remove_if(joints.begin(),
                                joints.end(),
                                [&](const JointPassage &passage) {
                                  return off.count(passage.joint) > 0;
                                }),
                 joints.end());
  }
} // namespace Keyblock
