// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_scene_joint_columns_h
#define keyblock_scene_joint_columns_h

#include <keyblock/base/delimited_text.h>

#include <map>

namespace Keyblock
{
  /** What a column of a table of joints may hold. */
  enum class JointColumn
  {
    name,
    set,
    dip,
    dip_direction,
    strike,
    trend,
    plunge,
    normal_x,
    normal_y,
    normal_z,
    x,
    y,
    z,
    x1,
    y1,
    x2,
    y2,
    radius,
    diameter,
    extent,
    vertices,
    friction_angle,
    kinetic_friction_angle,
    cohesion,
    tensile_strength,
    residual_cohesion,
    water_pressure,
    law,
    comment,
    first_law_entry ///< and on, in the order of joint_law_entries()
  };

  /** The column of entry @p i of joint_law_entries(). */
  inline JointColumn
  law_entry_column(const unsigned int i)
  {
    return static_cast<JointColumn>(
      static_cast<unsigned int>(JointColumn::first_law_entry) + i);
  }

  /** Where a quantity stands in each row, and its unit. */
  struct ColumnPlace
  {
    unsigned int index; ///< of the field
    double unit = 1.;   ///< in m, deg or Pa
  };

  /** The sign of degrees in UTF-8 and in Latin-1, and what is taken for it. */
  constexpr const char *degree_signs[] = {"\xC2\xB0",
                                          "\xC2\xBA",
                                          "\xB0",
                                          "\xBA"};

  /** Whether a column has angles. */
  bool is_angle(const JointColumn column);

  /** The name of a column as messages and written tables use it. */
  const std::string &name_of(const JointColumn column);

  /**
   * Find out what the columns of @p table are: upper and lower case, spaces,
   * '_' and '-' are the same, units follow the name or stand in brackets,
   * primes do not count.
   * Columns that are not known are left out, unless a word of theirs, as it is
   * or misspelt, is one of a known column's. In 2D elevations are y. Throws
   * InputError for these, and for columns that stand twice or have a unit that
   * does not fit.
   */
  std::map<JointColumn, ColumnPlace>
  find_joint_columns(const DelimitedText &table, const unsigned int dim);

  /** Whether a row has no numbers, but units. */
  bool is_line_of_units(const DelimitedText::Row &row);

  /** The titles of the columns that find_joint_columns() leaves out. */
  std::vector<std::string> columns_left_out(const DelimitedText &table);
} // namespace Keyblock

#endif
