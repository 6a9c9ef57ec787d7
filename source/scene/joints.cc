// SPDX-License-Identifier: LGPL-2.1-or-later
// The joints of a scene: named ones, those of a table and those of sets.
#include <deal.II/base/parameter_handler.h>

#include <keyblock/base/errors.h>
#include <keyblock/base/number_text.h>
#include <keyblock/law/joint_stiffness.h>
#include <keyblock/scene/idle_entries.h>
#include <keyblock/scene/joint_sets.h>
#include <keyblock/scene/joint_table.h>
#include <keyblock/scene/joints.h>

#include <fnmatch.h>

#include <filesystem>
#include <map>
#include <set>

namespace Keyblock
{
  bool
  matches_name(const std::string &pattern, const std::string &name)
  {
    return pattern == name || fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
  }



  namespace
  {
    template <int dim>
    using Joints = std::vector<std::unique_ptr<Joint<dim>>>;

    using StrengthOfSet = std::map<std::string, JointStrength>;

    /** Parses entries into one joint after the other: declared only once. */
    template <int dim>
    class JointParser
    {
    public:
      JointParser()
      {
        present.declare(prm);
      }

      void
      parse(const JointPassage &passage, Joint<dim> &joint)
      {
        present = joint;
        try
          {
            parse_entries(prm,
                          passage.text,
                          "",
                          passage.place + ", joint '" + joint.name + "'");
          }
        catch (const InputError &)
          {
            // once more, so that the message has the line in the file
            parse_entries(prm,
                          std::string(passage.line, '\n') + passage.text,
                          passage.line > 0 ? passage.place : "",
                          passage.place + ", joint '" + joint.name + "'");
          }
        joint = present;
      }

    private:
      Joint<dim> present;
      ParameterHandler prm;
    };

    /** A list of at most five names, for messages. */
    std::string
    list_some(const std::set<std::string> &names)
    {
      std::string list;
      unsigned int n = 0;
      for (const std::string &name : names)
        if (n++ < 5)
          list += (list.empty() ? "" : ", ") + name;
      return list.empty() ? "none" : n > 5 ? list + ", ..." : list;
    }

    template <int dim>
    std::set<std::string>
    set_of_names(const Joints<dim> &joints)
    {
      std::set<std::string> names;
      for (const auto &joint : joints)
        names.insert(joint->name);
      return names;
    }

    template <int dim>
    std::set<std::string>
    sets_of(const Joints<dim> &joints)
    {
      std::set<std::string> sets;
      for (const auto &joint : joints)
        if (!joint->set.empty())
          sets.insert(joint->set);
      return sets;
    }

    template <int dim>
    Joints<dim>
    collect(const Scene<dim> &scene,
            const std::vector<std::string> &names,
            const StrengthOfSet &strength_of_set)
    {
      Joints<dim> joints;
      for (const std::string &name : names)
        {
          joints.push_back(std::make_unique<Joint<dim>>());
          joints.back()->name = name;
        }
      if (scene.network.is_resolved)
        return joints;
      const auto add = [&joints](Joints<dim> &&more) {
        joints.insert(joints.end(),
                      std::make_move_iterator(more.begin()),
                      std::make_move_iterator(more.end()));
      };
      if (!scene.network.file.empty())
        {
          const std::filesystem::path path =
            std::filesystem::path(scene.file).parent_path() /
            scene.network.file;
          add(read_joint_table<dim>(path.lexically_normal().string(),
                                    scene.domain.origin,
                                    strength_of_set));
        }
      for (const auto &set : scene.joint_sets)
        if (set->is_made())
          add(make_joints_of_set(*set, scene.domain));
      return joints;
    }

    /** No joint may have the name of another one, or of a set. */
    template <int dim>
    void
    check_names(const Joints<dim> &joints, const StrengthOfSet &strength_of_set)
    {
      std::set<std::string> sets = sets_of<dim>(joints);
      for (const auto &[name, strength] : strength_of_set)
        sets.insert(name);
      AssertThrow(sets.count("all") == 0,
                  InputError("A set of joints is called 'all', which stands "
                             "for every joint; give it another name."));
      const auto origin_of = [](const Joint<dim> &joint) {
        return joint.origin.empty() ? "The entry 'Joints/Names'" : joint.origin;
      };
      std::map<std::string, const Joint<dim> *> seen;
      for (const auto &joint : joints)
        {
          const auto [first, is_new] = seen.emplace(joint->name, joint.get());
          AssertThrow(is_new,
                      InputError(origin_of(*joint) + " has the joint '" +
                                 joint->name + "', whose name stands before: " +
                                 origin_of(*first->second) +
                                 "; give each joint its own name."));
          AssertThrow(sets.count(joint->name) == 0,
                      InputError(origin_of(*joint) + " has the joint '" +
                                 joint->name +
                                 "', which is the name of a set too; give "
                                 "one of them another name."));
        }
    }

