// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/contact/pair_exchange.h>
#include <keyblock/contact/strength_loans.h>

#include <algorithm>

namespace Keyblock
{
  namespace
  {
    /** What is lent over what is missing [-]: rounding must not decide whether
     * a point bears what it bore. */
    constexpr double margin = 1.001;
  } // namespace



  template <int dim>
  StrengthLoans<dim>::StrengthLoans(const PairTopology<dim> &topology,
                                    const ContactStrength<dim> &strength,
                                    ContactMemory<dim> &memory)
    : topology(topology)
    , interface(topology.interface)
    , strength(strength)
    , memory(memory)
  {}


  template <int dim>
  void
  StrengthLoans<dim>::unweld(const unsigned int number)
  {
    std::vector<unsigned int> pairs;
    for (unsigned int p = 0; p < memory.state.size(); ++p)
      if (memory.state[p].is_welded &&
          interface.pairs[p].unwelding_stage <= number)
        pairs.push_back(p);
    if (pairs.empty())
      return;
    const std::vector<PairState<dim>> all =
      gather_pair_states(topology, memory);
    for (const unsigned int p : pairs)
      {
        memory.state[p].is_welded = false;
        memory.state[p].is_intact =
          strength.is_bonded(interface.pairs[p].joint);
        const auto [tension, shear]  = strength.beyond(p, all[p]);
        memory.state[p].weld_tension = margin * tension;
        memory.state[p].weld_shear   = margin * shear;
      }
  }



  template <int dim>
  bool
  StrengthLoans<dim>::may_hold(const unsigned int pair,
                               const std::vector<bool> &is_exposed) const
  {
    const auto sides = topology.blocks_of_pair(pair);
    return !is_exposed[sides[0]] && !is_exposed[sides[1]] &&
           !memory.state[pair].is_welded && !memory.state[pair].is_removed;
  }



  template <int dim>
  double
  StrengthLoans<dim>::doubt_about(const unsigned int group) const
  {
    // bends are measured to rounding and to what the mesh's cells make of them
    constexpr double factor = 2.;
    const double kick       = memory.present_kick();
    const auto [begin, end] = topology.pairs_of_group(group);
    double bend = 0., largest = 0.;
    for (unsigned int p = begin; p < end; ++p)
      {
        const Pair<dim> &pair = interface.pairs[p];
        if (pair.is_tie())
          continue;
        const Tensor<1, dim> direction =
          pair.area_vector / pair.area_vector.norm();
        bend    = std::max(bend, (direction - pair.normal).norm());
        largest = std::max(largest, norm<dim>(memory.state[p].impulse) / kick);
      }
    return factor * bend * largest;
  }



  template <int dim>
  unsigned int
  StrengthLoans<dim>::hold_bent_points(const std::vector<bool> &is_exposed)
  {
    unsigned int n_held                = 0;
    std::vector<PairState<dim>> &state = memory.state;
    for (unsigned int g = 0; g < interface.n_groups(); ++g)
      {
        const auto [begin, end] = topology.pairs_of_group(g);
        // points that meet share what the bend of one of them makes
        const double unsure = doubt_about(g);
        for (unsigned int p = begin; p < end; ++p)
          {
            if (!may_hold(p, is_exposed))
              continue;
            const auto [tension, shear] = strength.beyond(p, state[p]);
            if (std::max(tension, shear) <= 0. || tension > unsure ||
                shear > unsure)
              continue;
            state[p].bend_tension = margin * tension;
            state[p].bend_shear   = margin * shear;
            n_held += topology.is_primary(g);
          }
        // how they share it is not unique, and changes when they are released
        double most_tension = 0., most_shear = 0.;
        for (unsigned int p = begin; p < end; ++p)
          {
            most_tension = std::max(most_tension, state[p].bend_tension);
            most_shear   = std::max(most_shear, state[p].bend_shear);
          }
        for (unsigned int p = begin; p < end; ++p)
          if (may_hold(p, is_exposed))
            {
              state[p].bend_tension = most_tension;
              state[p].bend_shear   = most_shear;
            }
      }
    return topology.numbering.communicator.sum(n_held);
  }


  template <int dim>
  void
  StrengthLoans<dim>::release_bent_points()
  {
    for (PairState<dim> &pair : memory.state)
      {
        pair.weld_shear += pair.bend_shear;
        pair.weld_tension += pair.bend_tension;
        pair.bend_shear = pair.bend_tension = 0.;
      }
  }

  template class StrengthLoans<2>;
  template class StrengthLoans<3>;
} // namespace Keyblock
