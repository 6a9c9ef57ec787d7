// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/errors.h>
#include <keyblock/base/expression.h>
#include <keyblock/base/number_text.h>
#include <keyblock/run/water_check.h>
#include <keyblock/scene/given.h>

#include <boost/algorithm/string.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace Keyblock
{
  namespace
  {
    /** The entry that says how much water a joint has in a stage. */
    template <int dim>
    std::string
    entry_of_water(const Scene<dim> &scene,
                   const unsigned int joint,
                   const unsigned int number)
    {
      const Joint<dim> &own = *scene.joints[joint];
      if (!own.water_pressure.empty())
        return "Joints/" + own.name + "/Water pressure";
      if (!own.water_level.empty())
        return "Joints/" + own.name + "/Water level";
      std::string entry = "Water/Level";
      for (const auto &stage : scene.stages)
        if (scene.stage_number(stage->name) <= number &&
            !stage->water_level.empty())
          entry = "Stages/" + stage->name + "/Water level";
      return entry;
    }

    /** Its centre, and places between that and its corners. */
    template <int dim>
    std::vector<Point<dim>>
    places_on_face(const Mesh<dim> &mesh,
                   const unsigned int cell,
                   const unsigned int face)
    {
      const auto corners = mesh.face_vertices(cell, face);
      Point<dim> center;
      for (const unsigned int v : corners)
        center += (1. / corners.size()) * mesh.vertices[v];
      std::vector<Point<dim>> places = {center};
      for (const unsigned int v : corners)
        places.push_back(center + 0.5 * (mesh.vertices[v] - center));
      return places;
    }

    /** Times at which formulas are looked at: of the start and in stages whose
     * time is known [s]. */
    template <int dim>
    std::vector<double>
    times_of(const Scene<dim> &scene, const std::string &formula)
    {
      constexpr unsigned int n_in_stage = 16;
      std::vector<double> times         = {0.};
      if (depends_on_time(formula))
        for (const auto &stage : scene.stages)
          {
            if (!stage->is_dynamic())
              break;
            const double begin = times.back();
            for (unsigned int i = 1; i <= n_in_stage; ++i)
              times.push_back(begin + i * stage->duration / n_in_stage);
          }
      return times;
    }
  } // namespace



  template <int dim>
  void
  check_water(const Scene<dim> &scene, const SplitMesh<dim> &split)
  {
    const Mesh<dim> &mesh = split.mesh;
    std::vector<std::vector<Point<dim>>> places(scene.joints.size());
    for (const JointFace &face : split.interface.joint_faces)
      for (const Point<dim> &place :
           places_on_face(mesh, face.minus_cell, face.minus_face))
        places[face.joint].push_back(place);
    for (unsigned int j = 0; j < scene.joints.size(); ++j)
      {
        std::string last;
        for (unsigned int number = 1; number <= scene.stages.size() + 1;
             ++number)
          {
            const std::string formula = scene.water_pressure(j, number);
            if (formula.empty() || formula == last || places[j].empty())
              continue;
            last                    = formula;
            const std::string entry = entry_of_water(scene, j, number);
            const Expression<dim> pressure(formula, 1, entry);
            for (const double time : times_of(scene, formula))
              for (const Point<dim> &place : places[j])
                {
                  if (std::isfinite(pressure.value(place, time, 0)))
                    continue;
                  std::string at;
                  for (unsigned int d = 0; d < dim; ++d)
                    at += (d > 0 ? ", " : "") + text_of(place[d]);
                  AssertThrow(false,
                              InputError(
                                "The water of the entry '" + entry +
                                "' has no finite pressure at (" + at +
                                "), on the joint '" + scene.joints[j]->name +
                                "', at the time " + text_of(time) +
                                " s; give a formula that has a value on the "
                                "whole joint, as by if(x > 0, ..., 0)."));
                }
          }
      }
  }

  template <int dim>
  std::vector<std::string>
  warnings_of_low_water(const Scene<dim> &scene, const SplitMesh<dim> &split)
  {
    constexpr double unknown = std::numeric_limits<double>::max();
    const Mesh<dim> &mesh    = split.mesh;
    std::vector<double> lowest(scene.joints.size(), unknown);
    for (const JointFace &face : split.interface.joint_faces)
      for (const unsigned int v :
           mesh.face_vertices(face.minus_cell, face.minus_face))
        lowest[face.joint] =
          std::min(lowest[face.joint], mesh.vertices[v][dim - 1]);
    std::map<std::string, double> lowest_of_entry;
    for (unsigned int j = 0; j < scene.joints.size(); ++j)
      for (unsigned int number = 1; number <= scene.stages.size() + 1; ++number)
        if (lowest[j] < unknown && !scene.water_pressure(j, number).empty())
          {
            auto &low =
              lowest_of_entry
                .try_emplace(entry_of_water(scene, j, number), unknown)
                .first->second;
            low = std::min(low, lowest[j]);
          }
    std::vector<std::string> found;
    const auto look_at = [&](const std::string &level,
                             const std::string &entry) {
      const auto low = lowest_of_entry.find(entry);
      double height  = 0.;
      if (low == lowest_of_entry.end() ||
          !read_number(boost::trim_copy(level), false, height) ||
          height > low->second)
        return;
      found.push_back("The entry '" + entry + "' is " + text_of(height) +
                      " m, below all joints that it is for, which reach down "
                      "to " +
                      // (to millimetres, and no -0)
                      text_of(std::round(1e3 * low->second) / 1e3 + 0., 4) +
                      " m, so that they are dry: is it a depth? It is the "
                      "elevation of the water table; for dry joints set none.");
    };
    for_each_water_level(scene, look_at);
    return found;
  }

  template void check_water(const Scene<2> &, const SplitMesh<2> &);
  template void check_water(const Scene<3> &, const SplitMesh<3> &);
  template std::vector<std::string> warnings_of_low_water(const Scene<2> &,
                                                          const SplitMesh<2> &);
  template std::vector<std::string> warnings_of_low_water(const Scene<3> &,
                                                          const SplitMesh<3> &);
} // namespace Keyblock
