// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/contact/pair_exchange.h>

#include <cmath>

namespace Keyblock
{
  template <int dim>
  std::vector<PairState<dim>>
  gather_pair_states(const PairTopology<dim> &topology,
                     const ContactMemory<dim> &memory)
  {
    const std::vector<PairState<dim>> &state = memory.state;
    constexpr unsigned int n                 = dim + 4;
    std::vector<double> packed(n * state.size(), 0.);
    for (unsigned int p = 0; p < state.size(); ++p)
      if (topology.is_primary(topology.group_of_pair[p]))
        {
          for (int d = 0; d < dim; ++d)
            packed[n * p + d] = state[p].impulse[d];
          packed[n * p + dim]     = static_cast<int>(state[p].status);
          packed[n * p + dim + 1] = state[p].is_intact;
          packed[n * p + dim + 2] = state[p].is_converted;
          packed[n * p + dim + 3] = state[p].has_opened;
        }
    topology.numbering.communicator.sum_lists(packed);
    std::vector<PairState<dim>> result(state.size());
    for (unsigned int p = 0; p < state.size(); ++p)
      {
        for (int d = 0; d < dim; ++d)
          result[p].impulse[d] = packed[n * p + d];
        result[p].status =
          static_cast<ContactStatus>(std::lround(packed[n * p + dim]));
        result[p].is_intact    = packed[n * p + dim + 1] > 0.5;
        result[p].is_converted = packed[n * p + dim + 2] > 0.5;
        result[p].has_opened   = packed[n * p + dim + 3] > 0.5;
        result[p].is_welded    = state[p].is_welded;
        result[p].is_removed   = state[p].is_removed;
        result[p].bend_shear   = state[p].bend_shear;
        result[p].bend_tension = state[p].bend_tension;
        result[p].weld_shear   = state[p].weld_shear;
        result[p].weld_tension = state[p].weld_tension;
      }
    return result;
  }

  template <int dim>
  std::vector<JointHistory>
  gather_pair_histories(const PairTopology<dim> &topology,
                        const ContactMemory<dim> &memory)
  {
    std::vector<JointHistory> result = memory.pair_histories;
    std::vector<double> packed(3 * result.size(), 0.);
    for (unsigned int p = 0; p < result.size(); ++p)
      if (topology.is_primary(topology.group_of_pair[p]))
        {
          packed[3 * p]     = result[p].slip;
          packed[3 * p + 1] = result[p].dilation;
          packed[3 * p + 2] = result[p].damage;
        }
    topology.numbering.communicator.sum_lists(packed);
    for (unsigned int p = 0; p < result.size(); ++p)
      result[p] = {packed[3 * p], packed[3 * p + 1], packed[3 * p + 2]};
    return result;
  }

  template <int dim>
  std::vector<SpringState<dim>>
  gather_pair_springs(const PairTopology<dim> &topology,
                      const ContactMemory<dim> &memory)
  {
    std::vector<SpringState<dim>> result = memory.pair_springs;
    std::vector<double> packed(2 * dim * result.size(), 0.);
    for (unsigned int p = 0; p < result.size(); ++p)
      if (topology.is_primary(topology.group_of_pair[p]))
        for (int d = 0; d < dim; ++d)
          {
            packed[2 * dim * p + d]       = result[p].force[d];
            packed[2 * dim * p + dim + d] = result[p].stretch[d];
          }
    topology.numbering.communicator.sum_lists(packed);
    for (unsigned int p = 0; p < result.size(); ++p)
      for (int d = 0; d < dim; ++d)
        {
          result[p].force[d]   = packed[2 * dim * p + d];
          result[p].stretch[d] = packed[2 * dim * p + dim + d];
        }
    return result;
  }

  template std::vector<PairState<2>>
  gather_pair_states(const PairTopology<2> &, const ContactMemory<2> &);
  template std::vector<PairState<3>>
  gather_pair_states(const PairTopology<3> &, const ContactMemory<3> &);
  template std::vector<JointHistory>
  gather_pair_histories(const PairTopology<2> &, const ContactMemory<2> &);
  template std::vector<JointHistory>
  gather_pair_histories(const PairTopology<3> &, const ContactMemory<3> &);
  template std::vector<SpringState<2>>
  gather_pair_springs(const PairTopology<2> &, const ContactMemory<2> &);
  template std::vector<SpringState<3>>
  gather_pair_springs(const PairTopology<3> &, const ContactMemory<3> &);
} // namespace Keyblock
