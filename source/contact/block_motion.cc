// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparse_direct.h>
#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/vector.h>

#include <keyblock/contact/block_motion.h>

#include <map>

namespace Keyblock
{
  namespace
  {
    /** Weight of a block's own displacement beside those across its faces, over
     * a face as large as the block: it decides where they tell nothing [-]. */
    constexpr double displacement_weight = 1e-6;
  } // namespace



  template <int dim>
  BlockMotions<dim>::BlockMotions(const PairTopology<dim> &topology,
                                  const Blocks<dim> &blocks,
                                  const Fields<dim> &fields,
                                  const ContactMemory<dim> &memory)
    : topology(topology)
    , blocks(blocks)
    , fields(fields)
    , memory(memory)
    , link_of_pair(topology.interface.pairs.size(), none)
    , nodes_of_block(owned_nodes_of_blocks(topology.split,
                                           topology.numbering,
                                           blocks.blocks.size()))
  {
    std::map<Link, unsigned int> index;
    for (unsigned int p = 0; p < link_of_pair.size(); ++p)
      {
        Link link = topology.blocks_of_pair(p);
        if (link[0] == link[1])
          continue;
        for (unsigned int &block : link)
          if (block != none && blocks.blocks[block].is_infinite)
            block = none;
        if (link[0] == none && link[1] == none)
          continue;
        const auto [at, is_new] = index.emplace(link, links.size());
        if (is_new)
          links.push_back(link);
        link_of_pair[p] = at->second;
      }
  }



  template <int dim>
  std::vector<double>
  BlockMotions<dim>::sum_over_faces(const std::vector<double> &motion) const
  {
    std::vector<double> sums((1 + dim) * (links.size() + 1), 0.);
    const auto add = [&](const unsigned int place,
                         const double area,
                         const double sign,
                         const unsigned int vertex) {
      const unsigned int node = topology.numbering.local_node(vertex);
      for (unsigned int d = 0; d < dim; ++d)
        sums[(1 + dim) * place + 1 + d] += sign * area * motion[dim * node + d];
    };
    for (unsigned int p = 0; p < link_of_pair.size(); ++p)
      {
        const unsigned int i = link_of_pair[p];
        if (i == none || memory.state[p].is_removed ||
            !topology.is_primary(topology.group_of_pair[p]))
          continue;
        const Pair<dim> &pair = topology.interface.pairs[p];
        sums[(1 + dim) * i] += pair.area;
        add(i, pair.area, 1., pair.plus);
        add(i, pair.area, -1., pair.minus);
        if (links[i][0] != none && links[i][1] != none)
          continue;
        sums[(1 + dim) * links.size()] += pair.area;
        add(links.size(),
            pair.area,
            1.,
            links[i][0] == none ? pair.minus : pair.plus);
      }
    topology.numbering.communicator.sum_lists(sums);
    return sums;
  }



  template <int dim>
  std::vector<double>
  BlockMotions<dim>::sum_over_masses(const std::vector<double> &motion) const
  {
    std::vector<double> sums((2 + 2 * dim) * nodes_of_block.size(), 0.);
    for (unsigned int b = 0; b < nodes_of_block.size(); ++b)
      {
        double *const sum = &sums[(2 + 2 * dim) * b];
        for (const unsigned int node : nodes_of_block[b])
          {
            const double m = fields.weighing_mass[node];
            sum[0] += m;
            for (unsigned int d = 0; d < dim; ++d)
              {
                const double u = motion[dim * node + d];
                sum[1 + d] += m * u;
                sum[1 + dim] += m * u * u;
                sum[2 + dim + d] += fields.load[dim * node + d];
              }
          }
      }
    topology.numbering.communicator.sum_lists(sums);
    return sums;
  }



  template <int dim>
  std::vector<BlockMotion<dim>>
  BlockMotions<dim>::measure(const std::vector<double> &motion) const
  {
    const unsigned int n_blocks = blocks.blocks.size();
    std::vector<BlockMotion<dim>> motions(n_blocks);
    const std::vector<double> faces  = sum_over_faces(motion),
                              masses = sum_over_masses(motion);

    dealii::DynamicSparsityPattern entries(n_blocks, n_blocks);
    for (unsigned int b = 0; b < n_blocks; ++b)
      entries.add(b, b);
    for (const Link &link : links)
      if (link[0] != none && link[1] != none)
        {
          entries.add(link[0], link[1]);
          entries.add(link[1], link[0]);
        }
    dealii::SparsityPattern pattern;
    pattern.copy_from(entries);
    dealii::SparseMatrix<double> matrix(pattern);
    std::array<dealii::Vector<double>, dim> shift;
    for (dealii::Vector<double> &component : shift)
      component.reinit(n_blocks);

    for (unsigned int i = 0; i < links.size(); ++i)
      {
        const double *const sum = &faces[(1 + dim) * i];
        for (unsigned int side = 0; side < 2; ++side)
          if (const unsigned int b = links[i][side]; b != none)
            {
              matrix.add(b, b, sum[0]);
              if (links[i][1 - side] != none)
                matrix.add(b, links[i][1 - side], -sum[0]);
              for (unsigned int d = 0; d < dim; ++d)
                shift[d][b] += (side == 0 ? -1. : 1.) * sum[1 + d];
            }
      }
    const double *const wall = &faces[(1 + dim) * links.size()];
    for (unsigned int b = 0; b < n_blocks; ++b)
      {
        const double *const sum = &masses[(2 + 2 * dim) * b];
        const double weight =
          displacement_weight * std::pow(blocks.blocks[b].size, dim - 1);
        matrix.add(b, b, weight);
        if (blocks.blocks[b].is_infinite || !(sum[0] > 0.))
          continue;
        double square = sum[1 + dim] / sum[0];
        for (unsigned int d = 0; d < dim; ++d)
          {
            const double mean = sum[1 + d] / sum[0];
            shift[d][b] +=
              weight * (mean - (wall[0] > 0. ? wall[1 + d] / wall[0] : 0.));
            square -= mean * mean;
          }
        motions[b].spread = std::sqrt(std::max(0., square));
        double load       = 0.;
        for (unsigned int d = 0; d < dim; ++d)
          load += sum[2 + dim + d] * sum[2 + dim + d];
        motions[b].load = std::sqrt(load);
      }
    dealii::SparseDirectUMFPACK solver;
    solver.initialize(matrix);
    for (unsigned int d = 0; d < dim; ++d)
      {
        solver.solve(shift[d]);
        for (unsigned int b = 0; b < n_blocks; ++b)
          motions[b].shift[d] = shift[d][b];
      }
    return motions;
  }



  template class BlockMotions<2>;
  template class BlockMotions<3>;
} // namespace Keyblock
