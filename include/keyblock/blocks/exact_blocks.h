// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_blocks_exact_blocks_h
#define keyblock_blocks_exact_blocks_h

#include <keyblock/blocks/interface.h>
#include <keyblock/blocks/plane_blocks.h>

#include <string>
#include <variant>

namespace Keyblock
{
  /** The blocks between the planes of a scene, and their rock as a mesh
   * (make_plane_mesh()). */
  template <int dim>
  struct ExactBlocks
  {
    PlaneBlocks<dim> planes;
    SplitMesh<dim> split;
    Blocks<dim> blocks; ///< in the order of the planes
  };

  /** Find them; or why the scene has no planes, as list_planes() says.
   * @param is_about_exposed leave out joints that bound no exposed block */
  template <int dim>
  std::variant<ExactBlocks<dim>, std::string>
  find_exact_blocks(const Scene<dim> &scene, const bool is_about_exposed);

  /** Which blocks of a mesh are which between planes: those where each has more
   * than half of the other, and both are finite or none. */
  template <int dim>
  struct BlockMatch
  {
    BlockMatch(const Blocks<dim> &of_mesh,
               const Mesh<dim> &mesh,
               const ExactBlocks<dim> &exact);

    std::vector<unsigned int> like; ///< of each exact block that of the mesh
    std::vector<unsigned int> most; ///< of each of the mesh the exact one that
                                    ///< has most of it

    /** Whether a block (index) of the mesh is none of the exact ones. */
    bool
    is_phantom(const Blocks<dim> &of_mesh, const unsigned int block) const
    {
      return !of_mesh.blocks[block].is_infinite &&
             (most[block] == none || like[most[block]] != block);
    }
  };

  /**
   * Join blocks that the mesh alone has closed to the rock that they are a part
   * of: faces on joints beyond the rims of these are on none, or, where there
   * are no such, that which is nearest to a rim. Finds the blocks anew.
   * Returns how many were joined.
   */
  template <int dim>
  unsigned int weld_phantoms(Mesh<dim> &mesh,
                             Blocks<dim> &blocks,
                             const ExactBlocks<dim> &exact,
                             const Scene<dim> &scene);

  /**
   * Number the blocks of a mesh like those between planes, and the other way
   * round. The finite blocks between the planes come first, with what the
   * planes say of them in Block::exact and of when they are exposed; those that
   * the mesh has not have no cells. Other blocks of the mesh come after them,
   * and last what is infinite. Fills Blocks::comparison.
   */
  template <int dim>
  void number_like_planes(Blocks<dim> &blocks,
                          const Mesh<dim> &mesh,
                          ExactBlocks<dim> &exact);

  /** Weight of a mass in the scene, at its origin and time zero; in a scene
   * without gravity standard gravity [m/s2]. */
  template <int dim>
  double weight_per_mass(const Scene<dim> &scene);
} // namespace Keyblock

#endif
