// SPDX-License-Identifier: LGPL-2.1-or-later
// What the header of a history says: units, and the order of the axes.
#include <keyblock/base/errors.h>
#include <keyblock/base/history_columns.h>

#include <boost/algorithm/string.hpp>

#include <algorithm>
#include <cctype>
#include <map>
#include <regex>
#include <vector>

namespace Keyblock
{
  namespace
  {
    struct Unit
    {
      std::string quantity; ///< by its unit in SI
      double factor;
    };

    const std::map<std::string, Unit> &
    known_units()
    {
      static const std::map<std::string, Unit> known = {
        {"s", {"s", 1.}},
        {"sec", {"s", 1.}},
        {"seconds", {"s", 1.}},
        {"ms", {"s", 1e-3}},
        {"m/s", {"m/s", 1.}},
        {"cm/s", {"m/s", 1e-2}},
        {"mm/s", {"m/s", 1e-3}},
        {"m/s2", {"m/s2", 1.}},
        {"cm/s2", {"m/s2", 1e-2}},
        {"mm/s2", {"m/s2", 1e-3}},
        {"gal", {"m/s2", 1e-2}},
        {"g", {"m/s2", 9.80665}},
        {"pa", {"Pa", 1.}},
        {"kpa", {"Pa", 1e3}},
        {"mpa", {"Pa", 1e6}}};
      return known;
    }

    /** A title of the header: its name and its unit, both in small letters. */
    struct Title
    {
      explicit Title(const std::string &text)
      {
        const auto open = text.find_first_of("([");
        name            = boost::to_lower_copy(text.substr(0, open));
        boost::erase_all(name, " ");
        boost::erase_all(name, "_");
        if (open == std::string::npos)
          return;
        unit = boost::to_lower_copy(
          text.substr(open + 1, text.find_first_of(")]", open) - open - 1));
        for (const char *sign : {"^2", "**2", "\xC2\xB2", "\xB2", "/s/s"})
          boost::replace_all(unit,
                             sign,
                             sign == std::string("/s/s") ? "/s2" : "2");
        boost::erase_all(unit, " ");
      }

      std::string name, unit;
    };

    /** Axis that a column is of by its @p name: x, y and z are east, north and
     * up, in 2D the last is y. Words, letters behind that of a quantity, as in
     * vx, codes of channels, as HNZ, and numbers; or no_axis. */
    constexpr unsigned int no_axis = 3;

    unsigned int
    axis_of(const std::string &name, const unsigned int n_axes)
    {
      if (n_axes == 1)
        return 0;
      static const std::map<std::string, unsigned int> words = {{"east", 0},
                                                                {"eastwest", 0},
                                                                {"e-w", 0},
                                                                {"ew", 0},
                                                                {"e", 0},
                                                                {"north", 1},
                                                                {"northsouth",
                                                                 1},
                                                                {"n-s", 1},
                                                                {"ns", 1},
                                                                {"n", 1},
                                                                {"up", 2},
                                                                {"updown", 2},
                                                                {"vertical", 2},
                                                                {"u-d", 2},
                                                                {"ud", 2},
                                                                {"u", 2},
                                                                {"v", 2}};
      static const std::map<char, unsigned int> letters      = {
             {'x', 0}, {'y', 1}, {'z', 2}, {'1', 0}, {'2', 1}, {'3', 2}};
      static const std::regex channel("[bceh][hnl][enz]");
      const bool is_flat = n_axes == 2;
      if (is_flat && (name == "horizontal" || name == "h"))
        return 0;
      const bool is_channel = std::regex_match(name, channel);
      const auto word       = words.find(is_channel ? name.substr(2, 1) : name);
      // a section may look along either, and what is up is its second axis
      if (word != words.end())
        return is_flat ? word->second / 2 : word->second;
      const auto letter =
        name.empty() ? letters.end() : letters.find(name.back());
      // components that are horizontal are not x and y by their numbers
      if (letter == letters.end() || name == "velocity" ||
          name == "intensity" || (std::isdigit(name.back()) && name[0] == 'h'))
        return no_axis;
      return is_flat && name.back() == 'z' ? 1 : letter->second;
    }

