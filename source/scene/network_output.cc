// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/bounding_box.h>

#include <keyblock/base/errors.h>
#include <keyblock/base/number_text.h>
#include <keyblock/base/vtu_file.h>
#include <keyblock/law/joint_stiffness.h>
#include <keyblock/scene/domain_outline.h>
#include <keyblock/scene/network_output.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <set>

namespace Keyblock
{
  namespace
  {
    void
    check_written(const bool is_written, const std::string &file_name)
    {
      AssertThrow(is_written,
                  InputError("The file '" + file_name +
                             "' cannot be written; check free space and "
                             "permissions."));
    }

    /** A field of a table, quoted if it must be. */
    std::string
    field(const std::string &text)
    {
      if (text.find_first_of(",;\"#\t") == std::string::npos)
        return text;
      std::string quoted = "\"";
      for (const char letter : text)
        quoted += letter == '"' ? std::string("\"\"") : std::string(1, letter);
      return quoted + '"';
    }

    /** Where the joint is: the columns from extent to vertices. */
    template <int dim>
    std::string
    geometry_fields(const Joint<dim> &joint,
                    const Point<dim> &origin,
                    const bool has_normals)
    {
      const std::string no_vector(dim - 1, ',');
      std::string text = name_of(joint.extent) + ",";
      if (joint.extent == JointShape::polygon)
        {
          std::string corners;
          for (const Point<dim> &vertex : joint.vertices)
            corners += (corners.empty() ? "" : "; ") +
                       exact_list(Point<dim>(vertex + origin), dim);
          return text + no_vector + ",,," +
                 (has_normals ? no_vector + "," : "") + "," + field(corners);
        }
      text += exact_list(Point<dim>(joint.point + origin), dim, ",") + ",";
      const bool has_normal = !joint.normal_entry.empty();
      text += has_normal
                ? ","
                : exact_text(joint.dip) + "," + exact_text(joint.dip_direction);
      if (has_normals)
        text += "," + (has_normal ? exact_list(joint.normal_entry, dim, ",")
                                  : no_vector);
      return text + "," +
             (joint.extent == JointShape::disc ? exact_text(joint.radius)
                                               : "") +
             ",";
    }

    /** Corners of what is drawn of a joint, in 2D two ends. */
    template <int dim>
    std::vector<Point<dim>>
    corners_of(const Joint<dim> &joint, const DomainOutline<dim> &box)
    {
      if (joint.extent == JointShape::polygon)
        return joint.vertices;
      if (joint.extent == JointShape::infinite)
        return box.cut(joint);
      const Tensor<1, dim> n = joint.normal();
      std::vector<Point<dim>> corners;
      if constexpr (dim == 2)
        {
          Tensor<1, dim> half;
          half[0] = -joint.radius * n[1];
          half[1] = joint.radius * n[0];
          corners = {joint.point - half, joint.point + half};
        }
      else
        {
          Tensor<1, dim> axis;
          axis[std::abs(n[2]) < 0.9 ? 2 : 0] = 1.;
          Tensor<1, dim> a                   = cross_product_3d(n, axis);
          a *= joint.radius / a.norm();
          const Tensor<1, dim> b = cross_product_3d(n, a);
          for (unsigned int i = 0; i < 32; ++i)
            {
              const double angle = dealii::numbers::PI * i / 16.;
              corners.push_back(joint.point + std::cos(angle) * a +
                                std::sin(angle) * b);
            }
        }
      return corners;
    }

    template <int dim>
    double
    dip_of(const Joint<dim> &joint)
    {
      const Tensor<1, dim> n = joint.normal();
      return std::acos(std::min(1., n[dim - 1])) * 180. / dealii::numbers::PI;
    }

    template <int dim>
    double
    dip_direction_of(const Joint<dim> &joint)
    {
      const Tensor<1, dim> n = joint.normal();
      const double azimuth =
        std::atan2(n[0], dim == 3 ? n[1] : 0.) * 180. / dealii::numbers::PI;
      return azimuth < 0. ? azimuth + 360. : azimuth;
    }

    /** Columns of the joints' laws. */
    struct LawColumns
    {
      bool has_names = false;            ///< some joint chose a law
      std::vector<unsigned int> entries; ///< into joint_law_entries()
    };

    /** Those of the entries that the joints' laws use; of the default law only
     * what some joint gives. */
    template <int dim>
    LawColumns
    list_law_columns(const Scene<dim> &scene)
    {
      const std::string &by_default = joint_law_kinds().front().name;
      std::set<unsigned int> used;
      LawColumns columns;
      for (const auto &joint : scene.joints)
        {
          const bool is_chosen = joint->law != by_default;
          columns.has_names    = columns.has_names || is_chosen;
          for (unsigned int i = 0; i < joint_law_entries().size(); ++i)
            for (const JointLawEntry &entry :
                 joint_law_kind(joint->law).entries)
              if (entry.name == joint_law_entries()[i].name &&
                  (is_chosen || joint->law_values[i] != entry.value))
                used.insert(i);
        }
      columns.entries.assign(used.begin(), used.end());
      return columns;
    }

    std::string
    law_titles(const LawColumns &columns)
    {
      std::string titles = columns.has_names ? ",law" : "";
      for (const unsigned int i : columns.entries)
        {
          const JointLawEntry &entry = joint_law_entries()[i];
          titles += "," + entry.name +
                    (entry.unit.empty() ? "" : " (" + entry.unit + ")");
        }
      return titles;
    }

