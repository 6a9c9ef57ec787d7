// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/rock/nodal_force.h>
#include <keyblock/step/block_balance.h>

#include <algorithm>
#include <cmath>

namespace Keyblock
{
  namespace
  {
    /** Share of the sizes of contact forces that the load of a block is taken
     * to be at least: of a weightless one between clamping faces [-]. */
    constexpr double least_share_of_contact = 1e-3;
  } // namespace



  template <int dim>
  double
  BlockBalance<dim>::unbalanced_ratio() const
  {
    return load > 0. ? norm<dim>(unbalanced_force) / load : 0.;
  }



  template <int dim>
  BlockBalance<dim>
  measure_balance(const Fields<dim> &fields,
                  const std::vector<unsigned int> &nodes,
                  const Communicator &communicator)
  {
    // resultant of everything but damping and supports, loads, size of contact
    // forces
    std::array<double, 2 * dim + 1> sums{};
    for (const unsigned int node : nodes)
      {
        Vector<dim> force = out_of_balance_force<dim>(fields, node);
        take_support_reactions<dim>(fields,
                                    node,
                                    force,
                                    [](double, const auto &) {});
        for (unsigned int d = 0; d < dim; ++d)
          {
            const unsigned int i = dim * node + d;
            if (fields.inverse_mass[node] > 0.)
              sums[d] += force[d];
            sums[dim + d] += fields.load[i];
            sums[2 * dim] += std::abs(fields.contact_force[i]);
          }
      }
    communicator.sum_lists(sums);
    BlockBalance<dim> balance;
    Vector<dim> weight{};
    for (unsigned int d = 0; d < dim; ++d)
      {
        balance.unbalanced_force[d] = sums[d];
        weight[d]                   = sums[dim + d];
      }
    balance.load =
      std::max(norm<dim>(weight), least_share_of_contact * sums[2 * dim]);
    return balance;
  }

  template struct BlockBalance<2>;
  template struct BlockBalance<3>;
  template BlockBalance<2> measure_balance(const Fields<2> &,
                                           const std::vector<unsigned int> &,
                                           const Communicator &);
  template BlockBalance<3> measure_balance(const Fields<3> &,
                                           const std::vector<unsigned int> &,
                                           const Communicator &);
} // namespace Keyblock
