// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/scene/scene.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/parameter_handler.h>

#include <keyblock/base/errors.h>
#include <keyblock/scene/check.h>
#include <keyblock/scene/joints.h>
#include <keyblock/scene/text.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
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
                                                    "Tractions",
                                                    "Stages",
                                                    "Monitors"};

    void
    declare_names(ParameterHandler &prm)
    {
      for (const std::string &section : list_sections)
        {
          prm.enter_subsection(section);
          prm.declare_entry("Names",
                            "",
                            dealii::Patterns::Anything(),
                            "Names, separated by commas; each has a subsection "
                            "of that name.");
          prm.leave_subsection();
        }
    }

    std::vector<std::string>
    read_names(ParameterHandler &prm, const std::string &section)
    {
      prm.enter_subsection(section);
      const std::vector<std::string> names =
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

    double
    radians(const double degrees)
    {
      return degrees * dealii::numbers::PI / 180.;
    }
  } // namespace



  template <int dim>
  Tensor<1, dim>
  Joint<dim>::normal() const
  {
    Tensor<1, dim> n;
    if (!normal_entry.empty())
      for (unsigned int d = 0; d < dim; ++d)
        n[d] = normal_entry[d];
    else if (extent == JointShape::polygon && dim == 2)
      {
        const Tensor<1, dim> along = vertices[1] - vertices[0];
        n[0]                       = -along[1];
        n[1]                       = along[0];
      }
    else if (extent == JointShape::polygon)
      {
        const Tensor<1, dim> a = vertices[1] - vertices[0];
        for (unsigned int i = 2; i < vertices.size(); ++i)
          {
            const Tensor<1, dim> b = vertices[i] - vertices[0];
            for (unsigned int d = 0; d < dim; ++d)
              n[d] += a[(d + 1) % dim] * b[(d + 2) % dim] -
                      a[(d + 2) % dim] * b[(d + 1) % dim];
            if (n.norm() > 0.)
              break;
          }
      }
    else
      {
        const double sine = std::sin(radians(dip));
        n[0]              = sine * std::sin(radians(dip_direction));
        if (dim == 3)
          n[1] = sine * std::cos(radians(dip_direction));
        n[dim - 1] = std::cos(radians(dip));
      }
    if (!std::isnormal(n.norm_square()))
      {
        // squares of components are too large, or too small
        double largest = 0.;
        for (unsigned int d = 0; d < dim; ++d)
          largest = std::max(largest, std::abs(n[d]));
        n /= largest;
      }
    n /= n.norm();
    // minus to plus is upwards; a vertical joint's normal points to +x or +y
    for (int d = dim - 1; d >= 0; --d)
      {
        const int axis = (d == dim - 1) ? dim - 1 : (dim - 2 - d);
        if (std::abs(n[axis]) > 1e-12)
          return n[axis] > 0. ? n : -n;
      }
    return n;
  }



  template <int dim>
  double
  Joint<dim>::distance(const Point<dim> &p) const
  {
    const Point<dim> &origin =
      (extent == JointShape::polygon) ? vertices[0] : point;
    return normal() * (p - origin);
  }



  template <int dim>
  bool
  Joint<dim>::is_within_extent(const Point<dim> &p,
                               const double tolerance) const
  {
    if (extent == JointShape::infinite)
      return true;
    if (extent == JointShape::disc)
      return p.distance(point) <= radius + tolerance;
    if (dim == 2)
      {
        const Tensor<1, dim> along = vertices[1] - vertices[0];
        const double length        = along.norm();
        const double s             = (p - vertices[0]) * along / length;
        return s >= -tolerance && s <= length + tolerance;
      }
    // a polygon in 3D, by winding about the normal; convex or not
    const Tensor<1, dim> n    = normal();
    double angle              = 0.;
    const unsigned int n_size = vertices.size();
    for (unsigned int i = 0; i < n_size; ++i)
      {
        Tensor<1, dim> a = vertices[i] - p;
        Tensor<1, dim> b = vertices[(i + 1) % n_size] - p;
        const auto edge  = b - a;
        const double s   = std::clamp(-(a * edge) / (edge * edge), 0., 1.);
        if ((a + s * edge).norm() <= tolerance)
          return true;
        double sine = 0.;
        for (unsigned int d = 0; d < dim; ++d)
          sine += n[d] * (a[(d + 1) % dim] * b[(d + 2) % dim] -
                          a[(d + 2) % dim] * b[(d + 1) % dim]);
        angle += std::atan2(sine, a * b);
      }
    return std::abs(angle) > dealii::numbers::PI;
  }



  template <int dim>
  bool
  Support<dim>::names_axis(const unsigned int d) const
  {
    using D = SupportDirections;
    switch (directions)
      {
        case D::x:
          return d == 0;
        case D::y:
          return d == 1;
        case D::z:
          return d == 2;
        case D::xy:
          return d != 2;
        case D::xz:
          return d != 1;
        case D::yz:
          return d != 0;
        default:
          return false;
      }
  }



  void
  Stage::complete()
  {
    if (!is_quasi_static())
      return;
    if (local_damping == 0.)
      local_damping = 0.8;
    if (unbalanced_ratio == 0.)
      unbalanced_ratio = 1e-5;
    if (maximum_steps == 0)
      maximum_steps = 200000;
  }



  bool
  SafetySettings::wants_block(const unsigned int id) const
  {
    if (blocks == "none" || blocks == "all")
      return blocks == "all";
    for (const std::string &word : dealii::Utilities::split_string_list(blocks))
      if (word == std::to_string(id))
        return true;
    return false;
  }



  bool
  SafetySettings::wants_stage(const std::string &name) const
  {
    return is_wanted() &&
           (stages.empty() ||
            std::find(stages.begin(), stages.end(), name) != stages.end());
  }



  template <int dim>
  double
  Material<dim>::apex() const
  {
    return friction_angle > 0. ? cohesion / std::tan(radians(friction_angle))
                               : std::numeric_limits<double>::infinity();
  }



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
      if (joints[j]->name == name || joints[j]->set == name)
        found.push_back(j);
    return found;
  }



  template <int dim>
  std::vector<std::string>
  Scene<dim>::warnings() const
  {
    std::vector<std::string> found = old_names;
    for (const auto &material : materials)
      if (material->is_plastic() &&
          material->tensile_strength > material->apex())
        {
          std::ostringstream text;
          text << "The entry 'Materials/" << material->name
               << "/Tensile strength' is " << material->tensile_strength
               << " Pa, beyond the apex of cohesion and friction at "
               << material->apex() << " Pa, so that it never acts.";
          found.push_back(text.str());
        }
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
    declare_section(prm, "Contact", contact);
    declare_section(prm, "Time stepping", time_stepping);
    declare_section(prm, "Safety factor", safety);
    declare_section(prm, "Block theory", block_theory);
    declare_section(prm, "Check", checks);
    declare_section(prm, "Output", output);
    declare_names(prm);
    declare_items(prm, "Excavations", excavations);
    declare_section(prm, "Joints", network);
    declare_items(prm, "Joints", joints);
    declare_items(prm, "Joint sets", joint_sets);
    declare_items(prm, "Materials", materials);
    declare_items(prm, "Supports", supports);
    declare_items(prm, "Bolts", bolts);
    declare_items(prm, "Tractions", tractions);
    declare_items(prm, "Stages", stages);
    declare_items(prm, "Monitors", monitors);
  }



  template <int dim>
  void
  Scene<dim>::read(const Communicator &communicator,
                   const std::string &file_name,
                   const std::vector<std::string> &overrides)
  {
    file = file_name;
    const SceneText text(communicator, file_name, overrides);
    old_names = text.warnings;
    ParameterHandler names;
    declare_names(names);
    text.parse(names, true);
    make_items(excavations, read_names(names, "Excavations"));
    make_items(joint_sets, read_names(names, "Joint sets"));
    make_items(materials, read_names(names, "Materials"));
    make_items(supports, read_names(names, "Supports"));
    make_items(bolts, read_names(names, "Bolts"));
    make_items(tractions, read_names(names, "Tractions"));
    make_items(stages, read_names(names, "Stages"));
    make_items(monitors, read_names(names, "Monitors"));
    joints.clear();
    prm = std::make_shared<ParameterHandler>();
    declare(*prm);
    text.parse(*prm, false);
    check_domain(*this);
    joints = make_joints(*this, read_names(names, "Joints"), text);
    note_joints(*prm, joints);
    for (const auto &stage : stages)
      stage->complete();
    cross_check();
  }



  template <int dim>
  std::string
  Scene<dim>::print_entries(const bool has_descriptions) const
  {
    std::ostringstream out;
    prm->print_parameters(out,
                          (has_descriptions ? ParameterHandler::Text
                                            : ParameterHandler::ShortPRM) |
                            ParameterHandler::KeepDeclarationOrder);
    std::string text         = out.str();
    const std::string header = "subsection Joints\n";
    const auto section       = text.compare(0, header.size(), header) == 0
                                 ? 0
                                 : text.find("\n" + header);
    text.insert(text.find("\nend", section) + 1, print_joints(joints));
    return text;
  }



  template <int dim>
  void
  Scene<dim>::write_used(const std::string &file_name) const
  {
    std::ofstream out(file_name);
    out << print_entries(true);
    AssertThrow(out.flush(),
                InputError("The file '" + file_name +
                           "' cannot be written; check free space and "
                           "permissions."));
  }



  template <int dim>
  std::string
  Scene<dim>::used_entries() const
  {
    return print_entries(false);
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
    make_items(scene.tractions, {"NAME"});
    make_items(scene.stages, {"NAME"});
    make_items(scene.monitors, {"NAME"});
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

  template struct Joint<2>;
  template struct Joint<3>;
  template bool Support<2>::names_axis(const unsigned int) const;
  template bool Support<3>::names_axis(const unsigned int) const;
  template struct Scene<2>;
  template struct Scene<3>;
} // namespace Keyblock
