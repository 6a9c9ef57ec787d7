// SPDX-License-Identifier: LGPL-2.1-or-later
// Values that look as if they were in another unit.
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
    /** Values of entries that are allowed and hardly ever meant. */
    class Doubts
    {
    public:
      /** Doubt the value of an entry between two bounds, both exclusive. */
      void
      look_at(const double value,
              const std::string &owner,
              const std::string &name,
              const double above,
              const double below,
              const std::string &unit,
              const std::string &question)
      {
        if (!(value > above && value < below))
          return;
        const std::string key = name + unit + text_of(value);
        Doubt &doubt          = doubts[key];
        if (doubt.n++ == 0)
          {
            order.push_back(key);
            doubt.sentence = "The entry '" + owner + "/" + name + "' is " +
                             text_of(value) + " " + unit;
            doubt.question = question;
          }
      }

      std::vector<std::string>
      sentences() const
      {
        std::vector<std::string> all;
        for (const std::string &key : order)
          {
            const Doubt &doubt = doubts.at(key);
            all.push_back(doubt.sentence +
                          (doubt.n > 1
                             ? ", as " + std::to_string(doubt.n - 1) +
                                 (doubt.n > 2 ? " more are" : " more is")
                             : "") +
                          ": " + doubt.question);
          }
        return all;
      }

    private:
      struct Doubt
      {
        std::string sentence, question;
        unsigned int n = 0;
      };
      std::map<std::string, Doubt> doubts; ///< by entry, unit and value
      std::vector<std::string> order;
    };

    void
    doubt_angle(Doubts &doubts,
                const double value,
                const std::string &owner,
                const std::string &name)
    {
      constexpr double least = 1.5; // [deg], nearly a right angle in radians
      doubts.look_at(value,
                     owner,
                     name,
                     0.,
                     least,
                     "degrees",
                     "is it in radians? That would be " +
                       text_of(value * 180. / std::acos(-1.), 4) + " degrees.");
    }

    void
    doubt_stress(Doubts &doubts,
                 const double value,
                 const std::string &owner,
                 const std::string &name,
                 const double least)
    {
      doubts.look_at(value,
                     owner,
                     name,
                     0.,
                     least,
                     "Pa",
                     "is it in " +
                       std::string(least > 1. ? "GPa or MPa" : "MPa") +
                       "? Stresses are in pascals, 1 MPa is 1e6.");
    }

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
  warnings_of_units(const Scene<dim> &scene)
  {
    constexpr double least_cohesion = 1., least_modulus = 1e5; // [Pa]
    constexpr double least_density = 50.;                      // [kg/m3]
    Doubts doubts;
    for (const auto &joint : scene.joints)
      {
        const std::string owner = "Joints/" + joint->name;
        doubt_angle(doubts, joint->friction_angle, owner, "Friction angle");
        doubt_stress(
          doubts, joint->cohesion, owner, "Cohesion", least_cohesion);
      }
    doubt_angle(doubts,
                scene.contact.default_friction_angle,
                "Contact",
                "Default friction angle");
    for (const auto &material : scene.materials)
      if (!material->is_rigid())
        {
          const std::string owner = "Materials/" + material->name;
          if (material->is_plastic())
            {
              doubt_angle(doubts,
                          material->friction_angle,
                          owner,
                          "Friction angle");
              doubt_stress(
                doubts, material->cohesion, owner, "Cohesion", least_cohesion);
            }
          doubt_stress(doubts,
                       material->young_modulus,
                       owner,
                       "Young modulus",
                       least_modulus);
          doubts.look_at(material->density,
                         owner,
                         "Density",
                         0.,
                         least_density,
                         "kg/m3",
                         "is it in t/m3 or kN/m3? Rock has about 2700 kg/m3.");
        }
    return doubts.sentences();
  }



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

  template std::vector<std::string> warnings_of_units(const Scene<2> &);
  template std::vector<std::string> warnings_of_units(const Scene<3> &);
  template std::vector<std::string> warnings_of_drawings(const Scene<2> &);
  template std::vector<std::string> warnings_of_drawings(const Scene<3> &);
} // namespace Keyblock
