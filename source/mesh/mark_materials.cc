// SPDX-License-Identifier: LGPL-2.1-or-later
// Which cells are of which material.
#include <keyblock/mesh/material_region.h>
#include <keyblock/mesh/mesh_marks.h>

#include <deal.II/base/utilities.h>

#include <keyblock/base/errors.h>

namespace Keyblock
{
  namespace
  {
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
        const MaterialRegion<dim> place(scene, *scene.materials[m]);
        for (unsigned int c = 0; c < mesh.n_cells(); ++c)
          if (place.is_group()
                ? means_group(region, mesh.region[c], mesh.region_names)
                : place.contains(mesh.cell_center(c)))
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
                    InputError(
                      "No cell lies in the region '" + region +
                      "' of the entry 'Materials/" + scene.materials[m]->name +
                      "/Region'" +
                      (place.is_group()
                         ? "; the regions of the mesh are: " + regions_of(mesh)
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
