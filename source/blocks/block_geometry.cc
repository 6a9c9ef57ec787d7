// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/errors.h>
#include <keyblock/blocks/block_geometry.h>
#include <keyblock/blocks/block_resolution.h>
#include <keyblock/blocks/bolt_layout.h>
#include <keyblock/blocks/exact_blocks.h>
#include <keyblock/blocks/liner_layout.h>
#include <keyblock/mesh/mesh_marks.h>

#include <algorithm>
#include <memory>
#include <tuple>

namespace Keyblock
{
  template <int dim>
  BlockGeometry<dim>
  make_block_geometry(const Communicator &communicator,
                      const Scene<dim> &scene,
                      const dealii::ConditionalOStream &out)
  {
    std::unique_ptr<ExactBlocks<dim>> exact;
    BlockGeometry<dim> result;
    Mesh<dim> mesh;
    std::tie(mesh, result.blocks) =
      make_mesh_for_blocks(communicator, scene, exact, out);
    result.quality = measure_quality(mesh);
    result.report  = mesh.report;
    if (exact)
      number_like_planes(result.blocks, mesh, *exact);
    result.split        = split_mesh(mesh, result.blocks, scene);
    result.split.bolts  = lay_out_bolts(scene, result.split);
    result.split.liners = lay_out_liners(scene, result.split);
    if (exact)
      {
        auto between_planes =
          std::make_shared<SplitMesh<dim>>(std::move(exact->split));
        between_planes->bolts =
          lay_out_bolts_like(result.split.bolts, scene, *between_planes);
        between_planes->liners      = lay_out_liners(scene, *between_planes);
        result.split.between_planes = between_planes;
      }
    result.depends_on_strength = !mesh.report.merged.empty();
    return result;
  }



  namespace
  {
    /** Refuse scenes whose excavations contain nothing, or all. */
    template <int dim>
    void
    check_excavations(const ExactBlocks<dim> &exact, const Scene<dim> &scene)
    {
      const auto &of_cell = exact.planes.excavation_of_cell;
      for (unsigned int e = 0; e < scene.excavations.size(); ++e)
        AssertThrow(std::find(of_cell.begin(), of_cell.end(), e) !=
                      of_cell.end(),
                    InputError("The excavation '" + scene.excavations[e]->name +
                               "' contains no rock that is not excavated "
                               "before; check 'Excavations/" +
                               scene.excavations[e]->name +
                               "' against the domain."));
      AssertThrow(exact.split.mesh.n_cells() > 0,
                  InputError("The excavations take away all rock before the "
                             "first stage; check the section 'Excavations' "
                             "against 'Domain'."));
      check_rock_is_left(exact.split.mesh, scene);
    }
  } // namespace



  template <int dim>
  std::variant<BlockGeometry<dim>, std::string>
  make_plane_geometry(const Scene<dim> &scene, const bool is_about_exposed)
  {
    auto found = find_exact_blocks(scene, is_about_exposed);
    if (std::holds_alternative<std::string>(found))
      return std::get<std::string>(found);
    auto &exact = std::get<ExactBlocks<dim>>(found);
    check_excavations(exact, scene);
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
