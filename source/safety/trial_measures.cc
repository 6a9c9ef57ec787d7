// SPDX-License-Identifier: LGPL-2.1-or-later
// What a trial measures of a block, and the stage that its measures ask for.
#include <keyblock/rock/nodal_force.h>
#include <keyblock/safety/block_stiffness.h>
#include <keyblock/safety/strength_trial.h>
#include <keyblock/step/block_balance.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace Keyblock
{
  namespace
  {
    /** Share of its load that what holds a block bears at least [-]. */
    constexpr double holding_share = 0.1;
  } // namespace



  template <int dim>
  typename StrengthTrials<dim>::Motion
  StrengthTrials<dim>::measure(const unsigned int block) const
  {
    // mass, momentum, and mass times displacement
    std::vector<double> sums(2 * dim + 1, 0.);
    const Fields<dim> &fields = run.fields;
    for (const unsigned int node : nodes_of_block[block])
      for (unsigned int d = 0; d < dim; ++d)
        {
          const unsigned int i = dim * node + d;
          sums[0] += fields.mass[node] / dim;
          sums[1 + d] += fields.mass[node] * fields.velocity[i];
          sums[1 + dim + d] += fields.mass[node] * fields.displacement[i];
        }
    communicator.sum_lists(sums);
    const BlockBalance<dim> balance =
      measure_balance(fields, nodes_of_block[block], communicator);
    Motion motion;
    motion.load       = balance.load;
    motion.unbalanced = balance.unbalanced_ratio();
    for (unsigned int d = 0; d < dim; ++d)
      {
        motion.velocity[d]     = sums[1 + d] / sums[0];
        motion.displacement[d] = sums[1 + dim + d] / sums[0];
      }
    // where all joints are reduced, what it touches may go along
    motion.slip =
      is_carried || scene.safety.reduced_joints == ReducedJoints::all
        ? motion.displacement
        : run.contact->report().mean_slip(block);
    return motion;
  }



  template <int dim>
  double
  StrengthTrials<dim>::way_from_place(const unsigned int block) const
  {
    const double way = run.contact->motions().measure()[block].way();
    return way > far_off * blocks.blocks[block].size ? way : 0.;
  }



  template <int dim>
  bool
  StrengthTrials<dim>::has_passed(const unsigned int block,
                                  const double slip) const
  {
    return slip > far_off * blocks.blocks[block].size;
  }



  template <int dim>
  std::string
  StrengthTrials<dim>::list_holders(const unsigned int block,
                                    const Tensor<1, dim> &way) const
  {
    const auto &elements = run.conditions.elements;
    // resultants on the block: of loads, of supports, then of each element
    std::vector<double> sums;
    const auto add_sum = [&](const std::vector<double> &force) {
      for (unsigned int d = 0; d < dim; ++d)
        {
          sums.push_back(0.);
          for (const unsigned int node : nodes_of_block[block])
            sums.back() += force[dim * node + d];
        }
    };
    add_sum(run.fields.load);
    std::vector<double> reactions(run.fields.load.size(), 0.);
    for (const unsigned int node : nodes_of_block[block])
      {
        Vector<dim> force = out_of_balance_force<dim>(run.fields, node);
        take_support_reactions<dim>(run.fields,
                                    node,
                                    force,
                                    [&](const double held,
                                        const auto &direction) {
                                      for (unsigned int d = 0; d < dim; ++d)
                                        reactions[dim * node + d] +=
                                          held * direction[d];
                                    });
      }
    add_sum(reactions);
    for (const auto &element : elements)
      {
        std::vector<double> force(run.fields.load.size(), 0.);
        element->add_force(run.fields.displacement, force);
        add_sum(force);
      }
    communicator.sum_lists(sums);
    const auto along_way = [&](const unsigned int i) {
      double sum = 0.;
      for (unsigned int d = 0; d < dim; ++d)
        sum += sums[dim * i + d] * (way.norm() > 0. ? way[d] : sums[d]);
      return sum;
    };
    std::vector<std::string> holders;
    const double load = along_way(0);
    const double held = along_way(1);
    double left       = load - held;
    if (held >= holding_share * load)
      holders.push_back("supports");
    for (unsigned int i = 0; i < elements.size(); ++i)
      {
        // forces of elements count against what they do to the rock
        const double borne = along_way(i + 2);
        left -= borne;
        if (borne < holding_share * load)
          continue;
        holders.push_back(elements[i]->name());
        std::replace(holders.back().begin(), holders.back().end(), '_', ' ');
      }
    const double moved_by = way_from_place(block);
    if (holders.empty() || left >= holding_share * load)
      holders.push_back(moved_by > 0. ? "what it has come to lie on"
                        : scene.safety.joints.empty()
                          ? "clamping"
                          : "joints that are not reduced");
    std::string text = holders[0];
    for (unsigned int i = 1; i < holders.size(); ++i)
      text += (i + 1 < holders.size() ? ", " : " and ") + holders[i];
    return text;
  }



  template <int dim>
  double
  StrengthTrials<dim>::n_across(const unsigned int block) const
  {
    const Block<dim> &b = blocks.blocks[block];
    return std::max(4., b.size / std::pow(b.volume / b.n_cells, 1. / dim));
  }



  template <int dim>
  unsigned int
  StrengthTrials<dim>::period_of(const unsigned int block) const
  {
    return std::ceil(4. * n_across(block) / scene.time_stepping.safety);
  }



  template <int dim>
  double
  StrengthTrials<dim>::wave_speed(const unsigned int block) const
  {
    return largest_in_block(run.conditions.active_cells.ground(),
                            block,
                            [](const Material<dim> &material) {
                              return material.p_wave_speed();
                            });
  }



  template <int dim>
  double
  StrengthTrials<dim>::compression(const unsigned int block,
                                   const double load) const
  {
    return compression_of_block(run.conditions.active_cells.ground(),
                                block,
                                blocks.blocks[block],
                                load);
  }



  template <int dim>
  double
  StrengthTrials<dim>::kinetic_energy(const unsigned int block) const
  {
    double energy = 0.;
    for (const unsigned int node : nodes_of_block[block])
      for (unsigned int i = dim * node; i < dim * (node + 1); ++i)
        energy += 0.5 * run.fields.mass[node] * run.fields.velocity[i] *
                  run.fields.velocity[i];
    return communicator.sum(energy);
  }



  template <int dim>
  double
  StrengthTrials<dim>::mass_in_use(const unsigned int block) const
  {
    double mass = 0.;
    for (const unsigned int node : nodes_of_block[block])
      mass += run.fields.mass[node];
    return communicator.sum(mass);
  }



  template <int dim>
  unsigned int
  StrengthTrials<dim>::n_intact(const unsigned int block) const
  {
    unsigned int n = 0;
    for (const JointSums<dim> &sums :
         run.contact->report().sum_over_block(block))
      n += sums.n_intact;
    return n;
  }



  template <int dim>
  std::string
  StrengthTrials<dim>::name_failure(const unsigned int block) const
  {
    // a motion that varies over the block more than its mean is a rotation
    std::vector<double> sums(dim + 2, 0.);
    for (const unsigned int node : nodes_of_block[block])
      {
        const double m = run.fields.mass[node];
        sums[0] += m;
        for (unsigned int d = 0; d < dim; ++d)
          {
            const double way = run.fields.displacement[dim * node + d] -
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

    const double total =
      std::accumulate(joint_force.begin(), joint_force.end(), 0.);
    std::string names;
    for (unsigned int j = 0; j < joint_force.size(); ++j)
      if (joint_force[j] > 0.01 * total && joint_force[j] > 0.)
        names += (names.empty() ? "" : "/") + (j < scene.joints.size()
                                                 ? scene.joints[j]->name
                                                 : std::string("a free face"));
    if (names.empty())
      return "falling";
    return (rotates ? "rotating on " : "sliding on ") + names;
  }



  template <int dim>
  Stage
  StrengthTrials<dim>::quiet_stage(const unsigned int block) const
  {
    Stage quiet;
    quiet.kind          = StageKind::quasi_static;
    quiet.local_damping = scene.safety.local_damping;
    quiet.damping_ratio = scene.safety.damping_ratio;
    // critical for the block's lowest mode: 2 omega
    run.conditions.scale_density(true);
    quiet.mass_damping = scene.safety.mass_damping * dealii::numbers::PI /
                         (2. * n_across(block)) *
                         run.conditions.stable_step.frequency;
    return quiet;
  }

  template StrengthTrials<2>::Motion
  StrengthTrials<2>::measure(const unsigned int) const;
  template StrengthTrials<3>::Motion
  StrengthTrials<3>::measure(const unsigned int) const;
  template double StrengthTrials<2>::way_from_place(const unsigned int) const;
  template double StrengthTrials<3>::way_from_place(const unsigned int) const;
  template bool StrengthTrials<2>::has_passed(const unsigned int,
                                              const double) const;
  template bool StrengthTrials<3>::has_passed(const unsigned int,
                                              const double) const;
  template double StrengthTrials<2>::n_across(const unsigned int) const;
  template double StrengthTrials<3>::n_across(const unsigned int) const;
  template unsigned int StrengthTrials<2>::period_of(const unsigned int) const;
  template unsigned int StrengthTrials<3>::period_of(const unsigned int) const;
  template double StrengthTrials<2>::wave_speed(const unsigned int) const;
  template double StrengthTrials<3>::wave_speed(const unsigned int) const;
  template double StrengthTrials<2>::compression(const unsigned int,
                                                 const double) const;
  template double StrengthTrials<3>::compression(const unsigned int,
                                                 const double) const;
  template double StrengthTrials<2>::kinetic_energy(const unsigned int) const;
  template double StrengthTrials<3>::kinetic_energy(const unsigned int) const;
  template std::string
  StrengthTrials<2>::list_holders(const unsigned int,
                                  const Tensor<1, 2> &) const;
  template std::string
  StrengthTrials<3>::list_holders(const unsigned int,
                                  const Tensor<1, 3> &) const;
  template double StrengthTrials<2>::mass_in_use(const unsigned int) const;
  template double StrengthTrials<3>::mass_in_use(const unsigned int) const;
  template unsigned int StrengthTrials<2>::n_intact(const unsigned int) const;
  template unsigned int StrengthTrials<3>::n_intact(const unsigned int) const;
  template std::string
  StrengthTrials<2>::name_failure(const unsigned int) const;
  template std::string
  StrengthTrials<3>::name_failure(const unsigned int) const;
  template Stage StrengthTrials<2>::quiet_stage(const unsigned int) const;
  template Stage StrengthTrials<3>::quiet_stage(const unsigned int) const;
} // namespace Keyblock
