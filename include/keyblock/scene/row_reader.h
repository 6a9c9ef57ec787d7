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

#include <map>
#include <string>

namespace Keyblock
{
  using C       = JointColumn;
  using Columns = std::map<JointColumn, ColumnPlace>;

  /** One row of a table, and sentences about it. */
  class RowReader
  {
  public:
    RowReader(const DelimitedText &table,
              const Columns &columns,
              const DelimitedText::Row &row)
      : table(table)
      , columns(columns)
      , row(row)
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
      double value = 0.;
      require(read_number(text(column), table.has_decimal_comma(), value),
              column,
              "'" + text(column) +
                "' is not a number; write digits with a decimal point (or "
                "comma, if ';' or tabs separate the columns).");
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
  };
} // namespace Keyblock

#endif
