// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/symmetric_tensor.h>

#include <keyblock/mesh/mesh.h>
#include <keyblock/step/guided_blocks.h>

namespace Keyblock
{
  namespace
  {
    /** Part of all that is held which has to be along the direction that is
     * held least [-]. */
    constexpr double least_part = 1e-6;
  } // namespace



  template <int dim>
  std::vector<bool>
  mark_guided_blocks(const Fields<dim> &fields,
                     const std::vector<std::vector<unsigned int>> &nodes,
                     const Communicator &communicator)
  {
    std::vector<unsigned int> block_of(fields.reference.size() / dim, none);
    for (unsigned int b = 0; b < nodes.size(); ++b)
      for (const unsigned int node : nodes[b])
        block_of[node] = b;
    // of each block the sum of dyads of held directions, and how often it is
    // moved
    constexpr unsigned int n_sums = dim * dim + 1;
    std::vector<double> sums(n_sums * nodes.size(), 0.);
    for (const NodeSupport<dim> &support : fields.supports)
      if (const unsigned int block = block_of[support.node]; block != none)
        {
          double *const held = sums.data() + n_sums * block;
          for (unsigned int k = 0; k < support.n_directions; ++k)
            for (unsigned int i = 0; i < dim; ++i)
              for (unsigned int j = 0; j < dim; ++j)
                held[dim * i + j] +=
                  support.directions[k][i] * support.directions[k][j];
          held[dim * dim] += support.is_moved();
        }
    communicator.sum_lists(sums);
    std::vector<bool> is_guided;
    for (unsigned int b = 0; b < nodes.size(); ++b)
      {
        const double *const held = sums.data() + n_sums * b;
        dealii::SymmetricTensor<2, dim> dyads;
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = i; j < dim; ++j)
            dyads[i][j] = held[dim * i + j];
        is_guided.push_back(held[dim * dim] > 0. ||
                            dealii::eigenvalues(dyads).back() >
                              least_part * dealii::trace(dyads));
      }
    return is_guided;
  }

  template std::vector<bool>
  mark_guided_blocks(const Fields<2> &,
                     const std::vector<std::vector<unsigned int>> &,
                     const Communicator &);
  template std::vector<bool>
  mark_guided_blocks(const Fields<3> &,
                     const std::vector<std::vector<unsigned int>> &,
                     const Communicator &);
} // namespace Keyblock
