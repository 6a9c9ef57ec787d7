// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/safety/support_state.h>

#include <algorithm>

namespace Keyblock
{
  namespace
  {
    /** Way in the direction of a block, over its own, from which on another one
     * carries it along [-]. */
    constexpr double carrying_share = 0.5;
  } // namespace



  template <int dim>
  SupportState<dim>
  measure_support(const ForceElements<dim> &elements,
                  const Fields<dim> &fields,
                  const std::vector<std::vector<unsigned int>> &nodes_of_block,
                  const std::vector<bool> &is_wanted,
                  const Communicator &communicator)
  {
    SupportState<dim> state;
    if (elements.empty())
      return state;
    std::vector<double> force(fields.load.size(), 0.);
    for (const auto &element : elements)
      element->add_force(fields.displacement, force);
    constexpr unsigned int n = SupportState<dim>::n_numbers;
    state.numbers.assign(n * nodes_of_block.size(), 0.);
    for (unsigned int b = 0; b < nodes_of_block.size(); ++b)
      if (is_wanted[b])
        for (const unsigned int node : nodes_of_block[b])
          {
            double *const sum = state.numbers.data() + n * b;
            sum[2 * dim] += fields.mass[node];
            for (unsigned int d = 0; d < dim; ++d)
              {
                const unsigned int i = dim * node + d;
                sum[d] += force[i];
                sum[dim + d] += fields.mass[node] * fields.displacement[i];
              }
          }
    communicator.sum_lists(state.numbers);
    for (unsigned int b = 0; b < nodes_of_block.size(); ++b)
      if (const double mass = state.mass(b); mass > 0.)
        for (unsigned int d = 0; d < dim; ++d)
          state.numbers[n * b + dim + d] /= mass;
    return state;
  }



  template <int dim>
  std::vector<bool>
  mark_caught_blocks(const SupportState<dim> &from,
                     const SupportState<dim> &to,
                     const std::vector<double> &loads,
                     const std::vector<double> &sizes)
  {
    std::vector<bool> is_caught(loads.size(), false);
    if (from.numbers.empty() || to.numbers.empty())
      return is_caught;
    std::vector<TakeUp<dim>> changes;
    for (unsigned int b = 0; b < loads.size(); ++b)
      {
        changes.emplace_back(from, to, b);
        is_caught[b] = changes[b].bears(loads[b],
                                        far_off * sizes[b],
                                        norm<dim>(changes[b].way));
      }
    const std::vector<bool> is_held = is_caught;
    for (unsigned int b = 0; b < loads.size(); ++b)
      {
        const Vector<dim> &way = changes[b].way;
        for (unsigned int other = 0; other < loads.size(); ++other)
          is_caught[b] =
            is_caught[b] ||
            (is_held[other] && dot<dim>(changes[other].way, way) >
                                 carrying_share * dot<dim>(way, way));
      }
    return is_caught;
  }

#define INSTANTIATE(dim)                                                       \
  template SupportState<dim> measure_support(                                  \
    const ForceElements<dim> &,                                                \
    const Fields<dim> &,                                                       \
    const std::vector<std::vector<unsigned int>> &,                            \
    const std::vector<bool> &,                                                 \
    const Communicator &);                                                     \
  template std::vector<bool> mark_caught_blocks(const SupportState<dim> &,     \
                                                const SupportState<dim> &,     \
                                                const std::vector<double> &,   \
                                                const std::vector<double> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Keyblock
