// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_block_faces_h
#define keyblock_block_faces_h

#include <keyblock/limit_equilibrium.h>
#include <keyblock/snapshot.h>

namespace Keyblock
{
  /** The joints that @p block touches now, one face per joint and side, with
   * their strengths and the force of water in them. */
  template <int dim>
  std::vector<BlockFace<dim>> list_faces(const Scene<dim> &scene,
                                         const SplitMesh<dim> &split,
                                         const Conditions<dim> &conditions,
                                         const Block<dim> &block);

  /** Gravity and seismic load of @p block at @p time [N]. */
  template <int dim>
  Tensor<1, dim> weight_of(const Scene<dim> &scene,
                           const Block<dim> &block,
                           const double time);

  /** Shear strength over shear force on the faces that a block slides on
   * (@p sliding, indices; empty: on all), with the forces of now; 0: none. */
  template <int dim>
  double stress_ratio(const Scene<dim> &scene,
                      const std::vector<BlockFace<dim>> &faces,
                      const std::vector<unsigned int> &sliding,
                      const std::vector<JointSums<dim>> &sums);
} // namespace Keyblock

#endif
