// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/disjoint_sets.h>
#include <keyblock/run/ramp_length.h>
#include <keyblock/step/equilibrium.h>

#include <cmath>

namespace Keyblock
{
  namespace
  {
    /** Ramp over the period of the lowest mode [-]. */
    constexpr double n_periods = 4.;

    /** Ramp over that of waves through the model, from which on the lowest mode
     * is one of bodies that float [-]. */
    constexpr double longest_ramp = 1e4;



    /** Blocks (by index) that are there and joined, face by face, to none that
     * is infinite, rigid or supported (collective). */
    template <int dim>
    std::vector<bool>
    find_loose_blocks(const Model<dim> &model)
    {
      const SplitMesh<dim> &split = model.split;
      const unsigned int n_blocks = model.blocks.blocks.size();
      // the last stands for rock that is to be dug and all that holds
      DisjointSets joined(n_blocks + 1);
      std::vector<unsigned int> block_of_vertex(split.mesh.vertices.size(),
                                                n_blocks);
      std::vector<double> is_supported(n_blocks, 0.);
      for (unsigned int c = 0; c < split.mesh.n_cells(); ++c)
        if (const unsigned int b = split.block_of_cell[c]; b != none)
          for (const unsigned int v : split.mesh.cells[c])
            {
              block_of_vertex[v]      = b;
              const unsigned int node = model.numbering->local_node(v);
              if (node != none && model.fields.support_of_node[node] >= 0)
                is_supported[b] = 1.;
            }
      model.communicator.max_lists(is_supported);
      const auto is_there = [&](const unsigned int b) {
        return b == n_blocks ||
               !model.conditions->active_cells.is_removed_block(b);
      };
      for (unsigned int b = 0; b < n_blocks; ++b)
        if (const Block<dim> &block = model.blocks.blocks[b];
            block.is_infinite || block.is_rigid || is_supported[b] > 0.)
          joined.join(b, n_blocks);
      for (const Pair<dim> &pair : split.interface.pairs)
        {
          const unsigned int minus = block_of_vertex[pair.minus],
                             plus  = block_of_vertex[pair.plus];
          if (is_there(minus) && is_there(plus))
            joined.join(minus, plus);
        }
      std::vector<bool> is_loose(n_blocks);
      for (unsigned int b = 0; b < n_blocks; ++b)
        is_loose[b] = is_there(b) && joined.root(b) != joined.root(n_blocks);
      return is_loose;
    }



    /** Supports of the model, and all nodes of blocks that are @p loose. */
    template <int dim>
    std::vector<NodeSupport<dim>>
    hold_blocks(const Model<dim> &model, const std::vector<bool> &is_loose)
    {
      std::map<unsigned int, NodeSupport<dim>> held;
      for (const NodeSupport<dim> &support : model.fields.supports)
        held[support.node] = support;
      const SplitMesh<dim> &split = model.split;
      for (unsigned int c = 0; c < split.mesh.n_cells(); ++c)
        if (split.block_of_cell[c] != none && is_loose[split.block_of_cell[c]])
          for (const unsigned int v : split.mesh.cells[c])
            {
              const unsigned int node = model.numbering->local_node(v);
              if (node == none || split.is_hanging(v))
                continue;
              NodeSupport<dim> fixed;
              fixed.node         = node;
              fixed.n_directions = dim;
              for (unsigned int d = 0; d < dim; ++d)
                fixed.directions[d][d] = 1.;
              held[node] = fixed;
            }
      std::vector<NodeSupport<dim>> supports;
      supports.reserve(held.size());
      for (const auto &[node, support] : held)
        supports.push_back(support);
      return supports;
    }
  } // namespace



  template <int dim>
  double
  find_ramp_duration(const Model<dim> &model)
  {
    const auto by_waves = [&model] {
      // a wave crosses a cell in a stable step
      return n_periods * 4. * std::pow(model.n_cells_global, 1. / dim) *
             model.step->dt / model.scene.time_stepping.safety;
    };
    // a model that floats has no lowest mode
    if (!model.communicator.on_any(!model.fields.supports.empty() ||
                                   !model.conditions->elements.empty()))
      return by_waves();
    const std::vector<NodeSupport<dim>> supports =
      hold_blocks(model, find_loose_blocks(model));
    StaticSolver<dim> solver(model.split,
                             *model.numbering,
                             model.cells,
                             model.fields,
                             supports,
                             model.conditions->elements);
    try
      {
        // bodies that nothing but contacts found by search holds float, too
        const double ramp = n_periods * solver.lowest_period();
        return ramp < longest_ramp * by_waves() ? ramp : by_waves();
      }
    catch (const ComputationError &)
      {
        return by_waves();
      }
  }

  template double find_ramp_duration(const Model<2> &);
  template double find_ramp_duration(const Model<3> &);
} // namespace Keyblock
