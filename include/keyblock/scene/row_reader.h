// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_scene_row_reader_h
#define keyblock_scene_row_reader_h

#include <boost/algorithm/string.hpp>
#include <boost/algorithm/string/trim_all.hpp>
#include <keyblock/base/errors.h>
#include <keyblock/base/number_text.h>
#include <keyblock/law/joint_law.h>
#include <keyblock/scene/joint_columns.h>
#include <keyblock/scene/joint_table.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

namespace Keyblock
{
  using C       = JointColumn;
  using Columns = std::map<JointColumn, ColumnPlace>;

  /** Whether some number of the table has a decimal comma. */
  inline bool
  has_decimal_commas(const DelimitedText &table)
  {
    double number = 0.;
    if (table.has_decimal_comma())
      for (const DelimitedText::Row &row : table.rows)
        for (const std::string &field : row.fields)
          if (field.find(',') != std::string::npos &&
              read_number(field, true, number))
            return true;
    return false;
  }

  /** Whether some number of the table has a decimal point where it may have a
   * comma. */
  inline bool
  has_decimal_points(const DelimitedText &table, const Columns &columns)
  {
    double number = 0.;
    if (table.has_decimal_comma())
      for (const auto &[column, place] : columns)
        if (column != C::name && column != C::set && column != C::comment)
          for (const DelimitedText::Row &row : table.rows)
            if (const std::string &field = row.fields[place.index];
                field.find('.') != std::string::npos &&
                read_number(field, true, number))
              return true;
    return false;
  }

  /** One row of a table, and sentences about it. */
  class RowReader
  {
  public:
    RowReader(const DelimitedText &table,
              const Columns &columns,
              const DelimitedText::Row &row,
              const bool has_commas,
              const bool has_points)
      : table(table)
      , columns(columns)
      , row(row)
      , has_commas(has_commas)
      , has_points(has_points)
    {}

    /** `Line 7 of the table 'joints.csv'`. */
    std::string
    place() const
    {
      return "Line " + std::to_string(row.line) + " of the table '" +
             table.file_name + "'";
    }

    void
    require(const bool condition,
            const C column,
            const std::string &sentence) const
    {
      if (condition)
        return;
      AssertThrow(false,
                  InputError(place() + ", column '" + name_of(column) +
                             "': " + sentence));
    }

    bool
    has(const C column) const
    {
      return !text(column).empty();
    }

    /** What stands in the column; empty without such a column. */
    const std::string &
    text(const C column) const
    {
      static const std::string nothing;
      const auto found = columns.find(column);
      return found == columns.end() ? nothing : row.fields[found->second.index];
    }

    /** The number in the column, in m, deg or Pa; it must be there. */
    double
    number(const C column) const
    {
      require(columns.count(column) > 0,
              column,
              "there is no such column; add it.");
      require(has(column), column, "there is no value; give a number.");
      const std::string digits = without_degree_sign(column);
      double value             = 0.;
      require(read_number(digits, table.has_decimal_comma(), value),
              column,
              "'" + text(column) +
                "' is not a number; write digits with a decimal point (or "
                "comma, if ';' or tabs separate the columns).");
      require(!has_points || !may_have_thousands(digits, ","),
              column,
              "'" + text(column) +
                "' may be a number with a decimal comma or one with commas "
                "between thousands, as other numbers of the table have a "
                "decimal point; write it without commas, or all numbers with "
                "decimal commas.");
      require(!has_commas || !may_have_thousands(digits, "."),
              column,
              "'" + text(column) +
                "' may be a number with a decimal point or one with points "
                "between thousands, as other numbers of the table have a "
                "decimal comma; write it without points, or all numbers with "
                "decimal points.");
      return value * columns.at(column).unit;
    }

    double
    number_in(const C column,
              const double lowest,
              const double highest,
              const std::string &unit) const
    {
      const double value = number(column);
      require(value >= lowest && value <= highest,
              column,
              "the value " + text(column) + " is out of range; give " +
                (highest < 1e300 ? "one from " + exact_text(lowest) + " to " +
                                     exact_text(highest)
                                 : exact_text(lowest) + " or more") +
                " " + unit + ".");
      return value;
    }

    /** Replace @p value where the row has a number in the column. */
    void
    replace(double &value,
            const C column,
            const double lowest,
            const double highest,
            const std::string &unit) const
    {
      if (has(column))
        value = number_in(column, lowest, highest, unit);
    }

    const DelimitedText &table;
    const Columns &columns;
    const DelimitedText::Row &row;
    const bool has_commas; ///< some number of the table has a decimal comma
    const bool has_points; ///< some has a decimal point where it may have those

  private:
    /** What stands in the column; of an angle in degrees without their sign.*/
    std::string
    without_degree_sign(const C column) const
    {
      std::string digits = text(column);
      if (is_angle(column) && columns.at(column).unit == 1.)
        for (const char *sign : degree_signs)
          if (boost::ends_with(digits, sign))
            {
              digits.erase(digits.size() - std::string(sign).size());
              boost::trim_right(digits);
              break;
            }
      return digits;
    }

    /** Whether a @p sign may part thousands: all groups behind the first one
     * have three digits. */
    static bool
    may_have_thousands(const std::string &digits, const std::string &sign)
    {
      std::vector<std::string> groups;
      boost::split(groups, digits, boost::is_any_of(sign));
      return groups.size() > 1 &&
             std::all_of(groups.begin(), groups.end(), [&](const auto &group) {
               const bool is_first = &group == &groups.front();
               return group.find_first_not_of(is_first ? "+-0123456789"
                                                       : "0123456789") ==
                        std::string::npos &&
                      (is_first ? group != "0" : group.size() == 3);
             });
    }
  };
} // namespace Keyblock

#endif
