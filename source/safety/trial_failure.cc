// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/vector.h>
#include <keyblock/safety/trial_failure.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace Keyblock
{
  namespace
  {
    /** Way of another block, in the direction of the one that fails and over
     * its way, from which on they move together [-]. */
    constexpr double along_share = 0.5;

    /** The same, in any direction, from which on it moves at all [-]. */
    constexpr double moving_share = 0.1;

    /** Slip of a block over its way, root of the mean square, below which it is
     * its rock that fails [-]. */
    constexpr double yielding_share = 0.5;
  } // namespace



  template <int dim>
  TrialFailure<dim>::TrialFailure(
    const Scene<dim> &scene,
    const Blocks<dim> &blocks,
    const std::vector<std::vector<unsigned int>> &nodes_of_block,
    const Fields<dim> &fields,
    const Communicator &communicator)
    : scene(scene)
    , blocks(blocks)
    , nodes_of_block(nodes_of_block)
    , fields(fields)
    , communicator(communicator)
  {}



  template <int dim>
  void
  TrialFailure<dim>::forget()
  {
    last_mode = BlockMode();
    last_way  = Vector<dim>{};
    along.clear();
    moving.clear();
  }



  template <int dim>
  void
  TrialFailure<dim>::begin(const Vector<dim> &slip)
  {
    slip_before         = slip;
    displacement_before = fields.displacement;
    joint_force.assign(scene.joints.size() + 1, 0.);
  }



  template <int dim>
  void
  TrialFailure<dim>::add(const std::vector<JointSums<dim>> &joints)
  {
    for (unsigned int j = 0; j < joints.size(); ++j)
      joint_force[j] += joints[j].normal;
  }



  template <int dim>
  void
  TrialFailure<dim>::note(const unsigned int block, const Vector<dim> &slip)
  {
    last_mode = find_mode(block, slip);
    list_blocks_that_moved(block);
  }



  template <int dim>
  void
  TrialFailure<dim>::list_blocks_that_moved(const unsigned int block)
  {
    // mean ways of the blocks in the second phase
    const unsigned int n_blocks = blocks.blocks.size();
    std::vector<double> sums((dim + 1) * n_blocks, 0.);
    for (unsigned int b = 0; b < n_blocks; ++b)
      for (const unsigned int node : nodes_of_block[b])
        {
          const double m = fields.mass[node];
          for (unsigned int d = 0; d < dim; ++d)
            sums[(dim + 1) * b + d] +=
              m * (fields.displacement[dim * node + d] -
                   displacement_before[dim * node + d]);
          sums[(dim + 1) * b + dim] += m;
        }
    communicator.sum_lists(sums);
    const auto way = [&](const unsigned int b) {
      Vector<dim> mean{};
      for (unsigned int d = 0; d < dim && sums[(dim + 1) * b + dim] > 0.; ++d)
        mean[d] = sums[(dim + 1) * b + d] / sums[(dim + 1) * b + dim];
      return mean;
    };
    const Vector<dim> own = way(block);
    last_way              = own;
    along.clear();
    moving.clear();
    for (unsigned int b = 0; b < n_blocks; ++b)
      if (b != block && !blocks.blocks[b].is_infinite)
        {
          if (dot<dim>(way(b), own) > along_share * dot<dim>(own, own))
            along.push_back(b);
          if (norm<dim>(way(b)) > moving_share * norm<dim>(own))
            moving.push_back(b);
        }
  }



  template <int dim>
  BlockMode
  TrialFailure<dim>::find_mode(const unsigned int block,
                               const Vector<dim> &slip) const
  {
    // a motion that varies over the block more than its mean is a rotation
    std::vector<double> sums(dim + 2, 0.);
    for (const unsigned int node : nodes_of_block[block])
      {
        const double m = fields.mass[node];
        sums[0] += m;
        for (unsigned int d = 0; d < dim; ++d)
          {
            const double way = fields.displacement[dim * node + d] -
                               displacement_before[dim * node + d];
            sums[1] += m * way * way;
            sums[2 + d] += m * way;
          }
      }
    communicator.sum_lists(sums);
    double mean = 0.;
    for (unsigned int d = 0; d < dim; ++d)
      mean += sums[2 + d] * sums[2 + d];
    mean /= sums[0];
    const bool rotates = mean < 0.75 * sums[1];
    // rock that yields moves without slipping
    if (scene.safety.reduces_rock &&
        norm<dim>(Keyblock::add<dim>(slip, -1., slip_before)) <
          yielding_share * std::sqrt(sums[1] / sums[0]))
      return {"yielding", {}};

    const double total =
      std::accumulate(joint_force.begin(), joint_force.end(), 0.);
    BlockMode mode;
    for (unsigned int j = 0; j < joint_force.size(); ++j)
      if (joint_force[j] > 0.01 * total && joint_force[j] > 0.)
        mode.add_joint(j < scene.joints.size() ? scene.joints[j]->name
                                               : "a free face");
    mode.motion = mode.joints.empty() ? "falling"
                  : rotates           ? "rotating"
                                      : "sliding";
    return mode;
  }

  template class TrialFailure<2>;
  template class TrialFailure<3>;
} // namespace Keyblock
