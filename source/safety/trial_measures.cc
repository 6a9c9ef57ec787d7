// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/law/joint_stiffness.h>
#include <keyblock/rock/nodal_force.h>
#include <keyblock/safety/block_stiffness.h>
#include <keyblock/safety/trial_measures.h>
#include <keyblock/step/block_balance.h>
#include <keyblock/step/guided_blocks.h>

#include <algorithm>
#include <cmath>

namespace Keyblock
{
  namespace
  {
    /** Share of its load that what holds a block bears at least [-]. */
    constexpr double holding_share = 0.1;
  } // namespace



  template <int dim>
  TrialMeasures<dim>::TrialMeasures(const Scene<dim> &scene,
                                    const SplitMesh<dim> &split,
                                    const Blocks<dim> &blocks,
                                    const Numbering<dim> &numbering,
                                    const RunParts<dim> &run)
    : tied(scene, split, blocks)
    , nodes_of_block(
        owned_nodes_of_blocks(split, numbering, blocks.blocks.size()))
    , communicator(numbering.communicator)
    , scene(scene)
    , blocks(blocks)
    , run(run)
  {}



  template <int dim>
  typename TrialMeasures<dim>::Motion
  TrialMeasures<dim>::motion(const TriedBlocks &tried) const
  {
    // mass, momentum, and mass times displacement
    std::vector<double> sums(2 * dim + 1, 0.);
    const Fields<dim> &fields = run.fields;
    for (const unsigned int node : nodes_of_block[tried.block])
      for (unsigned int d = 0; d < dim; ++d)
        {
          const unsigned int i = dim * node + d;
          sums[0] += fields.mass[node] / dim;
          sums[1 + d] += fields.mass[node] * fields.velocity[i];
          sums[1 + dim + d] += fields.mass[node] * fields.displacement[i];
        }
    communicator.sum_lists(sums);
    const BlockBalance<dim> balance =
      measure_balance(fields, nodes_of_block[tried.block], communicator);
    Motion motion;
    motion.load       = balance.load;
    motion.unbalanced = balance.unbalanced_ratio();
    for (unsigned int d = 0; d < dim; ++d)
      {
        motion.velocity[d]     = sums[1 + d] / sums[0];
        motion.displacement[d] = sums[1 + dim + d] / sums[0];
      }
    // where all joints are reduced, what it touches may go along; where rock
    // is, the block itself may yield
    motion.slip = tried.is_carried ||
                      scene.safety.reduced_joints == ReducedJoints::all ||
                      scene.safety.reduces_rock
                    ? motion.displacement
                    : run.contact->report().mean_slip(tried.block);
    return motion;
  }



  template <int dim>
  double
  TrialMeasures<dim>::way_between(const Motion &from, const Motion &to)
  {
    return std::min(norm<dim>(add<dim>(to.slip, -1., from.slip)),
                    norm<dim>(
                      add<dim>(to.displacement, -1., from.displacement)));
  }



  template <int dim>
  double
  TrialMeasures<dim>::largest_unbalanced(const TriedBlocks &tried,
                                         const Motion &own) const
  {
    const std::vector<bool> is_tied = tied.mark_row(tried.block);
    std::vector<bool> leans(is_tied.size(), false);
    for (const unsigned int b : tried.others())
      leans[b] = true;
    double largest = own.unbalanced;
    for (unsigned int b = 0; b < is_tied.size(); ++b)
      if ((is_tied[b] || leans[b]) && b != tried.block &&
          !run.conditions.active_cells.is_removed_block(b))
        {
          const BlockBalance<dim> balance =
            measure_balance(run.fields, nodes_of_block[b], communicator);
          const double share =
            is_tied[b] ? 1. : balance.load / std::max(balance.load, own.load);
          largest = std::max(largest, share * balance.unbalanced_ratio());
        }
    return largest;
  }



  template <int dim>
  SupportState<dim>
  TrialMeasures<dim>::support(const TriedBlocks &tried) const
  {
    return measure_support(run.conditions.elements,
                           run.fields,
                           nodes_of_block,
                           tied.mark_neighbors(tried),
                           communicator);
  }



  template <int dim>
  double
  TrialMeasures<dim>::swing_period(const unsigned int block,
                                   const SupportState<dim> &from,
                                   const SupportState<dim> &to,
                                   const Motion &before,
                                   const Motion &now) const
  {
    if (to.numbers.empty())
      return 0.;
    const double gone =
      norm<dim>(add<dim>(now.displacement, -1., before.displacement));
    // the block of which they take up most leads
    TakeUp<dim> most(from, to, block);
    unsigned int leader = block;
    for (unsigned int b = 0; b < to.n_blocks(); ++b)
      if (const TakeUp<dim> change(from, to, b); change.energy > most.energy)
        {
          most   = change;
          leader = b;
        }
    const double length = far_off * blocks.blocks[block].size;
    return most.bears(now.load, length, gone) ||
               most.is_notable(now.unbalanced * now.load, gone)
             ? 2. * dealii::numbers::PI *
                 std::sqrt(to.mass(leader) * dot<dim>(most.way, most.way) /
                           most.energy) /
                 run.step.dt
             : 0.;
  }



  template <int dim>
  double
  TrialMeasures<dim>::way_from_place(const unsigned int block) const
  {
    const double way = run.contact->motions().measure()[block].way();
    return way > far_off * blocks.blocks[block].size ? way : 0.;
  }



  template <int dim>
  bool
  TrialMeasures<dim>::has_passed(const unsigned int block,
                                 const double slip) const
  {
    return slip > far_off * blocks.blocks[block].size;
  }



  template <int dim>
  std::string
  TrialMeasures<dim>::list_holders(const unsigned int block,
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
  std::vector<bool>
  TrialMeasures<dim>::guided_blocks() const
  {
    return mark_guided_blocks(run.fields, nodes_of_block, communicator);
  }



  template <int dim>
  double
  TrialMeasures<dim>::wave_speed(const unsigned int block) const
  {
    return largest_in_block(run.conditions.active_cells.ground(),
                            block,
                            [](const Material<dim> &material) {
                              return material.p_wave_speed();
                            });
  }



  template <int dim>
  double
  TrialMeasures<dim>::force_through(const unsigned int block) const
  {
    double sum = 0.;
    for (const JointSums<dim> &joint :
         run.contact->report().sum_over_block(block))
      sum += joint.normal;
    return 0.5 * sum;
  }



  template <int dim>
  double
  TrialMeasures<dim>::elastic_slip(const unsigned int block) const
  {
    const std::vector<JointSums<dim>> sums =
      run.contact->report().sum_over_block(block);
    double slip = 0.;
    for (const auto &[joint, area] : blocks.blocks[block].joint_area)
      if (const JointStiffness stiffness(*scene.joints[joint]);
          stiffness.is_compliant())
        slip = std::max(slip, sums[joint].shear / (stiffness.shear * area));
    return slip;
  }



  template <int dim>
  double
  TrialMeasures<dim>::compression(const unsigned int block,
                                  const double load) const
  {
    return compression_of_block(run.conditions.active_cells.ground(),
                                block,
                                blocks.blocks[block],
                                load);
  }



  template <int dim>
  double
  TrialMeasures<dim>::kinetic_energy(const TriedBlocks &tried) const
  {
    std::vector<unsigned int> moving = tried.others();
    moving.push_back(tried.block);
    double energy = 0.;
    for (const unsigned int block : moving)
      for (const unsigned int node : nodes_of_block[block])
        for (unsigned int i = dim * node; i < dim * (node + 1); ++i)
          energy += 0.5 * run.fields.mass[node] * run.fields.velocity[i] *
                    run.fields.velocity[i];
    return communicator.sum(energy);
  }



  template <int dim>
  double
  TrialMeasures<dim>::mass_in_use(const unsigned int block) const
  {
    double mass = 0.;
    for (const unsigned int node : nodes_of_block[block])
      mass += run.fields.mass[node];
    return communicator.sum(mass);
  }



  template <int dim>
  unsigned int
  TrialMeasures<dim>::n_intact(const unsigned int block) const
  {
    unsigned int n = 0;
    for (const JointSums<dim> &sums :
         run.contact->report().sum_over_block(block))
      n += sums.n_intact;
    return n;
  }

  template class TrialMeasures<2>;
  template class TrialMeasures<3>;
} // namespace Keyblock
