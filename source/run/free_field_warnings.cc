// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/run/free_field_warnings.h>

#include <set>

namespace Keyblock
{
  namespace
  {
    /** Whether rock that yields lies on a boundary that a support names. */
    template <int dim>
    bool
    is_beside_yielding_rock(const Support<dim> &support,
                            const Scene<dim> &scene,
                            const Mesh<dim> &mesh)
    {
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        if (scene.materials[mesh.material[c]]->is_plastic())
          for (unsigned int f = 0; f < Mesh<dim>::n_cell_faces; ++f)
            for (const std::string &boundary : support.boundaries)
              if (mesh.is_on(c, f, boundary))
                return true;
      return false;
    }



    /** Names of the joints that can move where they meet boundaries that the
     * @p support has, or empty. */
    template <int dim>
    std::string
    names_of_joints_at_side(const Support<dim> &support,
                            const Scene<dim> &scene,
                            const SplitMesh<dim> &split)
    {
      const Mesh<dim> &mesh = split.mesh;
      std::set<unsigned int> at_side, joints;
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        for (unsigned int f = 0; f < Mesh<dim>::n_cell_faces; ++f)
          for (const std::string &boundary : support.boundaries)
            if (mesh.is_on(c, f, boundary))
              for (const unsigned int v : mesh.face_vertices(c, f))
                at_side.insert(v);
      for (const Pair<dim> &pair : split.interface.pairs)
        if (at_side.count(pair.minus) > 0)
          joints.insert(pair.joint);
      std::string names;
      for (const unsigned int j : joints)
        names += (names.empty() ? "'" : ", '") + scene.joints[j]->name + "'";
      return names;
    }
  } // namespace



  template <int dim>
  std::vector<std::string>
  warnings_of_free_fields(const Scene<dim> &scene, const SplitMesh<dim> &split)
  {
    const Mesh<dim> &mesh = split.mesh;
    std::vector<std::string> warnings;
    for (const auto &support : scene.supports)
      if (support->is_free_field())
        if (const std::string joints =
              names_of_joints_at_side(*support, scene, split);
            !joints.empty())
          warnings.push_back(
            "The joints " + joints + " reach the free-field sides of '" +
            support->name +
            "', whose ground goes on without them and holds what they let "
            "move; end them before the sides, or give 'Supports/" +
            support->name + "/Kind' as quiet.");
    for (const auto &support : scene.supports)
      if (support->is_free_field() &&
          is_beside_yielding_rock(*support, scene, mesh))
        warnings.push_back(
          "The support '" + support->name +
          "' is a free field whose ground beside the model stays elastic, "
          "while the rock at it may yield; give the rock along the sides an "
          "elastic material if the shaking brings it to its strength.");
    return warnings;
  }

  template std::vector<std::string>
  warnings_of_free_fields(const Scene<2> &, const SplitMesh<2> &);
  template std::vector<std::string>
  warnings_of_free_fields(const Scene<3> &, const SplitMesh<3> &);
} // namespace Keyblock
