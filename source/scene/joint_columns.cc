// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/errors.h>
#include <keyblock/law/joint_law.h>
#include <keyblock/scene/joint_columns.h>
#include <keyblock/scene/spelling.h>

#include <boost/algorithm/string.hpp>
#include <boost/algorithm/string/trim_all.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace Keyblock
{
  namespace
  {
    enum class Quantity
    {
      words,
      length,
      angle,
      stress,
      stiffness,
      number
    };

    /** The last coordinate, whichever the dimension. */
    constexpr const char *elevation = "elevation";

    struct KnownColumn
    {
      JointColumn column;
      Quantity quantity;
      std::vector<std::string> names; ///< the first is used in messages
    };

    std::vector<KnownColumn>
    list_columns()
    {
      using C                        = JointColumn;
      using Q                        = Quantity;
      std::vector<KnownColumn> known = {
        {C::name,
         Q::words,
         {"name",
          "joint",
          "id",
          "label",
          "no",
          "nr",
          "number",
          "joint no",
          "joint nr",
          "joint number",
          "joint id",
          "joint name",
          "joint label"}},
        {C::set, Q::words, {"set", "joint set", "family"}},
        {C::dip, Q::angle, {"dip", "dip angle"}},
        {C::dip_direction,
         Q::angle,
         {"dip direction", "dip dir", "dipdir", "dip azimuth", "dd"}},
        {C::strike, Q::angle, {"strike"}},
        {C::trend, Q::angle, {"trend", "pole trend"}},
        {C::plunge, Q::angle, {"plunge", "pole plunge"}},
        {C::normal_x, Q::number, {"normal x", "nx"}},
        {C::normal_y, Q::number, {"normal y", "ny"}},
        {C::normal_z, Q::number, {"normal z", "nz"}},
        {C::x, Q::length, {"x", "easting", "east"}},
        {C::y, Q::length, {"y", "northing", "north"}},
        {C::z, Q::length, {"z", elevation}},
        {C::x1, Q::length, {"x1"}},
        {C::y1, Q::length, {"y1"}},
        {C::x2, Q::length, {"x2"}},
        {C::y2, Q::length, {"y2"}},
        {C::radius,
         Q::length,
         {"radius", "r", "half length", "half trace length"}},
        {C::diameter,
         Q::length,
         {"diameter", "length", "trace length", "persistence length"}},
        {C::extent, Q::words, {"extent"}},
        {C::vertices, Q::length, {"vertices", "polygon"}},
        {C::friction_angle,
         Q::angle,
         {"friction angle",
          "friction",
          "phi",
          "friction static",
          "static friction",
          "static friction angle"}},
        {C::kinetic_friction_angle,
         Q::angle,
         {"kinetic friction angle", "friction kinetic", "kinetic friction"}},
        {C::cohesion, Q::stress, {"cohesion", "c"}},
        {C::tensile_strength,
         Q::stress,
         {"tensile strength", "tension", "tensile"}},
        {C::residual_cohesion,
         Q::stress,
         {"residual cohesion", "cohesion residual"}},
        {C::water_pressure, Q::stress, {"water pressure", "water"}},
        {C::law, Q::words, {"law", "joint law"}},
        {C::comment,
         Q::words,
         {"comment", "comments", "remark", "remarks", "note", "notes"}}};
      const std::map<std::string, Quantity> quantities = {{"m", Q::length},
                                                          {"deg", Q::angle},
                                                          {"Pa", Q::stress},
                                                          {"Pa/m",
                                                           Q::stiffness},
                                                          {"", Q::number}};
      const std::vector<JointLawEntry> &entries        = joint_law_entries();
      for (unsigned int i = 0; i < entries.size(); ++i)
        known.push_back({law_entry_column(i),
                         quantities.at(entries[i].unit),
                         {boost::to_lower_copy(entries[i].name)}});
      return known;
    }

    const std::vector<KnownColumn> &
    known_columns()
    {
      static const std::vector<KnownColumn> known = list_columns();
      return known;
    }

    struct Unit
    {
      Quantity quantity;
      double factor;
    };

    const std::map<std::string, Unit> &
    known_units()
    {
      static const double degrees                    = 180. / std::acos(-1.);
      static const std::map<std::string, Unit> known = {
        {"m", {Quantity::length, 1.}},
        {"km", {Quantity::length, 1e3}},
        {"cm", {Quantity::length, 1e-2}},
        {"mm", {Quantity::length, 1e-3}},
        {"ft", {Quantity::length, 0.3048}},
        {"deg", {Quantity::angle, 1.}},
        {"degree", {Quantity::angle, 1.}},
        {"degrees", {Quantity::angle, 1.}},
        {"rad", {Quantity::angle, degrees}},
        {"pa", {Quantity::stress, 1.}},
        {"kpa", {Quantity::stress, 1e3}},
        {"mpa", {Quantity::stress, 1e6}},
        {"gpa", {Quantity::stress, 1e9}},
        {"n/m2", {Quantity::stress, 1.}},
        {"kn/m2", {Quantity::stress, 1e3}},
        {"mn/m2", {Quantity::stress, 1e6}},
        {"pa/m", {Quantity::stiffness, 1.}},
        {"kpa/m", {Quantity::stiffness, 1e3}},
        {"mpa/m", {Quantity::stiffness, 1e6}},
        {"gpa/m", {Quantity::stiffness, 1e9}}};
      return known;
    }

    /** Small letters, words apart by one space, brackets and signs spelled. */
    std::string
    normalized(std::string text)
    {
      // effective strength has a prime, and friction a Greek letter
      for (const char *prime : {"'", "\xE2\x80\x99", "\xE2\x80\xB2"})
        boost::erase_all(text, prime);
      for (const char *letter : {"\xCF\x86", "\xCF\x95", "\xCE\xA6"})
        boost::replace_all(text, letter, "phi");
      // the superscript 2 in UTF-8 and in Latin-1, as the sign of degrees
      for (const char *sign : degree_signs)
        boost::replace_all(text, sign, " deg");
      for (const char *sign : {"\xC2\xB2", "\xB2", "^2"})
        boost::replace_all(text, sign, "2");
      for (char &letter : text)
        if (std::string("_-()[],.").find(letter) != std::string::npos)
          letter = ' ';
      boost::to_lower(text, std::locale::classic());
      boost::trim_all(text, std::locale::classic());
      return text;
    }

    const KnownColumn *
    column_called(const std::string &name)
    {
      for (const KnownColumn &known : known_columns())
        if (std::find(known.names.begin(), known.names.end(), name) !=
            known.names.end())
          return &known;
      return nullptr;
    }

    std::string
    list_known()
    {
      std::string list;
      for (const KnownColumn &known : known_columns())
        list += (list.empty() ? "" : ", ") + known.names.front();
      return list;
    }

    std::set<std::string>
    words_of(const std::string &title)
    {
      std::set<std::string> words;
      boost::split(words, title, boost::is_space(), boost::token_compress_on);
      return words;
    }

    /** Words of columns that are input, or would be by another name. */
    std::set<std::string>
    list_telling_words()
    {
      std::set<std::string> telling = {"size",
                                       "persistence",
                                       "width",
                                       "height",
                                       "area",
                                       "altitude",
                                       "orientation",
                                       "attitude",
                                       "strength"};
      for (const KnownColumn &known : known_columns())
        if (known.column != JointColumn::name &&
            known.column != JointColumn::comment)
          for (const std::string &name : known.names)
            telling.merge(words_of(name));
      for (const std::string word : {"joint", "static", "distance", "water"})
        telling.erase(word);
      return telling;
    }

    /** A word that a column of these words may be known by; empty where it can
     * be left out, as what nobody computes with. */
    std::string
    telling_word(const std::string &title)
    {
      static const std::set<std::string> telling = list_telling_words();
      std::set<std::string> words                = words_of(title);
      const auto space                           = title.rfind(' ');
      if (space != std::string::npos)
        if (known_units().count(title.substr(space + 1)) > 0)
          words.erase(title.substr(space + 1));
      for (const std::string &word : words)
        for (const std::string &known : telling)
          if (is_like(word, known))
            return known;
      return "";
    }

    /** A title that is no word names nothing, as in a table without header. */
    bool
    is_number(const std::string &words)
    {
      return words.find_first_not_of("0123456789 +") == std::string::npos;
    }

    /** What a title of the header, maybe with a unit as its last word, means;
     * none where the column is left out. */
    std::pair<const KnownColumn *, double>
    understand(const std::string &title, const std::string &where)
    {
      const std::string words = normalized(title);
      if (const KnownColumn *known = column_called(words))
        return {known, 1.};
      const auto space         = words.rfind(' ');
      const KnownColumn *known = space == std::string::npos
                                   ? nullptr
                                   : column_called(words.substr(0, space));
      const auto unit          = known_units().find(words.substr(space + 1));
      // (what stands in brackets is meant as a unit)
      const bool has_unit = unit != known_units().end() ||
                            title.find_first_of("([") != std::string::npos;
      if (!known || !has_unit)
        {
          const std::string like = telling_word(words);
          AssertThrow(like.empty() && !is_number(words),
                      InputError(where + " names the column '" + title +
                                 "', which is not known" +
                                 (like.empty()
                                    ? ""
                                    : ", but may be input, by its '" + like +
                                        "'; correct its name, or remove it") +
                                 "; known are " + list_known() + "."));
          return {nullptr, 1.};
        }
      AssertThrow(
        unit != known_units().end() && unit->second.quantity == known->quantity,
        InputError(where + " gives the column '" + title +
                   "' a unit that is not known or does not fit; lengths may "
                   "be in m, km, cm or mm, angles in deg or rad, stresses in "
                   "Pa, kPa, MPa or GPa, stiffnesses of joints in these over "
                   "m."));
      return {known, unit->second.factor};
    }
  } // namespace



  const std::string &
  name_of(const JointColumn column)
  {
    return std::find_if(known_columns().begin(),
                        known_columns().end(),
                        [&](const auto &k) { return k.column == column; })
      ->names.front();
  }



  bool
  is_angle(const JointColumn column)
  {
    return std::any_of(known_columns().begin(),
                       known_columns().end(),
                       [&](const auto &k) {
                         return k.column == column &&
                                k.quantity == Quantity::angle;
                       });
  }



  std::map<JointColumn, ColumnPlace>
  find_joint_columns(const DelimitedText &table, const unsigned int dim)
  {
    const std::string where = "Line " + std::to_string(table.header.line) +
                              " of the table '" + table.file_name +
                              "', its header,";
    std::map<JointColumn, ColumnPlace> places;
    for (unsigned int i = 0; i < table.header.fields.size(); ++i)
      {
        const auto [known, unit] = understand(table.header.fields[i], where);
        if (!known)
          continue;
        const std::string words = normalized(table.header.fields[i]);
        const JointColumn column =
          dim == 2 && boost::starts_with(words, elevation) ? JointColumn::y
                                                           : known->column;
        AssertThrow(column == JointColumn::comment || places.count(column) == 0,
                    InputError(where + " names the column '" + name_of(column) +
                               "' twice, the second "
                               "time as '" +
                               table.header.fields[i] + "'; remove one."));
        places[column] = ColumnPlace{i, unit};
      }
    return places;
  }



  bool
  is_line_of_units(const DelimitedText::Row &row)
  {
    bool has_unit = false;
    for (const std::string &field : row.fields)
      if (known_units().count(normalized(field)) > 0)
        has_unit = true;
      else if (field.find_first_of("0123456789") != std::string::npos)
        return false;
    return has_unit;
  }



  std::vector<std::string>
  columns_left_out(const DelimitedText &table)
  {
    std::vector<std::string> titles;
    for (const std::string &title : table.header.fields)
      if (!understand(title, "The table").first)
        titles.push_back(title);
    return titles;
  }
} // namespace Keyblock
