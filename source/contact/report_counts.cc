// SPDX-License-Identifier: LGPL-2.1-or-later
// Counts of contact points by what they do.
#include <keyblock/contact/report.h>

#include <algorithm>

namespace Keyblock
{
  template <int dim>
  unsigned int
  ContactReport<dim>::count_through_rock() const
  {
    // share of the skin that is no depth
    constexpr double shallow = 0.02;
    return std::count_if(memory.contacts.begin(),
                         memory.contacts.end(),
                         [&](const SurfaceContact<dim> &contact) {
                           const unsigned int block =
                             surface.block_of_node[contact.slave];
                           return !contact.is_ridge &&
                                  block == contact.master_block &&
                                  surface.start_distance(contact.slave,
                                                         contact.face) <
                                    -shallow * surface.skin();
                         });
  }



  template <int dim>
  JointSums<dim>
  ContactReport<dim>::count_pairs() const
  {
    std::vector<double> n(2, 0.);
    for (unsigned int p = 0; p < memory.state.size(); ++p)
      if (topology.is_primary(topology.group_of_pair[p]) &&
          !memory.state[p].is_converted && !memory.state[p].is_removed)
        {
          n[0] += memory.state[p].status == ContactStatus::open;
          n[1] += memory.state[p].status == ContactStatus::sliding;
        }
    topology.numbering.communicator.sum_lists(n);
    JointSums<dim> sums;
    sums.n_open    = n[0];
    sums.n_sliding = n[1];
    return sums;
  }



  template <int dim>
  std::vector<double>
  ContactReport<dim>::list_sliding_blocks() const
  {
    std::vector<double> is_sliding(memory.is_removed_block.size(), 0.);
    const auto mark = [&](const unsigned int block) {
      if (block != none && !memory.is_removed_block[block])
        is_sliding[block] = 1.;
    };
    for (unsigned int p = 0; p < memory.state.size(); ++p)
      if (memory.state[p].status == ContactStatus::sliding)
        for (const unsigned int block : topology.blocks_of_pair(p))
          mark(block);
    for (const SurfaceContact<dim> &contact : memory.contacts)
      if (contact.point.status == ContactStatus::sliding)
        {
          mark(contact.master_block);
          mark(surface.block_of_node[contact.slave]);
        }
    topology.numbering.communicator.max_lists(is_sliding);
    return is_sliding;
  }



  template <int dim>
  std::vector<unsigned int>
  ContactReport<dim>::list_blocks_pressed_on(const unsigned int block) const
  {
    std::vector<double> is_pressed(memory.is_removed_block.size(), 0.);
    const auto mark =
      [&](const unsigned int a, const unsigned int b, const double pressure) {
        if (a != b && a != none && b != none && (a == block || b == block) &&
            pressure > 0.)
          is_pressed[a == block ? b : a] = 1.;
      };
    for (unsigned int p = 0; p < memory.state.size(); ++p)
      if (topology.is_primary(topology.group_of_pair[p]) &&
          !memory.state[p].is_converted && !memory.state[p].is_removed)
        {
          const auto sides = topology.blocks_of_pair(p);
          mark(sides[0],
               sides[1],
               dot<dim>(memory.state[p].impulse, memory.normal[p]));
        }
    for (const SurfaceContact<dim> &contact : memory.contacts)
      mark(surface.block_of_node[contact.slave],
           contact.master_block,
           dot<dim>(contact.point.impulse, contact.point.normal));
    topology.numbering.communicator.max_lists(is_pressed);
    std::vector<unsigned int> pressed;
    for (unsigned int b = 0; b < is_pressed.size(); ++b)
      if (is_pressed[b] > 0.)
        pressed.push_back(b);
    return pressed;
  }

  template unsigned int ContactReport<2>::count_through_rock() const;
  template JointSums<2> ContactReport<2>::count_pairs() const;
  template std::vector<double> ContactReport<2>::list_sliding_blocks() const;
  template std::vector<unsigned int>
  ContactReport<2>::list_blocks_pressed_on(const unsigned int) const;
  template unsigned int ContactReport<3>::count_through_rock() const;
  template JointSums<3> ContactReport<3>::count_pairs() const;
  template std::vector<double> ContactReport<3>::list_sliding_blocks() const;
  template std::vector<unsigned int>
  ContactReport<3>::list_blocks_pressed_on(const unsigned int) const;
} // namespace Keyblock