    std::string
    law_fields(const JointStrength &strength, const LawColumns &columns)
    {
      std::string fields = columns.has_names ? "," + strength.law : "";
      for (const unsigned int i : columns.entries)
        fields += "," + exact_text(strength.law_values[i]);
      return fields;
    }

    /** Titles of the columns of stiffness. */
    std::string
    stiffness_titles()
    {
      std::string titles;
      for (const JointLawEntry &entry : stiffness_entries())
        titles += "," + entry.name + " (" + entry.unit + ")";
      return titles;
    }

    std::string
    stiffness_fields(const JointStrength &strength)
    {
      std::string fields;
      for (const JointLawEntry &entry : stiffness_entries())
        fields += "," + exact_text(strength.value_of(entry.name));
      return fields;
    }
  } // namespace



  template <int dim>
  void
  write_joint_table(const std::string &file_name, const Scene<dim> &scene)
  {
    const bool has_normals =
      std::any_of(scene.joints.begin(),
                  scene.joints.end(),
                  [](const auto &joint) {
                    return joint->extent != JointShape::polygon &&
                           !joint->normal_entry.empty();
                  });
    const std::string axes = dim == 2 ? "x (m),y (m)," : "x (m),y (m),z (m),";
    const std::string normals =
      dim == 2 ? "normal x,normal y," : "normal x,normal y,normal z,";
    const LawColumns laws   = list_law_columns(scene);
    const bool is_compliant = are_any_compliant(scene.joints);
    std::ofstream out(file_name);
    out << "name,set,extent," << axes << "dip (deg),dip direction (deg),"
        << (has_normals ? normals : "")
        << "radius (m),vertices (m),friction angle (deg),"
           "kinetic friction angle (deg),cohesion (Pa),tensile strength (Pa),"
           "residual cohesion (Pa),water pressure (Pa)"
        << law_titles(laws) << (is_compliant ? stiffness_titles() : "") << '\n';
    const auto water = [&](const auto &joint) -> std::string {
      if (joint->water_level.empty())
        return joint->water_pressure;
      return joint->water_level == no_water
               ? "0"
               : scene.water_pressure(&joint - scene.joints.data(), 1);
    };
    for (const auto &joint : scene.joints)
      out << field(joint->name) << ',' << field(joint->set) << ','
          << geometry_fields(*joint, scene.domain.origin, has_normals) << ','
          << exact_text(joint->friction_angle) << ','
          << exact_text(joint->kinetic_friction_angle) << ','
          << exact_text(joint->cohesion) << ','
          << exact_text(joint->tensile_strength) << ','
          << exact_text(joint->residual_cohesion) << ',' << field(water(joint))
          << law_fields(*joint, laws)
          << (is_compliant ? stiffness_fields(*joint) : "") << '\n';
    check_written(bool(out.flush()), file_name);
  }



  template <int dim>
  void
  write_joint_planes(const std::string &file_name,
                     const Scene<dim> &scene,
                     const std::vector<Point<dim>> &vertices)
  {
    const dealii::BoundingBox<dim> around(vertices);
    const auto &[lower, upper] = around.get_boundary_points();
    const DomainOutline<dim> box(lower, upper);
    const JointSetNumbers sets = number_joint_sets(scene);
    VtuGrid planes;
    planes.texts   = {{"joint names", names_of(scene.joints)},
                      {"joint set names", sets.names}};
    VtuArray index = VtuArray::ids("joint"), set = VtuArray::ids("joint set"),
             dip       = VtuArray::scalar("dip (deg)"),
             direction = VtuArray::scalar("dip direction (deg)"),
             friction  = VtuArray::scalar("friction angle (deg)");
    for (unsigned int j = 0; j < scene.joints.size(); ++j)
      {
        const Joint<dim> &joint = *scene.joints[j];
        std::vector<unsigned int> corners;
        for (const Point<dim> &corner : corners_of(joint, box))
          corners.push_back(planes.add_point(corner, dim));
        if (corners.empty())
          continue;
        planes.add_cell(dim == 2 ? VtuCell::line : VtuCell::polygon, corners);
        index.add_id(j);
        set.add_id(sets.of_joint[j]);
        dip.add(dip_of(joint));
        direction.add(dip_direction_of(joint));
        friction.add(joint.friction_angle);
      }
    planes.cell_data = {index, set, dip, direction, friction};
    planes.is_far    = are_far(planes.points);
    check_written(write_vtu(planes, file_name), file_name);
  }



  template <int dim>
  JointSetNumbers
  number_joint_sets(const Scene<dim> &scene)
  {
    JointSetNumbers sets;
    std::map<std::string, unsigned int> known = {{"", 0}};
    sets.names                                = {"none"};
    for (const auto &joint : scene.joints)
      {
        const auto [found, is_new] =
          known.emplace(joint->set, sets.names.size());
        if (is_new)
          sets.names.push_back(joint->set);
        sets.of_joint.push_back(found->second);
      }
    return sets;
  }

  template JointSetNumbers number_joint_sets(const Scene<2> &);
  template JointSetNumbers number_joint_sets(const Scene<3> &);
  template void write_joint_table(const std::string &, const Scene<2> &);
  template void write_joint_table(const std::string &, const Scene<3> &);
  template void write_joint_planes(const std::string &,
                                   const Scene<2> &,
                                   const std::vector<Point<2>> &);
  template void write_joint_planes(const std::string &,
                                   const Scene<3> &,
                                   const std::vector<Point<3>> &);
} // namespace Keyblock
