// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/errors.h>
#include <keyblock/base/number_text.h>
#include <keyblock/run/varied_strengths.h>
#include <keyblock/scene/check_parts.h>
#include <keyblock/scene/entries.h>

#include <algorithm>
#include <tuple>

namespace Keyblock
{
  namespace
  {
    bool
    are_equal(const JointStrength &a, const JointStrength &b)
    {
      const auto members = [](const JointStrength &s) {
        return std::tie(s.friction_angle,
                        s.kinetic_friction_angle,
                        s.cohesion,
                        s.tensile_strength,
                        s.residual_cohesion,
                        s.water_pressure,
                        s.water_level,
                        s.law,
                        s.law_values);
      };
      return members(a) == members(b);
    }

    bool
    is_strength_of_joints(const std::string &entry)
    {
      const std::string section = entry.substr(0, entry.find('/'));
      return (section == "Joints" || section == "Joint sets") &&
             is_strength(last_of(entry));
    }
  } // namespace



  template <int dim>
  VariedStrengths<dim>::VariedStrengths(
    Scene<dim> &scene,
    const std::vector<std::vector<double>> &values,
    const Reader &read)
    : scene(scene)
    , values(values)
  {
    if (!std::all_of(scene.study_variables.begin(),
                     scene.study_variables.end(),
                     [](const auto &variable) {
                       return is_strength_of_joints(variable->entry);
                     }))
      return;
    try
      {
        find(read);
      }
    catch (const InputError &)
      {
        groups.clear(); // said of the sample that is at fault
      }
  }



  template <int dim>
  void
  VariedStrengths<dim>::find(const Reader &read)
  {
    std::vector<double> drawn;
    for (const std::vector<double> &all : values)
      drawn.push_back(all[0]);
    Scene<dim> first;
    read(drawn, first);
    std::vector<std::vector<unsigned int>> variables_of(scene.joints.size());
    for (unsigned int v = 0; v < values.size(); ++v)
      {
        const auto differs = std::find_if(values[v].begin(),
                                          values[v].end(),
                                          [&](const double value) {
                                            return value != values[v][0];
                                          });
        if (differs == values[v].end())
          return;
        drawn[v] = *differs;
        Scene<dim> other;
        read(drawn, other);
        drawn[v] = values[v][0];
        for (unsigned int j = 0; j < scene.joints.size(); ++j)
          if (!are_equal(*first.joints[j], *other.joints[j]))
            variables_of[j].push_back(v);
      }
    for (unsigned int j = 0; j < scene.joints.size(); ++j)
      if (!variables_of[j].empty())
        add_to_group(*scene.joints[j], variables_of[j]);
    set(0);
    const bool is_right = are_those_of(first.joints);
    reset();
    if (!is_right)
      groups.clear();
  }



  template <int dim>
  void
  VariedStrengths<dim>::add_to_group(Joint<dim> &joint,
                                     const std::vector<unsigned int> &variables)
  {
    auto group =
      std::find_if(groups.begin(), groups.end(), [&](const auto &one) {
        return one->variables == variables && are_equal(one->original, joint);
      });
    if (group == groups.end())
      {
        groups.push_back(std::make_unique<Group>());
        group              = groups.end() - 1;
        (*group)->original = (*group)->now = joint;
        (*group)->now.declare_strength((*group)->prm);
        (*group)->variables = variables;
      }
    (*group)->joints.push_back(&joint);
  }



  template <int dim>
  bool
  VariedStrengths<dim>::are_those_of(const Joints &joints) const
  {
    return std::equal(scene.joints.begin(),
                      scene.joints.end(),
                      joints.begin(),
                      joints.end(),
                      [](const auto &a, const auto &b) {
                        return are_equal(*a, *b);
                      });
  }



  template <int dim>
  void
  VariedStrengths<dim>::set(const unsigned int sample) const
  {
    for (const auto &group : groups)
      {
        for (const unsigned int v : group->variables)
          group->prm.set(last_of(scene.study_variables[v]->entry),
                         exact_text(values[v][sample]));
        for (Joint<dim> *joint : group->joints)
          static_cast<JointStrength &>(*joint) = group->now;
        check_joint(*group->joints.front());
      }
  }



  template <int dim>
  void
  VariedStrengths<dim>::reset() const
  {
    for (const auto &group : groups)
      for (Joint<dim> *joint : group->joints)
        static_cast<JointStrength &>(*joint) = group->original;
  }

  template class VariedStrengths<2>;
  template class VariedStrengths<3>;
} // namespace Keyblock
