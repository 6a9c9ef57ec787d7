// SPDX-License-Identifier: LGPL-2.1-or-later
// What the results of a study leave out: warnings, and factors without value.
#include <keyblock/mesh/size_remedy.h>
#include <keyblock/run/study_report.h>
#include <keyblock/scene/study_entries.h>

#include <boost/algorithm/string/join.hpp>

#include <algorithm>
#include <cmath>

namespace Keyblock
{
  template <int dim>
  std::vector<std::string>
  StudyReport<dim>::warnings() const
  {
    const auto n                 = std::count_if(results.begin(),
                                 results.end(),
                                 [](const SampleResult &result) {
                                   return result.is_coarse;
                                 });
    std::vector<std::string> all = mesh_warnings;
    const auto idle              = list_variables_of_stress(scene);
    if (scene.study.level == StudyLevel::rigid && !idle.empty())
      all.push_back(
        "Limit equilibrium takes neither stress nor stiffness of the "
        "rock: '" +
        boost::join(idle, "', '") +
        "' changes nothing, and its rank correlation is chance; "
        "set 'Study/Level' to full.");
    if (!mesh_warnings.empty() || n == 0)
      return all;
    all.push_back(
      "In " + std::to_string(n) + " of " + std::to_string(results.size()) +
      " samples the mesh has moved faces of blocks off their joints by "
      "more than half a cell, or changed volumes by more than 5 %; limit "
      "equilibrium takes faces as plane and, where they are known, exact "
      "volumes; blocks smaller than the cells are lost, so that the "
      "probability depends on the size of cells, of which its 95 % say "
      "nothing; " +
      remedy_of_coarse_cells(scene.meshing) +
      ", and compare studies with cells of one size and of half of it.");
    return all;
  }



  template <int dim>
  std::vector<double>
  StudyReport<dim>::values_of(std::vector<double> factors) const
  {
    factors.erase(std::remove_if(factors.begin(),
                                 factors.end(),
                                 [&](const double factor) {
                                   return !std::isfinite(factor) ||
                                          is_bound(factor);
                                 }),
                  factors.end());
    return factors;
  }



  template <int dim>
  bool
  StudyReport<dim>::is_bound(const double factor) const
  {
    return scene.study.level == StudyLevel::full &&
           factor == scene.safety.highest;
  }



  template <int dim>
  double
  StudyReport<dim>::held_share() const
  {
    return std::count_if(results.begin(),
                         results.end(),
                         [&](const SampleResult &r) {
                           return is_bound(r.factor);
                         }) /
           double(results.size());
  }

  template std::vector<std::string> StudyReport<2>::warnings() const;
  template std::vector<double>
    StudyReport<2>::values_of(std::vector<double>) const;
  template bool StudyReport<2>::is_bound(const double) const;
  template double StudyReport<2>::held_share() const;
  template std::vector<std::string> StudyReport<3>::warnings() const;
  template std::vector<double>
    StudyReport<3>::values_of(std::vector<double>) const;
  template bool StudyReport<3>::is_bound(const double) const;
  template double StudyReport<3>::held_share() const;
} // namespace Keyblock
