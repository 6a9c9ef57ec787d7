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
                 const unsigned int n,
                 const std::vector<double> &forces)
    {
      double sum = 0.;
      for (unsigned int i = 0; i < n; ++i)
        sum += std::abs(forces[i]);
      return communicator.sum(sum);
    }

    /** Changes that put less than this out of balance, over all forces of the
     * cells, are none [-]. */
    constexpr double negligible_change = 1e-9;
  } // namespace



  template <int dim>
  std::vector<double>
  ExplicitStep<dim>::excavate(const unsigned int number)
  {
    update_forces();
    // what a ramp that has not ended still carries is not to go at once
    const std::vector<double> before_change = list_out_of_balance();
    const double before = ledger.energy_of_cells(positions());
    conditions.excavate(number);
    if (contact)
      contact->remove_ties(number);
    conditions.set_damping(stage);
    work.excavated_energy = before - ledger.energy_of_cells(positions());
    update_forces();
    const std::vector<double> out_of_balance = list_out_of_balance();
    // the size of the change is what the stage is measured by, unless it is
    // none beside what was out of balance before
    std::vector<double> change(out_of_balance);
    for (unsigned int i = 0; i < change.size(); ++i)
      change[i] -= before_change[i];
    const auto size = [&](const std::vector<double> &forces) {
      return sum_of_sizes(numbering.communicator,
                          dim * numbering.n_owned(),
                          forces);
    };
    if (size(change) >
        std::max(size(before_change),
                 negligible_change * size(fields.internal_force)))
      // a block that is taken away later in the stage carries less
      out_of_balance_sum = std::max(out_of_balance_sum, size(out_of_balance));
    return out_of_balance;
  }



  template <int dim>
  std::vector<double>
  ExplicitStep<dim>::list_out_of_balance() const
  {
    std::vector<double> out_of_balance(dim * numbering.n_owned(), 0.);
    const double left = conditions.loads.ramp_share_left();
    const std::vector<double> &ramped =
      conditions.loads.state().out_of_balance_force;
    for (unsigned int node = 0; node < numbering.n_owned(); ++node)
      if (fields.inverse_mass[node] > 0.)
        for (unsigned int i = dim * node; i < dim * (node + 1); ++i)
          {
            out_of_balance[i] = fields.internal_force[i] - fields.load[i] -
                                fields.contact_force[i];
            if (left > 0. && !ramped.empty())
              out_of_balance[i] += left * ramped[i];
          }
    conditions.supports.remove_held_components(out_of_balance);
    return out_of_balance;
  }



  template <int dim>
  double
  ExplicitStep<dim>::share_of_excavated(
    const std::vector<double> &out_of_balance) const
  {
    return out_of_balance_sum > 0. ? sum_of_sizes(numbering.communicator,
                                                  out_of_balance.size(),
                                                  out_of_balance) /
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
