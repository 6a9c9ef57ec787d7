// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/blocks/block_geometry.h>
#include <keyblock/blocks/block_resolution.h>
#include <keyblock/blocks/bolt_layout.h>
#include <keyblock/blocks/liner_layout.h>

#include <tuple>

namespace Keyblock
{
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
    result.quality      = measure_quality(mesh);
    result.report       = mesh.report;
    result.split        = split_mesh(mesh, result.blocks, scene);
    result.split.bolts  = lay_out_bolts(scene, result.split);
    result.split.liners = lay_out_liners(scene, result.split);
    return result;
  }

  template BlockGeometry<2>
  make_block_geometry(const Communicator &,
                      const Scene<2> &,
                      const dealii::ConditionalOStream &);
  template BlockGeometry<3>
  make_block_geometry(const Communicator &,
                      const Scene<3> &,
                      const dealii::ConditionalOStream &);
} // namespace Keyblock
