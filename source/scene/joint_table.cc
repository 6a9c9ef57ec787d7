// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/numbers.h>

#include <keyblock/base/errors.h>
#include <keyblock/base/number_text.h>
#include <keyblock/law/joint_law.h>
#include <keyblock/scene/joint_columns.h>
#include <keyblock/scene/joint_table.h>
#include <keyblock/scene/row_reader.h>

#include <boost/algorithm/string.hpp>
#include <boost/algorithm/string/trim_all.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace Keyblock
{
  namespace
  {
    /** Azimuth between 0 and 360 degrees. */
    double
    wrapped(const double azimuth)
    {
      return azimuth >= 360. ? azimuth - 360. : azimuth;
    }

    double
    dip_in(const RowReader &row, const C column)
    {
      const double angle = row.number_in(column, 0., 90., "degrees");
      return column == C::plunge ? 90. - angle : angle;
    }

    double
    dip_direction_in(const RowReader &row, const C column)
    {
      const double angle = row.number_in(column, 0., 360., "degrees");
      return column == C::dip_direction
               ? angle
               : wrapped(angle + (column == C::strike ? 90. : 180.));
    }

    /** Refuse a row whose dip, or pole, is not that of its normal. */
    template <int dim>
    void
    check_against_normal(const RowReader &row, const Joint<dim> &joint)
    {
      constexpr double tolerance = 1.; // [deg]
      const double degrees       = 180. / dealii::numbers::PI;
      const Tensor<1, dim> n     = joint.normal();
      // what the row leaves open is as the normal has it
      Joint<dim> other = joint;
      other.normal_entry.clear();
      other.dip = std::acos(std::min(1., std::abs(n[dim - 1]))) * degrees;
      other.dip_direction = std::atan2(n[0], dim == 3 ? n[1] : 0.) * degrees;
      C rival             = C::name;
      for (const C column : {C::dip, C::plunge})
        if (row.has(column))
          {
            rival     = column;
            other.dip = dip_in(row, column);
          }
      for (const C column : {C::dip_direction, C::strike, C::trend})
        if (row.has(column))
          {
            rival               = rival == C::name ? column : rival;
            other.dip_direction = dip_direction_in(row, column);
          }
      const double cosine = std::min(1., std::abs(n * other.normal()));
      const double angle  = std::acos(cosine) * degrees;
      row.require(rival == C::name || !(angle > tolerance),
                  rival,
                  "it turns the joint " + text_of(angle, 3) +
                    " degrees away from the normal in the same row; leave one "
                    "of them out.");
    }

    template <int dim>
    void
    read_orientation(const RowReader &row, Joint<dim> &joint)
    {
      const std::array<C, 3> normal = {{C::normal_x, C::normal_y, C::normal_z}};
      if (row.has(normal[0]) || row.has(normal[1]) || row.has(normal[2]))
        {
          for (unsigned int d = 0; d < dim; ++d)
            joint.normal_entry.push_back(row.number(normal[d]));
          check_against_normal(row, joint);
          return;
        }
      const bool is_pole =
        row.columns.count(C::plunge) || row.columns.count(C::trend);
      joint.dip = dip_in(row, is_pole ? C::plunge : C::dip);
      joint.dip_direction =
        dip_direction_in(row,
                         is_pole                        ? C::trend
                         : row.columns.count(C::strike) ? C::strike
                                                        : C::dip_direction);
    }

    /** The coordinates in "x, y, z" or "x y z". */
    template <int dim>
    Point<dim>
    read_vertex(const RowReader &row, const std::string &text)
    {
      // a comma parts coordinates unless blanks do and it is a decimal one
      std::vector<std::string> words;
      boost::split(words, text, boost::is_space(), boost::token_compress_on);
      const bool has_commas =
        words.size() == 1 ||
        std::any_of(words.begin(), words.end(), [](const std::string &word) {
          return word.back() == ',' || word.front() == ',';
        });
      if (has_commas)
        {
          boost::split(words, text, boost::is_any_of(","));
          for (std::string &word : words)
            boost::trim(word);
        }
      Point<dim> vertex;
      bool is_point = words.size() == dim;
      for (unsigned int d = 0; d < dim && is_point; ++d)
        is_point = read_number(words[d],
                               row.table.has_decimal_comma() && !has_commas,
                               vertex[d]);
      row.require(is_point,
                  C::vertices,
                  "'" + text + "' is not a point of " + std::to_string(dim) +
                    " coordinates; write \"x, y" + (dim == 3 ? ", z" : "") +
                    "; x, y" + (dim == 3 ? ", z" : "") + "; ...\" in quotes.");
      for (unsigned int d = 0; d < dim; ++d)
        vertex[d] *= row.columns.at(C::vertices).unit;
      return vertex;
    }

    template <int dim>
    void
    read_polygon(const RowReader &row,
                 const Point<dim> &origin,
                 Joint<dim> &joint)
    {
      if (dim == 2 && !row.has(C::vertices))
        {
          const std::array<C, 4> ends = {{C::x1, C::y1, C::x2, C::y2}};
          joint.vertices.resize(2);
          for (unsigned int i = 0; i < 4; ++i)
            joint.vertices[i / 2][i % 2] = row.number(ends[i]) - origin[i % 2];
          return;
        }
      row.require(row.has(C::vertices),
                  C::vertices,
                  "the extent is polygon, but there are no corners; give "
                  "them.");
      std::vector<std::string> corners;
      boost::split(corners, row.text(C::vertices), boost::is_any_of(";"));
      for (std::string &corner : corners)
        {
          boost::trim(corner);
          joint.vertices.push_back(
            Point<dim>(read_vertex<dim>(row, corner) - origin));
        }
    }

    /** What the row says about the extent, in words or by what it gives. */
    JointShape
    find_extent(const RowReader &row)
    {
      const std::string words = boost::to_lower_copy(row.text(C::extent));
      const auto shape        = choice_called<JointShape>(words);
      row.require(words.empty() || shape,
                  C::extent,
                  "'" + row.text(C::extent) +
                    "' is no extent; give infinite, disc or polygon.");
      if (shape)
        return *shape;
      if (row.has(C::vertices) || row.has(C::x1) || row.has(C::y1) ||
          row.has(C::x2) || row.has(C::y2))
        return JointShape::polygon;
      const C size = row.columns.count(C::diameter) ? C::diameter : C::radius;
      if (row.columns.count(size))
        {
          row.require(row.has(size),
                      size,
                      "there is no value; give a length, or infinite in the "
                      "column 'extent'.");
          return JointShape::disc;
        }
      row.require(row.columns.count(C::vertices) + row.columns.count(C::x1) ==
                    0,
                  row.columns.count(C::vertices) ? C::vertices : C::x1,
                  "there is no value; give the corners, or infinite in the "
                  "column 'extent'.");
      return JointShape::infinite;
    }

    template <int dim>
    void
    read_geometry(const RowReader &row,
                  const Point<dim> &origin,
                  Joint<dim> &joint)
    {
      joint.extent = find_extent(row);
      if (joint.extent == JointShape::polygon)
        return read_polygon(row, origin, joint);
      read_orientation(row, joint);
      const std::array<C, 3> coordinates = {{C::x, C::y, C::z}};
      for (unsigned int d = 0; d < dim; ++d)
        joint.point[d] = row.number(coordinates[d]) - origin[d];
      if (joint.extent == JointShape::infinite)
        return;
      const bool is_diameter = row.columns.count(C::diameter) > 0;
      const C size           = is_diameter ? C::diameter : C::radius;
      joint.radius           = (is_diameter ? 0.5 : 1.) * row.number(size);
      row.require(joint.radius > 0.,
                  size,
                  "the value " + row.text(size) +
                    " is not positive; give a length, or infinite in the "
                    "column 'extent'.");
    }

    void
    read_law(const RowReader &row, JointStrength &strength)
    {
      if (row.has(C::law))
        {
          strength.law = row.text(C::law);
          std::string names;
          bool is_known = false;
          for (const JointLawKind &kind : joint_law_kinds())
            {
              names += (names.empty() ? "" : ", ") + kind.name;
              is_known = is_known || kind.name == strength.law;
            }
          row.require(is_known,
                      C::law,
                      "no law is called '" + strength.law +
                        "'; there are: " + names + ".");
        }
      const std::vector<JointLawEntry> &entries = joint_law_entries();
      for (unsigned int i = 0; i < entries.size(); ++i)
        row.replace(strength.law_values[i],
                    law_entry_column(i),
                    entries[i].lowest,
                    entries[i].highest,
                    entries[i].unit);
    }

    void
    read_strength(const RowReader &row, JointStrength &strength)
    {
      const double all = std::numeric_limits<double>::max();
      row.replace(
        strength.friction_angle, C::friction_angle, 0., 89.9, "degrees");
      row.replace(strength.kinetic_friction_angle,
                  C::kinetic_friction_angle,
                  -1.,
                  89.9,
                  "degrees");
      row.replace(strength.cohesion, C::cohesion, 0., all, "Pa");
      row.replace(
        strength.tensile_strength, C::tensile_strength, 0., all, "Pa");
      row.replace(
        strength.residual_cohesion, C::residual_cohesion, -1., all, "Pa");
      read_law(row, strength);
      if (!row.has(C::water_pressure))
        return;
      const double unit       = row.columns.at(C::water_pressure).unit;
      const std::string &text = row.text(C::water_pressure);
      double pressure         = 0.;
      if (read_number(text, row.table.has_decimal_comma(), pressure))
        strength.water_pressure = exact_text(row.number(C::water_pressure));
      else
        strength.water_pressure =
          unit == 1. ? text : exact_text(unit) + " * (" + text + ")";
    }

    /** Columns that say the same in two ways, or nothing in this dimension. */
    template <int dim>
    void
    check_columns(const DelimitedText &table, const Columns &columns)
    {
      const std::string where = "Line " + std::to_string(table.header.line) +
                                " of the table '" + table.file_name +
                                "', its header,";
      const std::vector<std::pair<C, C>> rivals = {{C::dip_direction,
                                                    C::strike},
                                                   {C::dip_direction, C::trend},
                                                   {C::strike, C::trend},
                                                   {C::dip, C::plunge},
                                                   {C::radius, C::diameter}};
      for (const auto &[one, other] : rivals)
        AssertThrow(columns.count(one) == 0 || columns.count(other) == 0,
                    InputError(where + " names the columns '" + name_of(one) +
                               "' and '" + name_of(other) +
                               "', which say the same; remove one."));
      const std::string remedy =
        dim == 2 && columns.count(C::dip_direction) + columns.count(C::trend) +
                        columns.count(C::strike) >
                      0
          ? "a section has x along it and y upwards, and of each joint that "
            "crosses it the apparent dip, tan(apparent dip) = tan(dip) "
            "|cos(dip direction - bearing of x)|, with 'dip direction' 90 "
            "where "
            "it dips to +x, else 270; or set 'Dimension' to 3."
          : "remove it, or change 'Dimension'.";
      const std::vector<C> foreign =
        dim == 2 ? std::vector<C>{C::z, C::normal_z}
                 : std::vector<C>{C::x1, C::y1, C::x2, C::y2};
      for (const C column : foreign)
        AssertThrow(columns.count(column) == 0,
                    InputError(where + " names the column '" + name_of(column) +
                               "', which a table in " + std::to_string(dim) +
                               "D cannot have; " + remedy));
    }

    /** Call joints SET.NAME, as joints made of sets are, where their names are
     * those of sets, too, or stand twice, as numbers within sets do. */
    template <int dim>
    void
    part_names(const std::map<std::string, JointStrength> &strength_of_set,
               std::vector<std::unique_ptr<Joint<dim>>> &joints,
               const std::vector<bool> &has_name)
    {
      std::set<std::string> sets, names;
      for (const auto &[set, strength] : strength_of_set)
        sets.insert(set);
      for (const auto &joint : joints)
        if (!joint->set.empty())
          sets.insert(joint->set);
      bool is_ambiguous = false;
      for (const auto &joint : joints)
        is_ambiguous = !names.insert(joint->name).second ||
                       sets.count(joint->name) > 0 || is_ambiguous;
      if (is_ambiguous)
        for (unsigned int i = 0; i < joints.size(); ++i)
          if (has_name[i] && !joints[i]->set.empty())
            joints[i]->name = joints[i]->set + "." + joints[i]->name;
    }
  } // namespace



  template <int dim>
  std::vector<std::unique_ptr<Joint<dim>>>
  read_joint_table(const std::string &file_name,
                   const Point<dim> &origin,
                   const std::map<std::string, JointStrength> &strength_of_set)
  {
    const DelimitedText table = read_delimited_text(file_name, "Joints/File");
    const Columns columns     = find_joint_columns(table, dim);
    check_columns<dim>(table, columns);
    AssertThrow(table.rows.empty() || !is_line_of_units(table.rows[0]),
                InputError("Line " + std::to_string(table.rows[0].line) +
                           " of the table '" + table.file_name +
                           "' has units instead of a joint; delete it, and "
                           "write units into the header, as 'dip (deg)'."));
    const bool has_commas = has_decimal_commas(table),
               has_points = has_decimal_points(table, columns);
    std::vector<std::unique_ptr<Joint<dim>>> joints;
    joints.reserve(table.rows.size());
    std::vector<bool> has_name;
    for (unsigned int i = 0; i < table.rows.size(); ++i)
      {
        const RowReader row(
          table, columns, table.rows[i], has_commas, has_points);
        joints.push_back(std::make_unique<Joint<dim>>());
        Joint<dim> &joint = *joints.back();
        joint.origin      = row.place();
        joint.table_line  = table.rows[i].line;
        joint.name =
          row.has(C::name) ? row.text(C::name) : "J" + std::to_string(i + 1);
        has_name.push_back(row.has(C::name));
        joint.set = row.text(C::set);
        check_name(joint.name, row.place() + ", its joint");
        if (!joint.set.empty())
          check_name(joint.set, row.place() + ", its set");
        const auto strength = strength_of_set.find(joint.set);
        if (strength != strength_of_set.end())
          static_cast<JointStrength &>(joint) = strength->second;
        read_geometry(row, origin, joint);
        read_strength(row, joint);
      }
    part_names(strength_of_set, joints, has_name);
    return joints;
  }



  template std::vector<std::unique_ptr<Joint<2>>>
  read_joint_table(const std::string &,
                   const Point<2> &,
                   const std::map<std::string, JointStrength> &);
  template std::vector<std::unique_ptr<Joint<3>>>
  read_joint_table(const std::string &,
                   const Point<3> &,
                   const std::map<std::string, JointStrength> &);
} // namespace Keyblock
