// SPDX-License-Identifier: LGPL-2.1-or-later
// What a stage changes, and what it leaves out of balance.
#include <keyblock/step/step.h>

#include <algorithm>
#include <cmath>

namespace Keyblock
{
  namespace
  {
    double
    sum_of_sizes(const Communicator &communicator,
                 const std::vector<double> &forces)
    {
      double sum = 0.;
      for (const double force : forces)
        sum += std::abs(force);
      return communicator.sum(sum);
    }
  } // namespace



  template <int dim>
  std::vector<double>
  ExplicitStep<dim>::excavate(const unsigned int number)
  {
    update_forces();
    const double before = ledger.energy_of_cells(positions());
    conditions.excavate(number);
    conditions.set_damping(stage);
    work.excavated_energy = before - ledger.energy_of_cells(positions());
    update_forces();
    std::vector<double> out_of_balance(dim * numbering.n_owned(), 0.);
    for (unsigned int node = 0; node < numbering.n_owned(); ++node)
      if (fields.inverse_mass[node] > 0.)
        for (unsigned int i = dim * node; i < dim * (node + 1); ++i)
          out_of_balance[i] =
            fields.internal_force[i] - fields.load[i] - fields.contact_force[i];
    conditions.supports.remove_held_components(out_of_balance);
    // a block that is taken away later in the stage carries less
    out_of_balance_sum =
      std::max(out_of_balance_sum,
               sum_of_sizes(numbering.communicator, out_of_balance));
    return out_of_balance;
  }



  template <int dim>
  double
  ExplicitStep<dim>::share_of_excavated(
    const std::vector<double> &out_of_balance) const
  {
    return out_of_balance_sum > 0.
             ? sum_of_sizes(numbering.communicator, out_of_balance) /
                 out_of_balance_sum
             : 0.;
  }

#define INSTANTIATE(dim)                                                       \
  template std::vector<double> ExplicitStep<dim>::excavate(                    \
    const unsigned int);                                                       \
  template double ExplicitStep<dim>::share_of_excavated(                       \
    const std::vector<double> &) const;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock
