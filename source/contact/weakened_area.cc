// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/contact/node_history.h>
#include <keyblock/contact/report.h>
#include <keyblock/law/joint_law.h>

#include <algorithm>

namespace Keyblock
{
  template <int dim>
  JointHistory
  ContactReport<dim>::history_of_pair(const unsigned int pair) const
  {
    if (memory.pair_histories.empty())
      return {};
    if (!memory.state[pair].is_converted)
      return memory.pair_histories[pair];
    // of the two nodes the one that has slid further
    JointHistory longest;
    for (const unsigned int vertex :
         {interface.pairs[pair].minus, interface.pairs[pair].plus})
      if (const JointHistory found =
            find_history(memory.node_histories,
                         surface.node_of_vertex[vertex],
                         interface.pairs[pair].joint);
          found.slip > longest.slip)
        longest = found;
    return longest;
  }



  template <int dim>
  std::vector<StrengthLoss>
  ContactReport<dim>::lost_strength(const unsigned int block) const
  {
    // by joint: area and cohesion lost, normal force, its share of tan(phi)
    // lost
    std::vector<double> sums(4 * scene.joints.size(), 0.);
    std::vector<std::shared_ptr<const JointLaw>> laws(scene.joints.size());
    const auto law_of = [&](const unsigned int joint) -> const JointLaw & {
      if (!laws[joint])
        laws[joint] = make_joint_law(*scene.joints[joint]);
      return *laws[joint];
    };
    const auto add_friction = [&](const unsigned int joint,
                                  const JointPointState &state,
                                  const double normal) {
      if (normal <= 0.)
        return;
      sums[4 * joint + 2] += normal;
      sums[4 * joint + 3] +=
        normal * std::max(0.,
                          law_of(joint).envelope({}).static_tangent -
                            law_of(joint).envelope(state).static_tangent);
    };
    for (unsigned int p = 0; p < memory.state.size(); ++p)
      {
        const PairState<dim> &state = memory.state[p];
        const auto sides            = topology.blocks_of_pair(p);
        if (sides[0] == sides[1] || (sides[0] != block && sides[1] != block) ||
            state.is_removed || !topology.is_primary(topology.group_of_pair[p]))
          continue;
        const unsigned int joint = interface.pairs[p].joint;
        const JointPointState point{state.is_intact,
                                    !state.is_intact && state.has_opened,
                                    history_of_pair(p),
                                    0.};
        if (!state.is_converted)
          add_friction(joint, point, dot<dim>(state.impulse, memory.normal[p]));
        const double cohesion = law_of(joint).envelope({}).cohesion -
                                law_of(joint).envelope(point).cohesion;
        if (state.is_intact || cohesion <= 0.)
          continue;
        sums[4 * joint] += interface.pairs[p].area;
        sums[4 * joint + 1] += interface.pairs[p].area * cohesion;
      }
    for (const SurfaceContact<dim> &contact : memory.contacts)
      if (topology.numbering.communicator.is_root() &&
          contact.joint < scene.joints.size() &&
          (contact.master_block == block ||
           surface.block_of_node[contact.slave] == block))
        add_friction(
          contact.joint,
          {false,
           false,
           find_history(memory.node_histories, contact.slave, contact.joint),
           0.},
          dot<dim>(contact.point.impulse, contact.point.normal));
    topology.numbering.communicator.sum_lists(sums);
    std::vector<StrengthLoss> losses(scene.joints.size());
    for (unsigned int j = 0; j < losses.size(); ++j)
      losses[j] = {sums[4 * j],
                   sums[4 * j + 1],
                   sums[4 * j + 2] > 0. ? sums[4 * j + 3] / sums[4 * j + 2]
                                        : 0.};
    return losses;
  }



  template <int dim>
  std::vector<double>
  ContactReport<dim>::weakened_area(const unsigned int block) const
  {
    std::vector<double> area;
    for (const StrengthLoss &loss : lost_strength(block))
      area.push_back(loss.area);
    return area;
  }

  template std::vector<StrengthLoss>
  ContactReport<2>::lost_strength(const unsigned int) const;
  template std::vector<StrengthLoss>
  ContactReport<3>::lost_strength(const unsigned int) const;
  template std::vector<double>
  ContactReport<2>::weakened_area(const unsigned int) const;
  template std::vector<double>
  ContactReport<3>::weakened_area(const unsigned int) const;
} // namespace Keyblock
