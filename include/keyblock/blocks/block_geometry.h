// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_blocks_block_geometry_h
#define keyblock_blocks_block_geometry_h

#include <keyblock/blocks/interface.h>

#include <string>
#include <variant>
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

    /** Joints share places, and the weaker one rules there. */
    bool depends_on_strength = false;

    /** warnings_of_coarse_mesh(), of those who ask for it. */
    std::vector<std::string> warnings;
  };

  /** The same of what the planes of the scene bound, without a mesh of its
   * rock (make_plane_mesh()); or why it has no planes, as list_planes() says.
   * Throws InputError.
   * @param is_about_exposed leave out joints that bound no exposed block */
  template <int dim>
  std::variant<BlockGeometry<dim>, std::string>
  make_plane_geometry(const Scene<dim> &scene, const bool is_about_exposed);

  /** Mesh the scene, find its blocks and split the mesh along their faces
   * (collective). Throws InputError.
   * @param out as in make_mesh() */
  template <int dim>
  BlockGeometry<dim> make_block_geometry(const Communicator &communicator,
                                         const Scene<dim> &scene,
                                         const dealii::ConditionalOStream &out);
} // namespace Keyblock

#endif
