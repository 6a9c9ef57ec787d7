// SPDX-License-Identifier: LGPL-2.1-or-later
// Which entries the variables of a study set, and whether they can.
#include <keyblock/base/number_text.h>
#include <keyblock/scene/check.h>
#include <keyblock/scene/entries.h>
#include <keyblock/scene/joints.h>
#include <keyblock/scene/study_entries.h>
#include <keyblock/scene/text.h>

#include <deal.II/base/parameter_handler.h>

#include <boost/algorithm/string.hpp>

#include <algorithm>

namespace Keyblock
{
  namespace
  {
    using Path = std::vector<std::string>;

    /** Parts of the entry of a variable, by their present names. */
    Path
    path_of(const StudyVariable &variable)
    {
      const auto entries = list_entries(lines_setting(variable.entry, "0"));
      Path path;
      boost::split(path, entries.at(0).first, boost::is_any_of("/"));
      return path;
    }

    bool
    is_of_joints(const Path &path)
    {
      return path.size() == 3 && path[0] == "Joints";
    }

    bool
    is_of_set(const Path &path)
    {
      return path.size() == 3 && path[0] == "Joint sets";
    }

    /** Name by which entries call the joint that this one is, or is part of. */
    template <int dim>
    const std::string &
    name_in_entries(const Scene<dim> &scene, const Joint<dim> &joint)
    {
      const bool is_part =
        !joint.surface.empty() &&
        (joint.form == JointForm::physical_group || !scene.network.is_resolved);
      return is_part ? joint.surface : joint.name;
    }

    template <int dim>
    bool
    means_joint(const Scene<dim> &scene,
                const Path &path,
                const Joint<dim> &joint)
    {
      if (is_of_set(path))
        return path[1] == joint.set;
      return is_of_joints(path) &&
             (matches_name(path[1], name_in_entries(scene, joint)) ||
              (!joint.set.empty() && matches_name(path[1], joint.set)));
    }

    std::string
    strength_entry(JointStrength strength, const std::string &name)
    {
      ParameterHandler prm;
      strength.declare_strength(prm);
      return prm.get(name);
    }

    /** Whether the entry of a set says nothing of a joint of that set: the
     * joint has a value of its own. */
    template <int dim>
    bool
    is_left_alone(const Scene<dim> &scene,
                  const Path &path,
                  const Joint<dim> &joint)
    {
      if (!is_of_set(path))
        return false;
      for (const auto &set : scene.joint_sets)
        if (set->name == path[1])
          return is_strength(path[2])
                   ? strength_entry(set->strength, path[2]) !=
                       strength_entry(joint, path[2])
                   : !set->is_made();
      return true;
    }

    /** An entry that both paths set; empty: there is none. */
    template <int dim>
    std::string
    common_entry(const Scene<dim> &scene, const Path &a, const Path &b)
    {
      if (a == b && !is_of_joints(a))
        return boost::join(a, "/");
      if (a.back() != b.back())
        return "";
      for (const auto &joint : scene.joints)
        if (means_joint(scene, a, *joint) && means_joint(scene, b, *joint) &&
            !is_left_alone(scene, a, *joint) &&
            !is_left_alone(scene, b, *joint))
          return "Joints/" + name_in_entries(scene, *joint) + "/" + a.back();
      return "";
    }

    template <typename Item>
    void
    name_alike(const std::vector<std::unique_ptr<Item>> &items,
               std::vector<std::unique_ptr<Item>> &others)
    {
      for (const auto &item : items)
        {
          others.push_back(std::make_unique<Item>());
          others.back()->name = item->name;
        }
    }

    /** The entries of a scene, to try values in; all joints are one, since
     * there may be thousands. */
    template <int dim>
    class EntriesToTry
    {
    public:
      explicit EntriesToTry(const Scene<dim> &scene)
        : scene(scene)
      {
        name_alike(scene.excavations, blank.excavations);
        name_alike(scene.joint_sets, blank.joint_sets);
        name_alike(scene.materials, blank.materials);
        name_alike(scene.supports, blank.supports);
        name_alike(scene.bolts, blank.bolts);
        name_alike(scene.liners, blank.liners);
        name_alike(scene.tractions, blank.tractions);
        name_alike(scene.stages, blank.stages);
        name_alike(scene.monitors, blank.monitors);
        blank.joints.push_back(std::make_unique<Joint<dim>>());
        blank.joints.back()->name = any_joint;
        blank.declare(prm);
      }

      bool
      has(const Path &path)
      {
        if (is_of_joints(path) &&
            std::none_of(scene.joints.begin(),
                         scene.joints.end(),
                         [&](const auto &joint) {
                           return means_joint(scene, path, *joint);
                         }))
          return false;
        return try_value(path, 0.) != Answer::unknown;
      }

      bool
      takes(const Path &path, const double value)
      {
        return try_value(path, value) == Answer::taken;
      }

