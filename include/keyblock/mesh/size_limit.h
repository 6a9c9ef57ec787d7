// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_mesh_size_limit_h
#define keyblock_mesh_size_limit_h

#include <keyblock/mesh/size.h>

#include <functional>
#include <string>

namespace Keyblock
{
  /** Memory that this process may use [bytes]: the least of what the machine
   * has, of the limit of its control group and of `ulimit -v`. */
  double usable_memory();

  /** What a run needs for a mesh of @p n_cells cells and @p n_joints joints
   * [bytes], all ranks together: measured, see mesh/size_limit.cc. */
  template <int dim>
  double needed_memory(const double n_cells, const std::size_t n_joints);

  /**
   * Throw InputError if a mesh of about @p n_cells cells does not fit into
   * memory, or has more nodes and faces than 32-bit numbers count. @p origin:
   * what asks for them, as the subject of the sentence; @p remedy: what to do
   * so that the cells are this factor [-] fewer.
   */
  template <int dim>
  void require_size(const double n_cells,
                    const std::size_t n_joints,
                    const std::string &origin,
                    const std::function<std::string(double)> &remedy);

  /**
   * About how many cells of the wanted @p size lie between @p low and @p high
   * [m]: the integral of 1 / size^dim, over boxes that are halved where the
   * size changes much within them; at most @p enough, where it stops.
   */
  template <int dim>
  double estimate_cells(const MeshSize<dim> &size,
                        const Point<dim> &low,
                        const Point<dim> &high,
                        const double enough);
} // namespace Keyblock

#endif
