// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/step/passive_support.h>

namespace Keyblock
{
  template <int dim>
  Tensor<1, dim>
  PassiveSupport<dim>::taken(const Tensor<1, dim> &force,
                             const std::array<unsigned int, 2> &blocks,
                             const unsigned int joint,
                             const Tensor<1, dim> &normal) const
  {
    const double left = reduction.share_between(blocks[0], blocks[1], joint);
    if (left == 1.)
      return {};
    // of two blocks that move, that which is held more; one that is not itself
    // tried hangs on the other by the same joint, whose strength is divided
    bool is_any_known = false;
    double most       = 0.;
    Tensor<1, dim> against;
    for (unsigned int side = 0; side < 2; ++side)
      {
        const unsigned int block = blocks[side];
        if (block == none || block >= ways.size() ||
            ways[block].norm_square() == 0.)
          continue;
        is_any_known         = true;
        const double on_side = (side == 0 ? 1. : -1.) * (force * ways[block]);
        if (-on_side > most)
          {
            most    = -on_side;
            against = (force * ways[block]) * ways[block];
          }
      }
    if (!is_any_known)
      against = force - (force * normal) * normal;
    return (1. - left) * against;
  }

  template class PassiveSupport<2>;
  template class PassiveSupport<3>;
} // namespace Keyblock
