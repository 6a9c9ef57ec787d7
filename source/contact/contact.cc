// SPDX-License-Identifier: LGPL-2.1-or-later
// Contact: set-up and the order of the step.
#include <keyblock/base/mpi.h>
#include <keyblock/contact/contact.h>
#include <keyblock/law/friction.h>
#include <keyblock/law/joint_law.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>

namespace Keyblock
{
  namespace
  {
    double
    tangent_of(const double degrees)
    {
      return std::tan(degrees * dealii::numbers::PI / 180.);
    }
  } // namespace



  template <int dim>
  Contact<dim>::Contact(const Scene<dim> &scene,
                        const SplitMesh<dim> &split,
                        const Blocks<dim> &blocks,
                        const Numbering<dim> &numbering,
                        const CellArrays<dim> &cells,
                        Fields<dim> &fields)
    : scene(scene)
    , interface(split.interface)
    , split(split)
    , numbering(numbering)
    , cells(cells)
    , fields(fields)
    , law_of_free_faces(make_friction_law(scene.contact.default_friction_angle))
    , traction(interface.pairs.size())
    , search(split, blocks, scene)
  {
    for (const auto &joint : scene.joints)
      {
        laws.push_back(make_joint_law(*joint));
        has_memory = has_memory || laws.back()->has_memory();
        needs_areas.push_back(joint->cohesion_of_sliding() > 0. ||
                              laws.back()->has_memory());
      }
    state.resize(interface.pairs.size());
    for (unsigned int p = 0; p < interface.pairs.size(); ++p)
      {
        const Joint<dim> &joint = *scene.joints[interface.pairs[p].joint];
        state[p].is_welded      = interface.pairs[p].unwelding_stage > 1;
        state[p].is_intact      = state[p].is_welded || scene.contact.tie_all ||
                             joint.cohesion > 0. || joint.tensile_strength > 0.;
        Vector<dim> n;
        for (int d = 0; d < dim; ++d)
          n[d] = interface.pairs[p].normal[d];
        normal.push_back(n);
      }
    is_removed_block.assign(blocks.blocks.size(), false);
    measure_slots();
    set_up_groups();
    set_up_corners();
    set_up_traction_weights();
  }



  template <int dim>
  void
  Contact<dim>::begin_stage(const unsigned int number)
  {
    measure_slots();
    set_up_corners();
    set_up_traction_weights();
    unweld(number);
  }



  template <int dim>
  void
  Contact<dim>::unweld(const unsigned int number)
  {
    std::vector<unsigned int> pairs;
    for (unsigned int p = 0; p < state.size(); ++p)
      if (state[p].is_welded && interface.pairs[p].unwelding_stage <= number)
        pairs.push_back(p);
    if (pairs.empty())
      return;
    const std::vector<PairState<dim>> all = gather_pair_states();
    for (const unsigned int p : pairs)
      {
        const Joint<dim> &joint = *scene.joints[interface.pairs[p].joint];
        state[p].is_welded      = false;
        state[p].is_intact = scene.contact.tie_all || joint.cohesion > 0. ||
                             joint.tensile_strength > 0.;
        const auto [tension, shear] = beyond_strength(p, all[p]);
        state[p].weld_tension       = tension;
        state[p].weld_shear         = shear;
      }
  }



