// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/run/moving_blocks.h>
#include <keyblock/safety/block_stiffness.h>
#include <keyblock/safety/caught_block.h>
#include <keyblock/step/guided_blocks.h>

namespace Keyblock
{
  namespace
  {
    /** Unbalanced force of a block over its own load from which on it is
     * driven [-]. */
    constexpr double driving_ratio = 1e-2;

    /** The same from which on it is not held, slow as it may still be: what
     * oscillates so does not pass for held by its speed either [-]. */
    constexpr double loose_ratio = 0.1;

    /** The same from which on it may also move against that, as one that was
     * thrown up before it falls [-]. */
    constexpr double free_ratio = 0.5;
  } // namespace



  template <int dim>
  bool
  is_driven(const BlockBalance<dim> &balance, const Vector<dim> &velocity)
  {
    return balance.unbalanced_ratio() > driving_ratio &&
           dot<dim>(velocity, balance.unbalanced_force) > 0.;
  }



  template <int dim>
  bool
  is_any_block_moving_off(const Model<dim> &model, const unsigned int n_steps)
  {
    if (model.contact == nullptr)
      return false;
    const auto velocities =
      model.contact->motions().measure(model.fields.velocity);
    const auto nodes =
      owned_nodes_of_blocks(model.split, *model.numbering, velocities.size());
    const std::vector<bool> is_guided =
      mark_guided_blocks(model.fields, nodes, model.communicator);
    const double duration = n_steps * model.step->dt;
    for (unsigned int b = 0; b < velocities.size(); ++b)
      {
        const Block<dim> &block = model.blocks.blocks[b];
        if (block.is_infinite || is_guided[b] ||
            model.conditions->active_cells.is_removed_block(b))
          continue;
        const Vector<dim> &velocity = velocities[b].shift;
        const BlockBalance<dim> balance =
          measure_balance(model.fields, nodes[b], model.communicator);
        const double ratio = balance.unbalanced_ratio();
        if (ratio > free_ratio ||
            (is_driven<dim>(balance, velocity) &&
             (ratio > loose_ratio ||
              norm<dim>(velocity) * duration >
                compression_of_block(model.conditions->active_cells.ground(),
                                     b,
                                     block,
                                     balance.load))))
          return true;
      }
    return false;
  }

  template <int dim>
  std::vector<unsigned int>
  list_caught_blocks(const Model<dim> &model,
                     const std::vector<BlockMotion<dim>> &motions)
  {
    std::vector<unsigned int> caught;
    for (unsigned int b = 0; b < motions.size(); ++b)
      if (!model.blocks.blocks[b].is_infinite &&
          !model.conditions->active_cells.is_removed_block(b) &&
          motions[b].way() > size_of_place * model.blocks.blocks[b].size &&
          is_caught_elsewhere<dim>(model.conditions->active_cells.ground(),
                                   model.blocks,
                                   b,
                                   model.step->time,
                                   motions[b].way(),
                                   motions[b].load,
                                   model.contact->report().sum_over_block(b)))
        caught.push_back(b);
    return caught;
  }

  template bool is_driven<2>(const BlockBalance<2> &, const Vector<2> &);
  template bool is_driven<3>(const BlockBalance<3> &, const Vector<3> &);
  template bool is_any_block_moving_off(const Model<2> &, const unsigned int);
  template bool is_any_block_moving_off(const Model<3> &, const unsigned int);
  template std::vector<unsigned int>
  list_caught_blocks(const Model<2> &, const std::vector<BlockMotion<2>> &);
  template std::vector<unsigned int>
  list_caught_blocks(const Model<3> &, const std::vector<BlockMotion<3>> &);
} // namespace Keyblock
