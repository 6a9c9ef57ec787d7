// SPDX-License-Identifier: LGPL-2.1-or-later
// Entries that have no effect with the choice beside them are refused.
#include <keyblock/base/number_text.h>
#include <keyblock/scene/check.h>
#include <keyblock/scene/entries.h>
#include <keyblock/scene/idle_entries.h>

#include <deal.II/base/parameter_handler.h>

#include <boost/algorithm/string.hpp>

#include <algorithm>
#include <set>

namespace Keyblock
{
  namespace
  {
    using Words = std::vector<std::string>;

    /** An entry, and the choices that use it. */
    struct Use
    {
      std::string entry;
      Words choices;
    };

    /** Entries of a section that only some of the choices use which another
     * one of it, @p choice, has. */
    struct UseTable
    {
      std::string choice;
      std::vector<Use> uses;
    };

    const UseTable &
    uses_of_excavations()
    {
      static const Words profiles = {"rectangle", "horseshoe", "cavern"};
      static const Words along    = {
           "circle", "extruded polygon", "rectangle", "horseshoe", "cavern"};
      static const UseTable excavation = {
        "Shape",
        {{"Vertices", {"polygon", "extruded polygon"}},
         {"Corner", {"box"}},
         {"Size", {"box"}},
         {"Center", {"circle", "rectangle", "horseshoe", "cavern"}},
         {"Radius", {"circle"}},
         {"Width", profiles},
         {"Height", profiles},
         {"Rise", {"cavern"}},
         {"Segments", {"circle", "horseshoe", "cavern", "file"}},
         {"From", along},
         {"To", along},
         {"Trend", along},
         {"Plunge", along},
         {"Formula", {"formula"}},
         {"File", {"file"}},
         {"Scale", {"file"}}}};
      return excavation;
    }

    const std::vector<UseTable> &
    uses_of_joint_sets()
    {
      static const Words cut_off             = {"uniform",
                                                "exponential",
                                                "lognormal",
                                                "power law"};
      static const std::vector<UseTable> set = {
        {"Spacing law", {{"Jitter", {"constant"}}}},
        {"Radius law",
         {{"Radius mean", {"constant", "exponential", "lognormal"}},
          {"Radius deviation", {"lognormal"}},
          {"Radius minimum", cut_off},
          {"Radius maximum", cut_off},
          {"Radius exponent", {"power law"}}}}};
      return set;
    }

    const UseTable &
    uses_of_study_variables()
    {
      static const UseTable variable = {
        "Distribution",
        {{"Mean", {"normal", "lognormal", "exponential"}},
         {"Deviation", {"normal", "lognormal"}},
         {"Mode", {"triangular"}},
         {"Maximum",
          {"normal", "lognormal", "exponential", "uniform", "triangular"}}}};
      return variable;
    }

    const UseTable &
    uses_of_mesh()
    {
      static const UseTable mesh = {"Generator",
                                    {{"Cells", {"structured"}},
                                     {"Gradings", {"structured"}},
                                     {"Cells across blocks", {"gmsh"}},
                                     {"Least size", {"gmsh"}},
                                     {"Grading distance", {"gmsh"}},
                                     {"Snap", {"gmsh"}}}};
      return mesh;
    }

    /** Whether two values of an entry are the same, as 0 and 0.0 are. */
    bool
    are_same(const std::string &a, const std::string &b)
    {
      Words one, other;
      boost::split(one, a, boost::is_any_of(",;"));
      boost::split(other, b, boost::is_any_of(",;"));
      return std::equal(one.begin(),
                        one.end(),
                        other.begin(),
                        other.end(),
                        [](std::string x, std::string y) {
                          boost::trim(x);
                          boost::trim(y);
                          double left = 0., right = 0.;
                          return x == y || (read_number(x, false, left) &&
                                            read_number(y, false, right) &&
                                            left == right);
                        });
    }

    /** Compares the entries of a scene with tables of their uses. */
    class IdleEntries
    {
    public:
      IdleEntries(ParameterHandler &prm,
                  const SceneText &text,
                  const bool is_resolved)
        : prm(prm)
        , is_resolved(is_resolved)
      {
        for (const SceneText::Override &entry : text.overrides)
          for (const auto &[path, value] : list_entries(entry.text))
            overridden.insert(path);
      }

      /** @p item: the section's struct with the values by default. */
      template <typename Item>
      void
      refuse(const Words &path, Item item, const UseTable &table)
      {
        ParameterHandler defaults;
        item.declare(defaults);
        for (const std::string &section : path)
          prm.enter_subsection(section);
        const std::string name   = boost::join(path, "/") + "/";
        const std::string choice = prm.get(table.choice);
        for (const Use &use : table.uses)
          require(std::count(use.choices.begin(), use.choices.end(), choice) >
                      0 ||
                    are_same(prm.get(use.entry), defaults.get(use.entry)) ||
                    !is_looked_at(name + use.entry, name + table.choice),
                  "The entry '" + name + use.entry + "' is " +
                    prm.get(use.entry) + ", but '" + table.choice + "' is " +
                    choice +
                    ", so that it has no effect; leave it out, or "
                    "set '" +
                    table.choice + "' to " + list_of(use.choices) + ".");
        for (unsigned int i = 0; i < path.size(); ++i)
          prm.leave_subsection();
      }

    private:
      /** An override of the choice leaves what the file gives aside; a file
       * with all entries, as used.prm, has them as they are. */
      bool
      is_looked_at(const std::string &entry, const std::string &choice) const
      {
        return overridden.count(entry) > 0 ||
               (!is_resolved && overridden.count(choice) == 0);
      }

      static std::string
      list_of(const Words &choices)
      {
        std::string list;
        for (unsigned int i = 0; i < choices.size(); ++i)
          list += (i == 0                    ? ""
                   : i + 1 == choices.size() ? " or "
                                             : ", ") +
                  choices[i];
        return list;
      }

      ParameterHandler &prm;
      const bool is_resolved;
      std::set<std::string> overridden;
    };
  } // namespace



  template <int dim>
  void
  refuse_idle_entries(ParameterHandler &prm,
                      const Scene<dim> &scene,
                      const SceneText &text)
  {
    IdleEntries idle(prm, text, scene.network.is_resolved);
    idle.refuse({"Mesh"}, Meshing<dim>(), uses_of_mesh());
    for (const auto &excavation : scene.excavations)
      idle.refuse({"Excavations", excavation->name},
                  Excavation<dim>(),
                  uses_of_excavations());
    for (const auto &set : scene.joint_sets)
      for (const UseTable &table : uses_of_joint_sets())
        idle.refuse({"Joint sets", set->name}, JointSet<dim>(), table);
    for (const auto &variable : scene.study_variables)
      idle.refuse({"Study", variable->name},
                  StudyVariable(),
                  uses_of_study_variables());
  }

  template void
  refuse_idle_entries(ParameterHandler &, const Scene<2> &, const SceneText &);
  template void
  refuse_idle_entries(ParameterHandler &, const Scene<3> &, const SceneText &);
} // namespace Keyblock