  template <int dim>
  unsigned int
  Contact<dim>::hold_bent_points(const std::vector<bool> &is_exposed)
  {
    // bends are measured to rounding and to what the mesh's cells make of them
    constexpr double margin = 2.;
    const double kick       = present_kick();
    unsigned int n_held     = 0;
    const auto may_hold     = [&](const unsigned int p) {
      const auto sides = blocks_of_pair(p);
      return !is_exposed[sides[0]] && !is_exposed[sides[1]] &&
             !state[p].is_welded && !state[p].is_removed;
    };
    for (unsigned int g = 0; g < interface.n_groups(); ++g)
      {
        const unsigned int begin = interface.group_pairs_begin[g];
        const unsigned int end   = interface.group_pairs_begin[g + 1];
        // points that meet share what the bend of one of them makes
        double bend = 0., largest = 0.;
        for (unsigned int p = begin; p < end; ++p)
          {
            const Pair<dim> &pair = interface.pairs[p];
            const Tensor<1, dim> direction =
              pair.area_vector / pair.area_vector.norm();
            bend    = std::max(bend, (direction - pair.normal).norm());
            largest = std::max(largest, norm<dim>(state[p].impulse) / kick);
          }
        const double unsure = margin * bend * largest;
        for (unsigned int p = begin; p < end; ++p)
          {
            if (!may_hold(p))
              continue;
            const auto [tension, shear] = beyond_strength(p, state[p]);
            if (std::max(tension, shear) <= 0. || tension > unsure ||
                shear > unsure)
              continue;
            state[p].bend_tension = 1.001 * tension;
            state[p].bend_shear   = 1.001 * shear;
            n_held += is_primary(g);
          }
        // how they share it is not unique, and changes when they are released
        double most_tension = 0., most_shear = 0.;
        for (unsigned int p = begin; p < end; ++p)
          {
            most_tension = std::max(most_tension, state[p].bend_tension);
            most_shear   = std::max(most_shear, state[p].bend_shear);
          }
        for (unsigned int p = begin; p < end; ++p)
          if (may_hold(p))
            {
              state[p].bend_tension = most_tension;
              state[p].bend_shear   = most_shear;
            }
      }
    return sum_over_ranks(n_held);
  }



  template <int dim>
  std::array<double, 2>
  Contact<dim>::beyond_strength(const unsigned int pair,
                                const PairState<dim> &now) const
  {
    const double kick   = present_kick();
    const Excess excess = excess_over_strength<dim>(
      now.impulse,
      normal[pair],
      pair_strength(pair, state[pair].is_intact, kick));
    return {
      {std::max(0., excess.tension) / kick, std::max(0., excess.shear) / kick}};
  }



  template <int dim>
  void
  Contact<dim>::release_bent_points()
  {
    for (PairState<dim> &pair : state)
      {
        pair.weld_shear += pair.bend_shear;
        pair.weld_tension += pair.bend_tension;
        pair.bend_shear = pair.bend_tension = 0.;
      }
  }



  template <int dim>
  bool
  Contact<dim>::is_primary(const unsigned int group) const
  {
    return numbering.is_owned(
      interface.group_vertices[interface.group_begin[group]]);
  }



  template <int dim>
  void
  Contact<dim>::override_friction(const double angle)
  {
    override_tangent = angle < 0. ? -1. : tangent_of(angle);
  }



  template <int dim>
  StrengthEnvelope
  Contact<dim>::envelope_of(const unsigned int joint,
                            const JointPointState &state) const
  {
    StrengthEnvelope strength =
      (joint == none ? law_of_free_faces : laws[joint])->envelope(state);
    if (override_tangent >= 0.)
      strength.static_tangent = strength.kinetic_tangent = override_tangent;
    return strength;
  }



  template <int dim>
  PointStrength
  Contact<dim>::pair_strength(const unsigned int pair,
                              const bool is_intact,
                              const double kick) const
  {
    const Pair<dim> &p = interface.pairs[pair];
    double share       = reduction.share;
    if (share != 1.)
      {
        const auto sides = blocks_of_pair(pair);
        share            = reduction.share_between(sides[0], sides[1], p.joint);
      }
    JointPointState point{is_intact, state[pair].has_opened, {}, 0.};
    if (has_memory)
      {
        point.history  = state[pair].history;
        point.pressure = pressure_of(state[pair].impulse, normal[pair], p.area);
      }
    PointStrength strength =
      envelope_of(p.joint, point).of_point(share, p.area, kick);
    strength.cohesion +=
      (state[pair].bend_shear + weld_share * state[pair].weld_shear) * kick;
    strength.tension +=
      (state[pair].bend_tension + weld_share * state[pair].weld_tension) * kick;
    if (scene.contact.tie_all || state[pair].is_welded || is_tied)
      strength.cohesion = strength.tension = 1e100;
    return strength;
  }



