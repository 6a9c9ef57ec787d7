// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/scene/scene.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/parameter_handler.h>

#include <keyblock/base/errors.h>
#include <keyblock/base/number_text.h>
#include <keyblock/scene/check_parts.h>
#include <keyblock/scene/dropped_names.h>
#include <keyblock/scene/idle_entries.h>
#include <keyblock/scene/joint_facets.h>
#include <keyblock/scene/joint_sets.h>
#include <keyblock/scene/joint_table.h>
#include <keyblock/scene/joints.h>
#include <keyblock/scene/polygon.h>
#include <keyblock/scene/shape_files.h>
#include <keyblock/scene/stage_defaults.h>
#include <keyblock/scene/study_entries.h>
#include <keyblock/scene/text.h>
#include <keyblock/scene/unit_warnings.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

namespace Keyblock
{
  namespace
  {
    const std::vector<std::string> list_sections = {"Excavations",
                                                    "Joints",
                                                    "Joint sets",
                                                    "Materials",
                                                    "Supports",
                                                    "Bolts",
                                                    "Shotcrete",
                                                    "Tractions",
                                                    "Stages",
                                                    "Monitors",
                                                    "Study"};

    void
    declare_names(ParameterHandler &prm)
    {
      for (const std::string &section : list_sections)
        {
          prm.enter_subsection(section);
          const bool is_ground = section == "Materials";
          prm.declare_entry("Names",
                            is_ground ? default_materials : "",
                            dealii::Patterns::Anything(),
                            std::string("Names, separated by commas; each has "
                                        "a subsection of that name") +
                              (is_ground ? ", where its entries are not all "
                                           "the defaults."
                                         : "."));
          prm.leave_subsection();
        }
    }

    std::vector<std::string>
    read_names(ParameterHandler &prm, const std::string &section)
    {
      prm.enter_subsection(section);
      std::vector<std::string> names =
        dealii::Utilities::split_string_list(prm.get("Names"));
      prm.leave_subsection();
      std::set<std::string> seen;
      for (const std::string &name : names)
        AssertThrow(seen.insert(name).second,
                    InputError("The name '" + name + "' stands twice in '" +
                               section + "/Names'; give each its own name."));
      return names;
    }

    template <typename Item>
    void
    make_items(std::vector<std::unique_ptr<Item>> &items,
               const std::vector<std::string> &names)
    {
      items.clear();
      for (const std::string &name : names)
        {
          items.push_back(std::make_unique<Item>());
          items.back()->name = name;
        }
    }

    template <typename Item>
    void
    declare_items(ParameterHandler &prm,
                  const std::string &section,
                  std::vector<std::unique_ptr<Item>> &items)
    {
      prm.enter_subsection(section);
      for (const auto &item : items)
        {
          prm.enter_subsection(item->name);
          item->declare(prm);
          prm.leave_subsection();
        }
      prm.leave_subsection();
    }

    template <typename Item>
    void
    declare_section(ParameterHandler &prm,
                    const std::string &section,
                    Item &item)
    {
      prm.enter_subsection(section);
      item.declare(prm);
      prm.leave_subsection();
    }
  } // namespace



  template <int dim>
  unsigned int
  Scene<dim>::stage_number(const std::string &name) const
  {
    if (name == "start")
      return 1;
    unsigned int index = 0;
    while (index < stages.size() && stages[index]->name != name)
      ++index;
    return index + 2;
  }



  template <int dim>
  unsigned int
  Scene<dim>::history_stage(const Support<dim> &support) const
  {
    if (!support.history_stage.empty())
      return stage_number(support.history_stage);
    unsigned int number = std::max(2u, stage_number(support.stage));
    while (number < stages.size() + 2 && !stages[number - 2]->is_dynamic())
      ++number;
    return number;
  }



  template <int dim>
  bool
  Scene<dim>::has_stage_to_balance() const
  {
    return std::any_of(stages.begin(), stages.end(), [](const auto &stage) {
      return !stage->is_dynamic();
    });
  }