    /** A quantity, as names of columns tell it. */
    struct Quantity
    {
      std::string name, si_unit;
      std::regex pattern;
    };

    /** Those that the small letters of a @p name tell: a word, or a letter with
     * that of an axis, as vx; displacements fit nowhere. Null: none. */
    const Quantity *
    quantity_of(const std::string &name)
    {
      static const std::vector<Quantity> known = {
        {"a velocity", "m/s", std::regex("velocity|^vel|vel$|^v[xyz123]$")},
        {"an acceleration", "m/s2", std::regex("accel|^acc|acc$|^a[xyz123]$")},
        {"a stress", "Pa", std::regex("stress|^sigma|^tau|^s[xyz]{1,2}$")},
        {"a displacement", "m", std::regex("displacement|^disp|^[ud][xyz]$")}};
      for (const Quantity &quantity : known)
        if (std::regex_search(name, quantity.pattern))
          return &quantity;
      return nullptr;
    }

    std::string
    known_names(const unsigned int n_axes)
    {
      return n_axes == 2
               ? "; name it x, east, north or horizontal, or y, up, vertical "
                 "or "
                 "z, also behind a quantity, as vx, by the axis of the scene."
               : "; name it x, east, E or EW, y, north, N or NS, or z, up, "
                 "vertical, U, V or UD, also behind a quantity, as vx, by the "
                 "axis of the scene.";
    }
  } // namespace



  HistoryColumns::HistoryColumns(const DelimitedText &table,
                                 const std::string &si_unit,
                                 const std::string &entry)
  {
    const std::string where = "Line " + std::to_string(table.header.line) +
                              " of the history '" + table.file_name +
                              "' of the entry '" + entry + "', its header, ";
    const std::vector<std::string> &titles = table.header.fields;
    const unsigned int n_axes              = titles.size() - 1;
    std::vector<unsigned int> axes;
    for (unsigned int i = 0; i < titles.size(); ++i)
      {
        const Title title(titles[i]);
        const std::string expected = i == 0 ? "s" : si_unit;
        const auto unit            = known_units().find(title.unit);
        AssertThrow(title.unit.empty() || (unit != known_units().end() &&
                                           unit->second.quantity == expected),
                    InputError(
                      where + "gives the column '" + titles[i] +
                      "' a unit that is not known or does not fit; " +
                      (i == 0            ? "times may be in s or ms."
                       : si_unit == "Pa" ? "stresses may be in Pa, kPa or MPa."
                       : si_unit == "m/s"
                         ? "velocities may be in m/s, cm/s or mm/s, and "
                           "'History quantity' says what it is."
                         : "accelerations may be in m/s2, cm/s2, mm/s2, "
                           "gal or g.")));
        factors.push_back(title.unit.empty() ? 1. : unit->second.factor);
        AssertThrow(i == 0 || (title.name != "t" && title.name != "time"),
                    InputError(where + "has the time in column " +
                               std::to_string(i + 1) +
                               "; put it into the first one."));
        if (i == 0)
          continue;
        const Quantity *quantity = quantity_of(title.name);
        AssertThrow(quantity == nullptr || quantity->si_unit == si_unit,
                    InputError(where + "names the column '" + titles[i] +
                               "', by which it is no " +
                               (si_unit == "Pa"     ? "stress"
                                : si_unit == "m/s2" ? "acceleration"
                                                    : "velocity") +
                               " but " + quantity->name +
                               "; give 'History quantity' or the name as it "
                               "is."));
        axes.push_back(axis_of(title.name, n_axes));
        AssertThrow(axes.back() < n_axes,
                    InputError(where + "names the column '" + titles[i] +
                               "', which tells no axis" + known_names(n_axes)));
      }
    for (unsigned int axis = 0; axis < n_axes; ++axis)
      columns.push_back(axis + 1);
    for (unsigned int axis = 0; axis < n_axes; ++axis)
      {
        const auto place = std::find(axes.begin(), axes.end(), axis);
        AssertThrow(place != axes.end(),
                    InputError(where + "names no column of the axis " +
                               std::string(1, "xyz"[axis]) +
                               ", and another axis twice; give one column for "
                               "each axis."));
        columns[axis] = place - axes.begin() + 1;
      }
  }
} // namespace Keyblock
