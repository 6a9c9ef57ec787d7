// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_safety_block_moments_h
#define keyblock_safety_block_moments_h

#include <keyblock/safety/block_support.h>

namespace Keyblock
{
  /**
   * Whether the faces of a block balance all that acts on it, moments included,
   * see can_balance(): with strength divided by @p factor, and in the passive
   * convention what support and a pressure do against the way that the block
   * would take without support. Bolts act up to their capacity. True where not
   * all is known that may balance moments: of blocks that are joined to others,
   * are held by shotcrete or dowels, or have joints with tensile strength or
   * friction that depends on the stress on them.
   * @param pressed forces of a pressure on free faces
   * @param way which it would take with support (unit vector, or zero)
   */
  template <int dim>
  bool balances_moments(const BlockSurroundings<dim> &around,
                        const BlockSupport<dim> &support,
                        const bool is_passive,
                        const std::vector<PointForce<dim>> &pressed,
                        const Tensor<1, dim> &way,
                        const double factor);

  /** The greatest factor up to @p most for which balances_moments() holds; 0 if
   * it does for none, whatever the strength. */
  template <int dim>
  double greatest_balanced_factor(const BlockSurroundings<dim> &around,
                                  const BlockSupport<dim> &support,
                                  const bool is_passive,
                                  const Tensor<1, dim> &way,
                                  const double most);
} // namespace Keyblock

#endif
