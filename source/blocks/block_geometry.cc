// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/blocks/block_geometry.h>
#include <keyblock/blocks/block_measures.h>
#include <keyblock/blocks/block_resolution.h>
#include <keyblock/blocks/bolt_layout.h>
#include <keyblock/blocks/liner_layout.h>
#include <keyblock/blocks/plane_mesh.h>
#include <keyblock/blocks/plane_scene.h>

#include <memory>
#include <tuple>

namespace Keyblock
{
  namespace
  {
    /** The blocks between the planes of a scene, if it has any. */
    template <int dim>
    struct PlaneGeometry
    {
      PlaneBlocks<dim> planes;
      SplitMesh<dim> split;
      Blocks<dim> blocks;
    };

    template <int dim>
    std::variant<PlaneGeometry<dim>, std::string>
    find_between_planes(const Scene<dim> &scene, const bool is_about_exposed)
    {
      const auto listed = list_planes(scene);
      if (std::holds_alternative<std::string>(listed))
        return std::get<std::string>(listed);
      const auto &list          = std::get<PlaneScene<dim>>(listed);
      PlaneBlockOptions options = plane_block_options(list);
      options.leave_out         = is_about_exposed;
      PlaneGeometry<dim> found{find_plane_blocks(list, options), {}, {}};
      found.split  = make_plane_mesh(found.planes, scene);
      found.blocks = list_plane_blocks(found.planes, scene, found.split);
      return found;
    }
  } // namespace



  template <int dim>
  BlockGeometry<dim>
  make_block_geometry(const Communicator &communicator,
                      const Scene<dim> &scene,
                      const dealii::ConditionalOStream &out)
  {
    BlockGeometry<dim> result;
    Mesh<dim> mesh;
    std::tie(mesh, result.blocks) =
      make_mesh_for_blocks(communicator, scene, out);
    result.quality = measure_quality(mesh);
    result.report  = mesh.report;
    std::shared_ptr<SplitMesh<dim>> between_planes;
    if (auto found = find_between_planes(scene, false);
        std::holds_alternative<PlaneGeometry<dim>>(found) &&
        !scene.joints.empty())
      {
        auto &exact    = std::get<PlaneGeometry<dim>>(found);
        between_planes = std::make_shared<SplitMesh<dim>>(exact.split);
        number_like_planes(result.blocks,
                           mesh,
                           exact.planes,
                           exact.blocks,
                           between_planes->block_of_cell);
      }
    result.split        = split_mesh(mesh, result.blocks, scene);
    result.split.bolts  = lay_out_bolts(scene, result.split);
    result.split.liners = lay_out_liners(scene, result.split);
    if (between_planes)
      {
        between_planes->bolts =
          lay_out_bolts_like(result.split.bolts, scene, *between_planes);
        between_planes->liners      = lay_out_liners(scene, *between_planes);
        result.split.between_planes = between_planes;
      }
    result.depends_on_strength = !mesh.report.merged.empty();
    return result;
  }



  template <int dim>
  std::variant<BlockGeometry<dim>, std::string>
  make_plane_geometry(const Scene<dim> &scene, const bool is_about_exposed)
  {
    auto found = find_between_planes(scene, is_about_exposed);
    if (std::holds_alternative<std::string>(found))
      return std::get<std::string>(found);
    auto &exact = std::get<PlaneGeometry<dim>>(found);
    BlockGeometry<dim> result;
    result.split               = std::move(exact.split);
    result.blocks              = std::move(exact.blocks);
    result.depends_on_strength = exact.planes.has_shared_places;
    result.split.bolts         = lay_out_bolts(scene, result.split);
    result.split.liners        = lay_out_liners(scene, result.split);
    return result;
  }

#define INSTANTIATE(dim)                                                       \
  template BlockGeometry<dim> make_block_geometry(                             \
    const Communicator &,                                                      \
    const Scene<dim> &,                                                        \
    const dealii::ConditionalOStream &);                                       \
  template std::variant<BlockGeometry<dim>, std::string> make_plane_geometry(  \
    const Scene<dim> &, const bool);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock
