// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_block_faces_h
#define keyblock_block_faces_h

#include <keyblock/limit_equilibrium.h>
#include <keyblock/snapshot.h>

#include <functional>

namespace Keyblock
{
  /** Which cells of the split mesh are not there (any more). */
  using IsDug = std::function<bool(unsigned int)>;

  /** The joints that @p block touches, one face per joint and side, with their
   * strengths and the force of water in them, summed as contact sums it. */
  template <int dim>
  std::vector<BlockFace<dim>> list_faces(const Scene<dim> &scene,
                                         const SplitMesh<dim> &split,
                                         const IsDug &is_dug,
                                         const Block<dim> &block);

  /** Gravity, seismic load, and tractions on the free faces of @p block, in
   * stage @p number at @p time [N]. */
  template <int dim>
  Tensor<1, dim> load_on(const Scene<dim> &scene,
                         const SplitMesh<dim> &split,
                         const IsDug &is_dug,
                         const Block<dim> &block,
                         const unsigned int number,
                         const double time);

  /** Limit equilibrium of the finite blocks after each stage, by geometry and
   * scene alone, in one line each. */
  template <int dim>
  void print_limit_equilibria(std::ostream &out,
                              const Scene<dim> &scene,
                              const SplitMesh<dim> &split,
                              const Blocks<dim> &blocks);

  /** Shear strength over shear force on the faces that a block slides on
   * (@p sliding, indices; empty: on all), with the forces of now; 0: none. */
  template <int dim>
  double stress_ratio(const Scene<dim> &scene,
                      const std::vector<BlockFace<dim>> &faces,
                      const std::vector<unsigned int> &sliding,
                      const std::vector<JointSums<dim>> &sums);
} // namespace Keyblock

#endif
