// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef keyblock_step_rock_binding_h
#define keyblock_step_rock_binding_h

#include <keyblock/blocks/bolt_layout.h>
#include <keyblock/rock/dofs.h>

#include <utility>

namespace Keyblock
{
  /** A point of the rock, and the nodes of this rank that carry it. */
  template <int dim>
  struct RockBinding
  {
    bool is_held = false;                                  ///< there is rock
    std::vector<std::pair<unsigned int, double>> carriers; ///< node, weight

    RockBinding() = default;

    RockBinding(const CellPoint<dim> &point,
                const Ground<dim> &ground,
                const Numbering<dim> &numbering)
      : is_held(is_there(point, ground))
    {
      if (!is_held)
        return;
      const auto &corners = ground.split.mesh.cells[point.cell];
      for (unsigned int v = 0; v < corners.size(); ++v)
        if (point.weight[v] != 0.)
          for_each_owned_carrier(
            ground.split,
            numbering,
            corners[v],
            [&](const unsigned int node, const double weight) {
              carriers.emplace_back(node, weight * point.weight[v]);
            });
    }

    /** This rank's part of the displacement there [m]. */
    Tensor<1, dim>
    part_of(const std::vector<double> &displacement) const
    {
      Tensor<1, dim> u;
      for (const auto &[node, weight] : carriers)
        for (unsigned int d = 0; d < dim; ++d)
          u[d] += weight * displacement[dim * node + d];
      return u;
    }

    /** Add @p force on the rock there to forces on this rank's nodes [N]. */
    void
    add(const Tensor<1, dim> &force, std::vector<double> &forces) const
    {
      for (const auto &[node, weight] : carriers)
        for (unsigned int d = 0; d < dim; ++d)
          forces[dim * node + d] += weight * force[d];
    }
  };
} // namespace Keyblock

#endif
