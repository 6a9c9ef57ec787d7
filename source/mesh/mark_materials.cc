// SPDX-License-Identifier: LGPL-2.1-or-later
// Which cells are of which material.
#include <keyblock/mesh/mesh_marks.h>

#include <deal.II/base/utilities.h>

#include <keyblock/base/errors.h>
#include <keyblock/base/expression.h>

#include <algorithm>

namespace Keyblock
{
  namespace
  {
    /** The joints below and above the region `band A B` of a material. */
    template <int dim>
    std::array<const Joint<dim> *, 2>
    find_band(const Scene<dim> &scene, const Material<dim> &material)
    {
      const std::vector<std::string> words =
        dealii::Utilities::split_string_list(material.region, ' ');
      std::array<const Joint<dim> *, 2> band{};
      for (unsigned int i = 1; i < std::min<std::size_t>(words.size(), 3); ++i)
        for (const auto &joint : scene.joints)
          if (joint->name == words[i])
            band[i - 1] = joint.get();
      AssertThrow(words.size() == 3 && band[0] && band[1],
                  InputError("The entry 'Materials/" + material.name +
                             "/Region' is '" + material.region +
                             "'; a band is `band A B` with two names of "
                             "'Joints/Names'."));
      // the lower joint first: the upper one's points are above it
      const Point<dim> upper = band[1]->extent == JointShape::polygon
                                 ? band[1]->vertices[0]
                                 : band[1]->point;
      if (band[0]->distance(upper) < 0.)
        std::swap(band[0], band[1]);
      return band;
    }

    template <int dim>
    std::string
    regions_of(const Mesh<dim> &mesh)
    {
      return list_groups({mesh.region.begin(), mesh.region.end()},
                         mesh.region_names);
    }
  } // namespace



  template <int dim>
  void
  mark_materials(Mesh<dim> &mesh, const Scene<dim> &scene)
  {
    mesh.material.assign(mesh.n_cells(), none);
    for (unsigned int m = 0; m < scene.materials.size(); ++m)
      {
        const std::string &region = scene.materials[m]->region;
        unsigned int n_hits       = 0;
        const bool is_id          = region.rfind("id ", 0) == 0;
        const bool is_all         = region == "all";
        const bool is_band        = region.rfind("band ", 0) == 0;
        const auto band = is_band ? find_band(scene, *scene.materials[m])
                                  : std::array<const Joint<dim> *, 2>{};
        const Expression<dim> inside((is_id || is_all || is_band) ? "1"
                                                                  : region,
                                     1,
                                     "Materials/" + scene.materials[m]->name +
                                       "/Region");
        for (unsigned int c = 0; c < mesh.n_cells(); ++c)
          if (is_all ||
              (is_id &&
               means_group(region, mesh.region[c], mesh.region_names)) ||
              (is_band && band[0]->distance(mesh.cell_center(c)) > 0. &&
               band[1]->distance(mesh.cell_center(c)) < 0.) ||
              (!is_id && !is_band &&
               inside.value(mesh.cell_center(c), 0., 0) > 0.))
            {
              if (scene.materials[m]->stage.empty())
                mesh.material[c] = m;
              else
                {
                  mesh.later_materials.resize(mesh.n_cells());
                  mesh.later_materials[c].push_back(m);
                }
              ++n_hits;
            }
        AssertThrow(n_hits > 0,
                    InputError("No cell lies in the region '" + region +
                               "' of the entry 'Materials/" +
                               scene.materials[m]->name + "/Region'" +
                               (is_id ? "; the regions of the mesh are: " +
                                          regions_of(mesh)
                                      : "") +
                               "; correct it or drop the material."));
      }
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      AssertThrow(
        mesh.material[c] != none,
        InputError("A cell at " +
                   dealii::Utilities::to_string(mesh.cell_center(c)[0]) + ", " +
                   dealii::Utilities::to_string(mesh.cell_center(c)[1]) +
                   " has no material; extend one of the entries "
                   "'Materials/*/Region', for example the first to all."));
    for (unsigned int c = 0; c < mesh.later_materials.size(); ++c)
      for (const unsigned int later : mesh.later_materials[c])
        AssertThrow(!scene.materials[mesh.material[c]]->is_rigid(),
                    InputError("The entry 'Materials/" +
                               scene.materials[later]->name +
                               "/Region' contains cells of the rigid "
                               "material '" +
                               scene.materials[mesh.material[c]]->name +
                               "', which cannot change; restrict it to "
                               "deformable ones."));
  }

  template void mark_materials(Mesh<2> &, const Scene<2> &);
  template void mark_materials(Mesh<3> &, const Scene<3> &);
} // namespace Keyblock
