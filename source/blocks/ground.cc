// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/blocks/ground.h>

#include <algorithm>

namespace Keyblock
{
  template <int dim>
  bool
  Ground<dim>::is_filled(const unsigned int cell) const
  {
    if (split.mesh.excavation_stage[cell] == 0)
      return false;
    const Excavation<dim> &excavation =
      *scene.excavations[split.mesh.excavation[cell]];
    return !excavation.backfill_stage.empty() &&
           scene.stage_number(excavation.backfill_stage) <= stage_number;
  }



  template <int dim>
  bool
  Ground<dim>::is_excavated(const unsigned int cell) const
  {
    const unsigned int block = split.block_of_cell[cell];
    if (block != none && is_removed != nullptr && !is_removed->empty() &&
        (*is_removed)[block])
      return true;
    const unsigned int excavated = split.mesh.excavation_stage[cell];
    return excavated > 0 && excavated <= stage_number && !is_filled(cell);
  }



  template <int dim>
  unsigned int
  Ground<dim>::material_of(const unsigned int cell) const
  {
    if (!is_filled(cell))
      return natural_material_of(cell);
    const Excavation<dim> &excavation =
      *scene.excavations[split.mesh.excavation[cell]];
    return last_material_of(cell,
                            scene.material_index(excavation.backfill_material),
                            scene.stage_number(excavation.backfill_stage));
  }



  template <int dim>
  unsigned int
  Ground<dim>::natural_material_of(const unsigned int cell) const
  {
    return last_material_of(cell, split.mesh.material[cell], 0);
  }



  template <int dim>
  unsigned int
  Ground<dim>::last_material_of(const unsigned int cell,
                                const unsigned int material,
                                const unsigned int since) const
  {
    unsigned int last = material, last_since = since;
    if (!split.mesh.later_materials.empty())
      for (const unsigned int later : split.mesh.later_materials[cell])
        {
          const unsigned int from =
            scene.stage_number(scene.materials[later]->stage);
          if (from <= stage_number && from >= last_since)
            {
              last       = later;
              last_since = from;
            }
        }
    return last;
  }



  template <int dim>
  bool
  is_changing(const Scene<dim> &scene, const unsigned int number)
  {
    for (const auto &excavation : scene.excavations)
      if (scene.stage_number(excavation->stage) == number ||
          (!excavation->backfill_stage.empty() &&
           scene.stage_number(excavation->backfill_stage) == number))
        return true;
    for (const auto &traction : scene.tractions)
      if (scene.stage_number(traction->stage) == number)
        return true;
    for (const auto &set : scene.bolts)
      if (scene.stage_number(set->stage) == number)
        return true;
    for (const auto &liner : scene.liners)
      if (scene.stage_number(liner->stage) == number)
        return true;
    for (const auto &stage : scene.stages)
      if ((!stage->water_level.empty() || !stage->drained_joints.empty() ||
           !stage->seismic_coefficient.empty()) &&
          scene.stage_number(stage->name) == number)
        return true;
    for (const auto &support : scene.supports)
      if (number > 1 && support->is_quiet() &&
          scene.stage_number(support->stage) == number)
        return true;
    for (const auto &material : scene.materials)
      if (!material->stage.empty() &&
          scene.stage_number(material->stage) == number)
        return true;
    return false;
  }



  template <int dim>
  std::vector<CellFace>
  list_free_faces(const Ground<dim> &ground)
  {
    const Mesh<dim> &mesh = ground.split.mesh;
    std::vector<std::array<bool, Mesh<dim>::n_cell_faces>> is_covered(
      mesh.n_cells());
    for (auto &faces : is_covered)
      faces.fill(false);
    for (const JointFace &face : ground.split.interface.joint_faces)
      if (!ground.is_excavated(face.minus_cell) &&
          !ground.is_excavated(face.plus_cell))
        is_covered[face.minus_cell][face.minus_face] =
          is_covered[face.plus_cell][face.plus_face] = true;
    std::vector<CellFace> free;
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      if (!ground.is_excavated(c))
        for (unsigned int f = 0; f < Mesh<dim>::n_cell_faces; ++f)
          {
            const unsigned int other = mesh.neighbor[c][f];
            if (!is_covered[c][f] &&
                (other == none || ground.is_excavated(other)))
              free.push_back({c, f});
          }
    return free;
  }



  template <int dim>
  LoadedRegion<dim>::LoadedRegion(const Traction<dim> &traction)
    : inside(traction.region.empty() ? "-1" : traction.region,
             1,
             "Tractions/*/Region")
  {}



  template <int dim>
  bool
  LoadedRegion<dim>::has(const Point<dim> &center,
                         const Point<dim> &place) const
  {
    constexpr double hair = 1e-6; // of the way to the centre [-]
    return inside.value(place + hair * (center - place), 0., 0) > 0.;
  }



  template <int dim>
  std::vector<LoadedFace>
  list_loaded_faces(const Ground<dim> &ground,
                    const std::vector<CellFace> &free,
                    const Traction<dim> &traction)
  {
    if (ground.scene.stage_number(traction.stage) > ground.stage_number)
      return {};
    const Mesh<dim> &mesh  = ground.split.mesh;
    constexpr double reach = 0.8; // to corners that are looked at [-]
    const LoadedRegion<dim> region(traction);
    std::vector<LoadedFace> loaded;
    for (const CellFace &f : free)
      {
        const bool is_on_boundary =
          std::any_of(traction.boundaries.begin(),
                      traction.boundaries.end(),
                      [&](const std::string &name) {
                        return mesh.is_on(f.cell, f.face, name);
                      });
        if (is_on_boundary)
          loaded.push_back({{f}, true});
        if (is_on_boundary || traction.region.empty())
          continue;
        const Point<dim> center = mesh.face_center(f.cell, f.face);
        // (a region that is said with a margin reaches round an edge)
        bool is_inside = region.has(center, center), is_all_inside = is_inside;
        for (const unsigned int v : mesh.face_vertices(f.cell, f.face))
          {
            const Tensor<1, dim> way = mesh.vertices[v] - center;
            is_inside = is_inside || region.has(center, center + reach * way);
            is_all_inside = is_all_inside && region.has(center, center + way);
          }
        if (is_inside)
          loaded.push_back({{f}, is_all_inside});
      }
    return loaded;
  }

#define INSTANTIATE(dim)                                                       \
  template struct Ground<dim>;                                                 \
  template bool is_changing(const Scene<dim> &, const unsigned int);           \
  template std::vector<CellFace> list_free_faces(const Ground<dim> &);         \
  template class LoadedRegion<dim>;                                            \
  template std::vector<LoadedFace> list_loaded_faces(                          \
    const Ground<dim> &,                                                       \
    const std::vector<CellFace> &,                                             \
    const Traction<dim> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock
