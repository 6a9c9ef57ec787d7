// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/contact/report.h>
#include <keyblock/law/joint_law.h>

namespace Keyblock
{
  template <int dim>
  std::vector<double>
  ContactReport<dim>::weakened_area(const unsigned int block) const
  {
    std::vector<double> area(scene.joints.size(), 0.);
    std::vector<std::shared_ptr<const JointLaw>> laws(area.size());
    for (unsigned int p = 0; p < memory.state.size(); ++p)
      {
        const PairState<dim> &state = memory.state[p];
        const auto sides            = topology.blocks_of_pair(p);
        if (sides[0] == sides[1] || (sides[0] != block && sides[1] != block) ||
            state.is_intact || state.is_removed ||
            !topology.is_primary(topology.group_of_pair[p]))
          continue;
        const unsigned int joint = interface.pairs[p].joint;
        if (!laws[joint])
          laws[joint] = make_joint_law(*scene.joints[joint]);
        const auto cohesion_of = [&](const bool is_intact) {
          return laws[joint]
            ->envelope({is_intact, !is_intact && state.has_opened, {}, 0.})
            .cohesion;
        };
        if (cohesion_of(false) < cohesion_of(true))
          area[joint] += interface.pairs[p].area;
      }
    topology.numbering.communicator.sum_lists(area);
    return area;
  }

  template std::vector<double>
  ContactReport<2>::weakened_area(const unsigned int) const;
  template std::vector<double>
  ContactReport<3>::weakened_area(const unsigned int) const;
} // namespace Keyblock