      /** Whether it takes any number. */
      bool
      takes_numbers(const Path &path)
      {
        return takes(path, 0.) || takes(path, 0.5) || takes(path, 1.) ||
               takes(path, 1e3);
      }

    private:
      /** No name that a file can give. */
      static constexpr const char *any_joint = "any/joint";

      enum class Answer
      {
        unknown, ///< there is no such entry
        refused, ///< it does not take the value
        taken
      };

      Answer
      try_value(const Path &path, const double value)
      {
        for (const std::string &section : sections_of(path))
          prm.enter_subsection(section);
        Answer answer = Answer::taken;
        try
          {
            prm.set(path.back(), exact_text(value));
          }
        catch (const ParameterHandler::ExcEntryUndeclared &)
          {
            answer = Answer::unknown;
          }
        catch (const ParameterHandler::ExcValueDoesNotMatchPattern &)
          {
            answer = Answer::refused;
          }
        for (unsigned int i = 0; i + 1 < path.size(); ++i)
          prm.leave_subsection();
        return answer;
      }

      static Path
      sections_of(const Path &path)
      {
        Path sections(path.begin(), path.end() - 1);
        if (is_of_joints(path))
          sections.back() = any_joint;
        return sections;
      }

      const Scene<dim> &scene;
      Scene<dim> blank;
      ParameterHandler prm;
    };
  } // namespace



  template <int dim>
  void
  check_study_entries(const Scene<dim> &scene)
  {
    const auto &variables = scene.study_variables;
    if (variables.empty())
      return;
    EntriesToTry<dim> entries(scene);
    std::vector<Path> paths;
    for (const auto &variable : variables)
      {
        paths.push_back(path_of(*variable));
        require(entries.has(paths.back()),
                "The entry 'Study/" + variable->name + "/Entry' is '" +
                  variable->entry +
                  "', but the scene has no such entry; entries are listed in "
                  "doc/parameters.md (or by --print-parameters).");
        require(entries.takes_numbers(paths.back()),
                "The entry 'Study/" + variable->name + "/Entry' is '" +
                  variable->entry +
                  "', which takes no single number, but a list of them or a "
                  "word; a study varies entries of one number.");
      }
    for (unsigned int b = 1; b < paths.size(); ++b)
      for (unsigned int a = 0; a < b; ++a)
        {
          const std::string entry = common_entry(scene, paths[a], paths[b]);
          require(entry.empty(),
                  "The variables '" + variables[a]->name + "' and '" +
                    variables[b]->name + "' of the study both set '" + entry +
                    "' ('Study/" + variables[a]->name + "/Entry' is '" +
                    variables[a]->entry + "', 'Study/" + variables[b]->name +
                    "/Entry' is '" + variables[b]->entry +
                    "'); leave one of them out of 'Study/Names', or let them "
                    "name different joints.");
        }
  }



  template <int dim>
  void
  check_study_values(const Scene<dim> &scene,
                     const std::vector<std::vector<double>> &values)
  {
    EntriesToTry<dim> entries(scene);
    for (unsigned int v = 0; v < values.size(); ++v)
      {
        const StudyVariable &variable = *scene.study_variables[v];
        const auto [least, greatest] =
          std::minmax_element(values[v].begin(), values[v].end());
        for (const double value : {*least, *greatest})
          require(entries.takes(path_of(variable), value),
                  "The variable '" + variable.name +
                    "' of the study has the value " + text_of(value) +
                    ", which the entry '" + variable.entry +
                    "' does not take; cut its distribution off by 'Study/" +
                    variable.name + "/Minimum' (now " +
                    text_of(variable.minimum) + ") and 'Maximum' (now " +
                    text_of(variable.maximum) +
                    "), ranges of entries are listed in doc/parameters.md.");
      }
  }

  template <int dim>
  std::vector<std::string>
  list_variables_of_stress(const Scene<dim> &scene)
  {
    const std::vector<Path> idle = {{"Ground", "K0"},
                                    {"Ground", "Azimuth"},
                                    {"Initial state",
                                     "Vertical stress gradient"},
                                    {"Initial state", "Surface stress"},
                                    {"Initial state", "Lateral ratios"},
                                    {"Initial state", "Lateral azimuth"},
                                    {"Materials", "Young modulus"},
                                    {"Materials", "Poisson ratio"}};
    std::vector<std::string> names;
    for (const auto &variable : scene.study_variables)
      {
        const Path path = path_of(*variable);
        if (std::count(idle.begin(),
                       idle.end(),
                       Path{path.front(), path.back()}) > 0)
          names.push_back(variable->name);
      }
    return names;
  }

  template std::vector<std::string> list_variables_of_stress(const Scene<2> &);
  template std::vector<std::string> list_variables_of_stress(const Scene<3> &);
  template void check_study_entries(const Scene<2> &);
  template void check_study_entries(const Scene<3> &);
  template void check_study_values(const Scene<2> &,
                                   const std::vector<std::vector<double>> &);
  template void check_study_values(const Scene<3> &,
                                   const std::vector<std::vector<double>> &);
} // namespace Keyblock