  template <int dim>
  bool
  Scene<dim>::has_dynamic_stage() const
  {
    return std::any_of(stages.begin(), stages.end(), [](const auto &stage) {
      return stage->is_dynamic();
    });
  }



  template <int dim>
  unsigned int
  Scene<dim>::material_index(const std::string &name) const
  {
    unsigned int index = 0;
    while (index < materials.size() && materials[index]->name != name)
      ++index;
    return index;
  }



  template <int dim>
  std::vector<unsigned int>
  Scene<dim>::joints_called(const std::string &name) const
  {
    std::vector<unsigned int> found;
    for (unsigned int j = 0; j < joints.size(); ++j)
      if (joints[j]->name == name || joints[j]->set == name ||
          joints[j]->surface == name)
        found.push_back(j);
    return found;
  }



  template <int dim>
  void
  Scene<dim>::declare(ParameterHandler &prm)
  {
    prm.declare_entry(
      "Dimension",
      "2",
      dealii::Patterns::Integer(2, 3),
      "Number of dimensions: 2 (plane strain, unit thickness) or 3.");
    prm.add_parameter("Title",
                      title,
                      "Title of the scene, one line for readers.");
    declare_section(prm, "Domain", domain);
    declare_section(prm, "Mesh", meshing);
    declare_section(prm, "Initial state", initial_state);
    declare_section(prm, "Ground", ground);
    declare_section(prm, "Water", water);
    declare_section(prm, "Contact", contact);
    declare_section(prm, "Time stepping", time_stepping);
    declare_section(prm, "Safety factor", safety);
    declare_section(prm, "Block theory", block_theory);
    declare_section(prm, "Check", checks);
    declare_section(prm, "Output", output);
    declare_section(prm, "Study", study);
    declare_names(prm);
    declare_items(prm, "Excavations", excavations);
    declare_section(prm, "Joints", network);
    declare_items(prm, "Joints", joints);
    declare_items(prm, "Joint sets", joint_sets);
    declare_items(prm, "Materials", materials);
    declare_items(prm, "Supports", supports);
    declare_items(prm, "Bolts", bolts);
    declare_items(prm, "Shotcrete", liners);
    declare_items(prm, "Tractions", tractions);
    declare_items(prm, "Stages", stages);
    declare_items(prm, "Monitors", monitors);
    declare_items(prm, "Study", study_variables);
  }



  template <int dim>
  void
  Scene<dim>::read(const Communicator &communicator,
                   const std::string &file_name,
                   const std::vector<std::string> &overrides)
  {
    file = file_name;
    source =
      std::make_shared<const SceneText>(communicator, file_name, overrides);
    const SceneText &text = *source;
    old_names             = text.warnings;
    ParameterHandler names;
    declare_names(names);
    text.parse(names, true);
    make_items(excavations, read_names(names, "Excavations"));
    make_items(joint_sets, read_names(names, "Joint sets"));
    make_items(materials, read_names(names, "Materials"));
    make_items(supports, read_names(names, "Supports"));
    make_items(bolts, read_names(names, "Bolts"));
    make_items(liners, read_names(names, "Shotcrete"));
    make_items(tractions, read_names(names, "Tractions"));
    make_items(stages, read_names(names, "Stages"));
    make_items(monitors, read_names(names, "Monitors"));
    make_items(study_variables, read_names(names, "Study"));
    joints.clear();
    prm = std::make_shared<ParameterHandler>();
    declare(*prm);
    text.parse(*prm, false);
    if (network.is_resolved)
      refuse_idle_overrides(text, ground.is_given());
    is_resolved = network.is_resolved;
    refuse_idle_entries(*prm, *this, text);
    tidy_corners(domain.polygon, "Domain/Polygon");
    for (const auto &one : excavations)
      tidy_corners(one->vertices, "Excavations/" + one->name + "/Vertices");
    make_profiles();
    complete_ground(text);
    check_domain(*this);
    read_shape_files(communicator, *this);
    joint_names = read_names(names, "Joints");
    make_joints_of_sources();
    for (const auto &warnings : {warnings_of_table(*this, text),
                                 warnings_of_sets(*this),
                                 warnings_of_drawings(*this),
                                 warnings_of_default_rock(*this, text),
                                 warnings_of_nested_solids(*this)})
      old_names.insert(old_names.end(), warnings.begin(), warnings.end());
    make_facets(communicator, *this);
    for (const auto &variable : study_variables)
      check_study_variable(*variable);
    // before joints count as all written out
    check_study_entries(*this);
    note_joints(*prm, joints);
    for (const auto &stage : stages)
      stage->complete();
    damp_beside_rigid_bodies(*this);
    leave_steps_out(*this);
    read_histories();
    cross_check();
  }



