// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_blocks_block_geometry_h
#define keyblock_blocks_block_geometry_h

#include <keyblock/blocks/interface.h>

#include <string>
#include <vector>

namespace Keyblock
{
  /** All that limit equilibrium needs of a scene's geometry: its blocks and the
   * mesh that has them, with bolts and shotcrete where they lie. */
  template <int dim>
  struct BlockGeometry
  {
    MeshQuality quality;
    MeshReport<dim> report; ///< on rank 0
    Blocks<dim> blocks;
    SplitMesh<dim> split;
    /** warnings_of_coarse_mesh(), of those who ask for it. */
    std::vector<std::string> warnings;
  };

  /** Mesh the scene, find its blocks and split the mesh along their faces
   * (collective). Throws InputError.
   * @param out as in make_mesh() */
  template <int dim>
  BlockGeometry<dim> make_block_geometry(const Communicator &communicator,
                                         const Scene<dim> &scene,
                                         const dealii::ConditionalOStream &out);
} // namespace Keyblock

#endif