    using Passages = std::vector<std::vector<const JointPassage *>>;

    /** Add the subsections of each joint to what is said of it. */
    template <int dim>
    void
    add_subsections(const Joints<dim> &joints,
                    const SceneText &text,
                    Passages &passages)
    {
      std::map<std::string, unsigned int> index_of;
      for (unsigned int j = 0; j < joints.size(); ++j)
        index_of[joints[j]->name] = j;
      for (const JointPassage &passage : text.joint_subsections)
        {
          const auto found = index_of.find(passage.joint);
          AssertThrow(found != index_of.end(),
                      InputError(
                        "In " + passage.place +
                        ", there is a subsection 'Joints/" + passage.joint +
                        "', but no such joint; add it to "
                        "'Joints/Names' or correct its name (joints: " +
                        list_some(set_of_names<dim>(joints)) + ")."));
          passages[found->second].push_back(&passage);
        }
    }

    /** Add the overrides whose pattern is of a joint or of its set. */
    template <int dim>
    void
    add_overrides(const Joints<dim> &joints,
                  const SceneText &text,
                  Passages &passages)
    {
      for (const JointPassage &passage : text.joint_overrides)
        {
          bool is_used = false;
          for (unsigned int j = 0; j < joints.size(); ++j)
            if (matches_name(passage.joint, joints[j]->name) ||
                (!joints[j]->set.empty() &&
                 matches_name(passage.joint, joints[j]->set)))
              {
                passages[j].push_back(&passage);
                is_used = true;
              }
          AssertThrow(is_used,
                      InputError("The override " + passage.place +
                                 " matches no joint and no set of joints; "
                                 "name one (joints: " +
                                 list_some(set_of_names<dim>(joints)) +
                                 "; sets: " + list_some(sets_of<dim>(joints)) +
                                 ") or use * for all of them."));
        }
    }
  } // namespace



  template <int dim>
  std::vector<std::unique_ptr<Joint<dim>>>
  make_joints(const Scene<dim> &scene,
              const std::vector<std::string> &names,
              const SceneText &text)
  {
    StrengthOfSet strength_of_set;
    for (const auto &set : scene.joint_sets)
      {
        check_name(set->name, "A set of 'Joint sets/Names'");
        strength_of_set[set->name] = set->strength;
      }
    Joints<dim> joints = collect(scene, names, strength_of_set);
    check_names<dim>(joints, strength_of_set);
    Joints<dim> given;
    for (const auto &joint : joints)
      given.push_back(std::make_unique<Joint<dim>>(*joint));
    Passages passages(joints.size());
    JointParser<dim> parser;
    const auto apply = [&](const unsigned int j) {
      *joints[j] = *given[j];
      for (const JointPassage *passage : passages[j])
        parser.parse(*passage, *joints[j]);
      const auto strength = strength_of_set.find(joints[j]->set);
      if (joints[j]->set == given[j]->set ||
          strength == strength_of_set.end() || scene.network.is_resolved)
        return;
      // its entries name a set: they count over those of the set
      *joints[j]                               = *given[j];
      static_cast<JointStrength &>(*joints[j]) = strength->second;
      for (const JointPassage *passage : passages[j])
        parser.parse(*passage, *joints[j]);
    };
    add_subsections<dim>(joints, text, passages);
    for (unsigned int j = 0; j < joints.size(); ++j)
      if (!passages[j].empty())
        apply(j);
    add_overrides<dim>(joints, text, passages);
    for (unsigned int j = 0; j < joints.size(); ++j)
      if (!passages[j].empty() && passages[j].back()->line == 0)
        apply(j);
    for (unsigned int j = 0; j < joints.size(); ++j)
      if (!passages[j].empty())
        settle_plane(*joints[j], passages[j], scene.network.is_resolved);
    check_names<dim>(joints, strength_of_set);
    return joints;
  }



