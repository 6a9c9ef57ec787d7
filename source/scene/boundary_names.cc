// SPDX-License-Identifier: LGPL-2.1-or-later
// Names of outer boundaries in a scene, and whether there are such boundaries.
#include <keyblock/scene/boundary_names.h>
#include <keyblock/scene/check.h>

#include <boost/algorithm/string.hpp>

#include <algorithm>

namespace Keyblock
{
  namespace
  {
    /** The boundaries that there are, for a sentence. */
    template <int dim>
    std::string
    list_boundaries(const Domain<dim> &domain, const bool may_be_none)
    {
      std::string list = boost::join(boundary_names<dim>(), ", ");
      list += may_be_none ? ", all and none" : " and all";
      if (domain.shape == DomainShape::polygon)
        list += ", and id 1 to id " + std::to_string(domain.polygon.size()) +
                " for the edges of 'Domain/Polygon'";
      else if (domain.shape == DomainShape::file)
        list += ", and `id N` for the group N of the mesh file";
      return list;
    }

    /** Whether the words `id N` may mean something in this domain. */
    template <int dim>
    bool
    may_mean_id(const Domain<dim> &domain, const std::string &words)
    {
      if (!boost::starts_with(words, "id "))
        return false;
      if (domain.shape == DomainShape::file)
        return true;
      if (domain.shape == DomainShape::polygon)
        for (unsigned int i = 1; i <= domain.polygon.size(); ++i)
          if (words == "id " + std::to_string(i))
            return true;
      return false;
    }
  } // namespace



  template <int dim>
  const std::vector<std::string> &
  boundary_names()
  {
    static const std::vector<std::string> names =
      dim == 2 ? std::vector<std::string>{"left", "right", "bottom", "top"}
               : std::vector<std::string>{
                   "left", "right", "front", "back", "bottom", "top"};
    return names;
  }



  template <int dim>
  void
  for_each_boundary_name(
    const Scene<dim> &scene,
    const std::function<void(const std::string &name, const std::string &entry)>
      &action)
  {
    for (const std::string &name : scene.domain.truncated_boundaries)
      action(name, "Domain/Truncated boundaries");
    for (const auto &support : scene.supports)
      for (const std::string &name : support->boundaries)
        action(name, "Supports/" + support->name + "/Boundaries");
    for (const auto &traction : scene.tractions)
      for (const std::string &name : traction->boundaries)
        action(name, "Tractions/" + traction->name + "/Boundaries");
  }



  template <int dim>
  void
  check_boundary_names(const Scene<dim> &scene)
  {
    const auto check = [&](const std::string &name, const std::string &entry) {
      const std::vector<std::string> &names = boundary_names<dim>();
      const bool may_be_none = entry == "Domain/Truncated boundaries";
      require(name == "all" || (may_be_none && name == "none") ||
                std::find(names.begin(), names.end(), name) != names.end() ||
                may_mean_id(scene.domain, name),
              "The entry '" + entry + "' names '" + name +
                "', but there is no such boundary; there are " +
                list_boundaries(scene.domain, may_be_none) + ".");
    };
    for_each_boundary_name<dim>(scene, check);
  }

#define INSTANTIATE(dim)                                                       \
  template const std::vector<std::string> &boundary_names<dim>();              \
  template void for_each_boundary_name(                                        \
    const Scene<dim> &,                                                        \
    const std::function<void(const std::string &, const std::string &)> &);    \
  template void check_boundary_names(const Scene<dim> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock
