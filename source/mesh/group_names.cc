// SPDX-License-Identifier: LGPL-2.1-or-later
// Groups of a mesh file that a scene names, and those that there are.
#include <keyblock/mesh/mesh_marks.h>

#include <keyblock/base/errors.h>
#include <keyblock/scene/boundary_names.h>

#include <set>

namespace Keyblock
{
  std::string
  list_groups(const std::set<unsigned int> &ids, const GroupNames &names)
  {
    constexpr unsigned int most_groups = 20;
    std::string list;
    unsigned int n = 0;
    for (const unsigned int id : ids)
      if (n++ < most_groups)
        {
          const auto name = names.find(id);
          list += (list.empty() ? "" : ", ") + std::to_string(id) +
                  (name == names.end() || name->second.empty()
                     ? ""
                     : " (" + name->second + ")");
        }
    return list.empty() ? "none" : n > most_groups ? list + ", ..." : list;
  }



  template <int dim>
  void
  check_boundary_groups(const Mesh<dim> &mesh, const Scene<dim> &scene)
  {
    std::set<unsigned int> ids;
    for (const auto &faces : mesh.boundary_id)
      for (const unsigned int id : faces)
        if (id != none)
          ids.insert(id);
    const auto check = [&](const std::string &name, const std::string &entry) {
      bool is_there = name.rfind("id ", 0) != 0;
      for (const unsigned int id : ids)
        is_there = is_there || means_group(name, id, mesh.boundary_id_names);
      AssertThrow(is_there,
                  InputError("The entry '" + entry + "' names '" + name +
                             "', but no outer face of the mesh file '" +
                             scene.domain.file +
                             "' is in a group of that number or name; groups "
                             "of outer faces are: " +
                             list_groups(ids, mesh.boundary_id_names) + "."));
    };
    for_each_boundary_name<dim>(scene, check);
  }

  template void check_boundary_groups(const Mesh<2> &, const Scene<2> &);
  template void check_boundary_groups(const Mesh<3> &, const Scene<3> &);
} // namespace Keyblock