  namespace
  {
    /** Physical groups are written as such, by the first of their facets. */
    template <int dim>
    bool
    is_written(const std::unique_ptr<Joint<dim>> &joint,
               const Joints<dim> &joints)
    {
      return joint->form != JointForm::physical_group ||
             &joint == &joints.front() ||
             (*(&joint - 1))->surface != joint->surface;
    }

    template <int dim>
    std::string
    name_in_file(const Joint<dim> &joint)
    {
      return joint.form == JointForm::physical_group ? joint.surface
                                                     : joint.name;
    }
  } // namespace



  template <int dim>
  void
  note_joints(ParameterHandler &prm,
              const std::vector<std::unique_ptr<Joint<dim>>> &joints)
  {
    std::string names;
    for (const auto &joint : joints)
      if (is_written(joint, joints))
        names += (names.empty() ? "" : ", ") + name_in_file(*joint);
    prm.enter_subsection("Joints");
    prm.set("Names", names);
    prm.set("Resolved", true);
    prm.leave_subsection();
  }



  namespace
  {
    /** The law's name and entries, of the default one where they say more than
     * it does by itself. */
    template <typename Add>
    void
    add_law(const JointStrength &strength, const Add &add)
    {
      const bool is_default = strength.law == joint_law_kinds().front().name;
      if (!is_default)
        add("Law", strength.law);
      for (const JointLawEntry &entry : joint_law_kind(strength.law).entries)
        if (!is_default || strength.value_of(entry.name) != entry.value)
          add(entry.name, exact_text(strength.value_of(entry.name)));
      if (JointStiffness(strength).is_compliant())
        for (const JointLawEntry &entry : stiffness_entries())
          add(entry.name, exact_text(strength.value_of(entry.name)));
    }
  } // namespace



  template <int dim>
  std::string
  print_joints(const std::vector<std::unique_ptr<Joint<dim>>> &joints)
  {
    std::string text;
    const auto add = [&text](const std::string &name,
                             const std::string &value) {
      if (!value.empty())
        text += "    set " + name + " = " + value + "\n";
    };
    const auto add_plane = [&](const Joint<dim> &joint) {
      std::string vertices;
      for (const Point<dim> &vertex : joint.vertices)
        vertices += (vertices.empty() ? "" : "; ") + exact_list(vertex, dim);
      add("Point", exact_list(joint.point, dim));
      add("Normal", exact_list(joint.normal_entry, joint.normal_entry.size()));
      add("Dip", exact_text(joint.dip));
      add("Dip direction", exact_text(joint.dip_direction));
      add("Extent", name_of(joint.extent));
      add("Radius", exact_text(joint.radius));
      add("Vertices", vertices);
      add("Surface", joint.surface);
      add("Piece", joint.piece > 0 ? std::to_string(joint.piece) : "");
    };
    for (const auto &joint : joints)
      {
        if (!is_written(joint, joints))
          continue;
        text += "  subsection " + name_in_file(*joint) + "\n";
        if (joint->form == JointForm::plane)
          add_plane(*joint);
        else
          add("Shape", name_of(joint->form));
        add("Group", joint->group);
        add("Friction angle", exact_text(joint->friction_angle));
        add("Kinetic friction angle",
            exact_text(joint->kinetic_friction_angle));
        add("Cohesion", exact_text(joint->cohesion));
        add("Tensile strength", exact_text(joint->tensile_strength));
        add("Residual cohesion", exact_text(joint->residual_cohesion));
        add_law(*joint, add);
        add("Water pressure", joint->water_pressure);
        add("Water level", joint->water_level);
        add("Set", joint->set);
        text += "  end\n";
      }
    return text;
  }

  template Joints<2> make_joints(const Scene<2> &,
                                 const std::vector<std::string> &,
                                 const SceneText &);
  template Joints<3> make_joints(const Scene<3> &,
                                 const std::vector<std::string> &,
                                 const SceneText &);
  template void note_joints(ParameterHandler &, const Joints<2> &);
  template void note_joints(ParameterHandler &, const Joints<3> &);
  template std::string print_joints(const Joints<2> &);
  template std::string print_joints(const Joints<3> &);
} // namespace Keyblock
