// SPDX-License-Identifier: LGPL-2.1-or-later
// Drawings that say that they are in another unit than the scene.
#include <keyblock/base/number_text.h>
#include <keyblock/scene/unit_warnings.h>

#include <boost/algorithm/string.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>

namespace Keyblock
{
  namespace
  {
    /** What drawings call their unit, by the code of $INSUNITS. */
    struct DrawingUnit
    {
      const char *name;
      double length; ///< [m]
    };

    const std::map<int, DrawingUnit> &
    drawing_units()
    {
      static const std::map<int, DrawingUnit> units = {
        {1, {"inches", 0.0254}},
        {2, {"feet", 0.3048}},
        {4, {"millimetres", 1e-3}},
        {5, {"centimetres", 1e-2}},
        {6, {"metres", 1.}},
        {7, {"kilometres", 1e3}},
        {14, {"decimetres", 0.1}}};
      return units;
    }

    /** Code of $INSUNITS in the header of a drawing; 0: none. */
    int
    unit_code(std::istream &drawing)
    {
      std::string line;
      const auto next = [&]() {
        std::getline(drawing, line);
        boost::trim(line);
        return line;
      };
      while (drawing)
        {
          const std::string word = next();
          if (word == "ENDSEC") // the header is the first section
            return 0;
          if (word == "$INSUNITS" && next() == "70")
            {
              double code = 0.;
              return read_number(next(), false, code) ? std::lround(code) : 0;
            }
        }
      return 0;
    }

    /** A sentence on a drawing that names another unit than the scene; or
     * empty. */
    std::string
    doubt_of_drawing(const std::string &scene_file,
                     const std::string &name,
                     const std::string &section,
                     const double scale)
    {
      constexpr double tolerance = 0.01; // survey feet are other feet
      if (!boost::iends_with(name, ".dxf"))
        return "";
      const auto beside =
        std::filesystem::path(scene_file).parent_path() / name;
      std::ifstream in(beside);
      if (!in)
        in.open(name);
      const auto unit = drawing_units().find(unit_code(in));
      if (unit == drawing_units().end() ||
          std::abs(scale / unit->second.length - 1.) < tolerance)
        return "";
      return "The drawing '" + name + "' of the entry '" + section +
             "/File' says that it is in " + unit->second.name +
             " ($INSUNITS), but 'Scale' is " + text_of(scale) +
             ", the length of its unit in metres; set '" + section +
             "/Scale' to " + text_of(unit->second.length) +
             " if the drawing is right.";
    }
  } // namespace



  template <int dim>
  std::vector<std::string>
  warnings_of_drawings(const Scene<dim> &scene)
  {
    std::vector<std::string> found;
    const auto look_at = [&](const auto &items, const std::string &section) {
      for (const auto &item : items)
        if (const std::string sentence = doubt_of_drawing(
              scene.file, item->file, section + item->name, item->scale);
            !sentence.empty())
          found.push_back(sentence);
    };
    look_at(scene.excavations, "Excavations/");
    look_at(scene.joints, "Joints/");
    return found;
  }

  template std::vector<std::string> warnings_of_drawings(const Scene<2> &);
  template std::vector<std::string> warnings_of_drawings(const Scene<3> &);
} // namespace Keyblock