  template <int dim>
  void
  Contact<dim>::set_up_groups()
  {
    for (auto *values : {&slot_velocity,
                         &slot_old_velocity,
                         &slot_displacement,
                         &slot_position,
                         &slot_impulse})
      values->assign(dim * search.n_slots(), 0.);
    slot_nodes = {slot_velocity.data(),
                  slot_inverse_mass.data(),
                  &slot_projection};

    group_of_pair.resize(interface.pairs.size());
    group_of_slot.assign(search.n_slots(), none);
    is_mobile_group.assign(interface.n_groups(), false);
    is_mobile_slot.assign(search.n_slots(), false);
    for (unsigned int g = 0; g < interface.n_groups(); ++g)
      {
        const unsigned int begin = interface.group_pairs_begin[g];
        const unsigned int end   = interface.group_pairs_begin[g + 1];
        CornerGroup corner;
        corner.group = g;
        for (unsigned int i = interface.group_begin[g];
             i < interface.group_begin[g + 1];
             ++i)
          {
            const unsigned int slot =
              search.slot_of_vertex[interface.group_vertices[i]];
            group_of_slot[slot] = g;
            corner.has_supports = corner.has_supports || slot_projection[slot];
          }
        for (unsigned int p = begin; p < end; ++p)
          group_of_pair[p] = g;
        if (end - begin == 1 && !corner.has_supports)
          {
            const unsigned int minus =
              numbering.local_node(interface.pairs[begin].minus);
            const unsigned int plus =
              numbering.local_node(interface.pairs[begin].plus);
            if (minus != none && plus != none)
              single_pairs.push_back({begin, minus, plus});
          }
        else
          {
            corners.push_back(corner);
            for (unsigned int p = begin; p < end; ++p)
              corner_pairs.push_back(p);
          }
      }
    list_corner_slots();
    rebuild_active_slots();
  }



  template <int dim>
  void
  Contact<dim>::list_corner_slots()
  {
    for (CornerGroup &corner : corners)
      {
        corner.slots.clear();
        for (unsigned int i = interface.group_begin[corner.group];
             i < interface.group_begin[corner.group + 1];
             ++i)
          {
            const unsigned int slot =
              search.slot_of_vertex[interface.group_vertices[i]];
            if (!is_removed_block[search.block_of_slot[slot]])
              corner.slots.push_back(slot);
          }
      }
  }



  template <int dim>
  void
  Contact<dim>::set_up_corners()
  {
    for (CornerGroup &corner : corners)
      set_up_corner(corner);
  }



  template <int dim>
  std::array<unsigned int, 2>
  Contact<dim>::blocks_of_pair(const unsigned int pair) const
  {
    return {
      {search.block_of_slot[search.slot_of_vertex[interface.pairs[pair].minus]],
       search
         .block_of_slot[search.slot_of_vertex[interface.pairs[pair].plus]]}};
  }



  template <int dim>
  void
  Contact<dim>::remove_block(const unsigned int block)
  {
    is_removed_block[block] = true;
    const double kick       = present_kick();
    for (unsigned int p = 0; p < state.size(); ++p)
      {
        const auto sides = blocks_of_pair(p);
        if (state[p].is_removed || (sides[0] != block && sides[1] != block))
          continue;
        const unsigned int minus =
          numbering.local_node(interface.pairs[p].minus);
        const unsigned int plus = numbering.local_node(interface.pairs[p].plus);
        for (int d = 0; d < dim && !state[p].is_converted; ++d)
          {
            if (plus != none)
              fields.contact_force[dim * plus + d] -=
                state[p].impulse[d] / kick;
            if (minus != none)
              fields.contact_force[dim * minus + d] +=
                state[p].impulse[d] / kick;
          }
        for (const unsigned int node : {minus, plus})
          if (node != none)
            fields.is_in_cluster[node] = false;
        state[p].is_removed = true;
        state[p].impulse    = Vector<dim>{};
        state[p].status     = ContactStatus::open;
      }
    for (const SurfaceContact<dim> &contact : contacts)
      if (contact.master_block == block ||
          search.block_of_slot[contact.slave] == block)
        for (int k = 0; k < contact.point.n_nodes; ++k)
          if (node_of_slot[contact.point.node[k]] != none)
            for (int d = 0; d < dim; ++d)
              fields
                .contact_force[dim * node_of_slot[contact.point.node[k]] + d] -=
                contact.point.weight[k] * contact.point.impulse[d] / kick;
    contacts.clear();
    list_corner_slots();
    is_search_due = true;
  }