  template <int dim>
  void
  Scene<dim>::make_joints_of_sources()
  {
    joints = make_joints(*this, joint_names, *source);
    for (const auto &joint : joints)
      if (dim == 3 && joint->extent == JointShape::polygon)
        tidy_corners(joint->vertices, "Joints/" + joint->name + "/Vertices");
  }



  template <int dim>
  void
  Scene<dim>::redraw(const Communicator &communicator,
                     const std::vector<std::string> &overrides)
  {
    for (const std::string &assignment : overrides)
      {
        const auto parts = dealii::Utilities::split_string_list(
          assignment.substr(0, assignment.find('=')), '/');
        const std::string value = assignment.substr(assignment.find('=') + 1);
        for (const auto &set : joint_sets)
          if (matches_name(parts.at(1), set->name))
            parse_entries(*prm,
                          "subsection Joint sets\nsubsection " + set->name +
                            "\nset " + parts.at(2) + " = " + value +
                            "\nend\nend\n",
                          "",
                          "the override '" + assignment + "'");
      }
    network.is_resolved = is_resolved;
    make_joints_of_sources();
    make_facets(communicator, *this);
    cross_check();
  }



  unsigned int
  read_dimension(const Communicator &communicator,
                 const std::string &file_name,
                 const std::vector<std::string> &overrides)
  {
    ParameterHandler prm;
    prm.declare_entry("Dimension", "2", dealii::Patterns::Integer(2, 3));
    SceneText(communicator, file_name, overrides).parse(prm, true);
    return prm.get_integer("Dimension");
  }



  void
  print_parameters(std::ostream &out)
  {
    Scene<3> scene;
    make_items(scene.excavations, {"NAME"});
    make_items(scene.joints, {"NAME"});
    make_items(scene.joint_sets, {"NAME"});
    make_items(scene.materials, {"NAME"});
    make_items(scene.supports, {"NAME"});
    make_items(scene.bolts, {"NAME"});
    make_items(scene.liners, {"NAME"});
    make_items(scene.tractions, {"NAME"});
    make_items(scene.stages, {"NAME"});
    make_items(scene.monitors, {"NAME"});
    make_items(scene.study_variables, {"NAME"});
    ParameterHandler prm;
    scene.declare(prm);

    std::ostringstream json;
    prm.print_parameters(json, ParameterHandler::JSON);
    std::ostringstream text;
    prm.print_parameters(text,
                         ParameterHandler::Text |
                           ParameterHandler::KeepDeclarationOrder);
    out << "# Entries of a scene file\n\n"
           "Written by `keyblock --print-parameters`; do not edit. Defaults "
           "are those of a 3D scene; vectors have two components in 2D. "
           "`NAME` stands for each name listed in the section's `Names`. "
           "Units are SI: metres, seconds, kilograms, pascals; angles are in "
           "degrees; stress is tension positive.\n\n```prm\n"
        << text.str() << "```\n";
  }

  template struct Scene<2>;
  template struct Scene<3>;
} // namespace Keyblock
