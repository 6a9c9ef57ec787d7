// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/contact/report.h>
#include <keyblock/law/joint_law.h>

#include <algorithm>

namespace Keyblock
{
  namespace
  {
    /** Of a node on a joint that has met others than its partners. */
    JointHistory
    find_history(const std::vector<NodeHistory> &histories,
                 const unsigned int node,
                 const unsigned int joint)
    {
      const auto key = std::make_pair(node, joint);
      const auto place =
        std::lower_bound(histories.begin(),
                         histories.end(),
                         key,
                         [](const NodeHistory &entry, const auto &wanted) {
                           return std::make_pair(entry.node, entry.joint) <
                                  wanted;
                         });
      return place != histories.end() &&
                 std::make_pair(place->node, place->joint) == key
               ? place->history
               : JointHistory();
    }
  } // namespace



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
    std::vector<double> sums(3 * scene.joints.size(), 0.);
    std::vector<std::shared_ptr<const JointLaw>> laws(scene.joints.size());
    for (unsigned int p = 0; p < memory.state.size(); ++p)
      {
        const PairState<dim> &state = memory.state[p];
        const auto sides            = topology.blocks_of_pair(p);
        if (sides[0] == sides[1] || (sides[0] != block && sides[1] != block) ||
            state.is_intact || state.is_removed ||
            !topology.is_primary(topology.group_of_pair[p]))
          continue;
        const unsigned int joint = interface.pairs[p].joint;
        const double area        = interface.pairs[p].area;
        if (!laws[joint])
          laws[joint] = make_joint_law(*scene.joints[joint]);
        const StrengthEnvelope before = laws[joint]->envelope({}),
                               now    = laws[joint]->envelope({false,
                                                               state.has_opened,
                                                               history_of_pair(p),
                                                               0.});
        const double cohesion         = before.cohesion - now.cohesion;
        sums[3 * joint] += cohesion > 0. ? area : 0.;
        sums[3 * joint + 1] += area * std::max(0., cohesion);
        sums[3 * joint + 2] +=
          area * std::max(0., before.static_tangent - now.static_tangent);
      }
    topology.numbering.communicator.sum_lists(sums);
    std::vector<StrengthLoss> losses(scene.joints.size());
    for (unsigned int j = 0; j < losses.size(); ++j)
      losses[j] = {sums[3 * j], sums[3 * j + 1], sums[3 * j + 2]};
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