  template <int dim>
  ContactPoint<dim>
  Contact<dim>::pair_as_point(const unsigned int pair, const double kick) const
  {
    const Pair<dim> &p = interface.pairs[pair];
    ContactPoint<dim> point;
    point.n_nodes   = 2;
    point.node[0]   = search.slot_of_vertex[p.plus];
    point.node[1]   = search.slot_of_vertex[p.minus];
    point.weight[0] = 1.;
    point.weight[1] = -1.;
    point.normal    = normal[pair];
    for (int d = 0; d < dim; ++d)
      point.gap +=
        point.normal[d] * (slot_displacement[dim * point.node[0] + d] -
                           slot_displacement[dim * point.node[1] + d]);
    point.is_intact = state[pair].is_intact;
    point.strength  = pair_strength(pair, point.is_intact, kick);
    point.status    = state[pair].status;
    if (last_kick > 0.)
      point.impulse =
        add<dim>(Vector<dim>{}, kick / last_kick, state[pair].impulse);
    if (state[pair].status == ContactStatus::sticking &&
        !is_published_variant())
      point.gap = 0.;
    return point;
  }



  template <int dim>
  void
  Contact<dim>::solve_points(std::vector<ContactPoint<dim>> &points,
                             const std::vector<PointStrength> &broken,
                             const ContactNodes<dim> &nodes,
                             const double step)
  {
    const SolverSettings settings{step,
                                  scene.contact.tolerance,
                                  scene.contact.maximum_iterations};
    if (is_published_variant())
      {
        solve_as_published<dim>(points, broken, nodes, settings);
        return;
      }
    const SolverReport report =
      solve_group<dim>(points, broken, nodes, settings);
    n_capped += report.is_capped && !is_tied;
    ++n_solved;
    n_iterations = std::max(n_iterations, report.n_iterations);
  }



  template <int dim>
  void
  Contact<dim>::book_work(const ContactPoint<dim> &point,
                          const double *old_velocity,
                          const double *new_velocity)
  {
    const Vector<dim> mean =
      add<dim>(relative_velocity<dim>(point, old_velocity),
               1.,
               relative_velocity<dim>(point, new_velocity));
    const double r_n     = dot<dim>(point.impulse, point.normal);
    const double all     = -0.5 * dot<dim>(point.impulse, mean);
    const double closure = -0.5 * r_n * dot<dim>(point.normal, mean);
    work.closure += closure;
    work.friction += all - closure;
  }



  template <int dim>
  void
  Contact<dim>::solve(const ContactStep &step)
  {
    const double previous_kick = last_kick;
    weld_share                 = step.weld_share;
    n_iterations               = 0;
    if (!corner_pairs.empty())
      estimate_tractions();
    if (step.is_large && n_steps % 20 == 0)
      refresh_normals();
    update_mobility(step);
    gather_slots(true);
    last_kick = previous_kick > 0. ? previous_kick : step.kick;
    solve_single_pairs(step);
    for (CornerGroup &corner : corners)
      if (!is_mobile_group[corner.group] && !corner.slots.empty() &&
          node_of_slot[corner.slots[0]] != none)
        solve_corner(corner, step);
    if (!mobile_slots.empty())
      solve_mobile(step);
    last_kick = step.kick;
    note_openings();
    scatter_slots();
    if (has_memory)
      advance_histories(step);
    if (step.is_large && !mobile_slots.empty())
      correct_penetration();
    ++n_steps;
  }



  template class Contact<2>;
  template class Contact<3>;
} // namespace Keyblock
