// SPDX-License-Identifier: LGPL-2.1-or-later
// What the laws of joints remember of contact points, from step to step: in the
// state of a pair, and after its conversion by surface node and joint, so that
// it lasts whatever the node meets.
#include <keyblock/contact/contact.h>
#include <keyblock/law/joint_law.h>

#include <algorithm>

namespace Keyblock
{
  namespace
  {
    /** Where that of a node is, or is to be inserted. */
    template <typename Histories>
    auto
    place_in(Histories &histories,
             const unsigned int slot,
             const unsigned int joint)
    {
      return std::lower_bound(histories.begin(),
                              histories.end(),
                              std::make_pair(slot, joint),
                              [](const NodeHistory &node, const auto &key) {
                                return std::make_pair(node.slot, node.joint) <
                                       key;
                              });
    }
  } // namespace



  template <int dim>
  const JointHistory *
  Contact<dim>::find_history(const unsigned int slot,
                             const unsigned int joint) const
  {
    const auto place = place_in(node_histories, slot, joint);
    return place != node_histories.end() && place->slot == slot &&
               place->joint == joint
             ? &place->history
             : nullptr;
  }



  template <int dim>
  JointHistory &
  Contact<dim>::history_at(const unsigned int slot, const unsigned int joint)
  {
    const auto place = place_in(node_histories, slot, joint);
    if (place != node_histories.end() && place->slot == slot &&
        place->joint == joint)
      return place->history;
    return node_histories.insert(place, {slot, joint, {}})->history;
  }



  template <int dim>
  double
  Contact<dim>::pressure_of(const Vector<dim> &impulse,
                            const Vector<dim> &normal,
                            const double area) const
  {
    return area > 0. ? dot<dim>(impulse, normal) / (area * present_kick()) : 0.;
  }



  template <int dim>
  double
  Contact<dim>::area_of(const SurfaceContact<dim> &contact) const
  {
    const auto area =
      covered_area.find({{contact.slave, contact.joint, contact.master_block}});
    return area == covered_area.end() ? 0. : area->second;
  }



  template <int dim>
  void
  Contact<dim>::pass_on_history(const unsigned int pair)
  {
    const Pair<dim> &p = interface.pairs[pair];
    for (const unsigned int vertex : {p.minus, p.plus})
      {
        JointHistory &history =
          history_at(search.slot_of_vertex[vertex], p.joint);
        if (history.slip < state[pair].history.slip)
          history = state[pair].history;
      }
  }



  template <int dim>
  bool
  Contact<dim>::relative_velocity_of(const unsigned int pair,
                                     Vector<dim> &velocity) const
  {
    const Pair<dim> &p   = interface.pairs[pair];
    const bool is_mobile = is_mobile_group[group_of_pair[pair]];
    const auto index_of  = [&](const unsigned int vertex) {
      return is_mobile ? search.slot_of_vertex[vertex]
                        : numbering.local_node(vertex);
    };
    const unsigned int plus = index_of(p.plus), minus = index_of(p.minus);
    if (plus == none || minus == none)
      return false;
    const double *v = is_mobile ? slot_velocity.data() : fields.velocity.data();
    for (int d = 0; d < dim; ++d)
      velocity[d] = v[dim * plus + d] - v[dim * minus + d];
    return true;
  }



  template <int dim>
  void
  Contact<dim>::advance_histories(const ContactStep &step)
  {
    const auto slip_of = [&](const Vector<dim> &velocity,
                             const Vector<dim> &n) {
      return step.step *
             norm<dim>(add<dim>(velocity, -dot<dim>(velocity, n), n));
    };
    for (unsigned int p = 0; p < state.size(); ++p)
      {
        PairState<dim> &pair = state[p];
        const JointLaw &law  = *laws[interface.pairs[p].joint];
        Vector<dim> velocity;
        if (law.has_memory() && !pair.is_converted && !pair.is_removed &&
            pair.status == ContactStatus::sliding &&
            relative_velocity_of(p, velocity))
          pair.history = law.advance(pair.history,
                                     slip_of(velocity, normal[p]),
                                     pressure_of(pair.impulse,
                                                 normal[p],
                                                 interface.pairs[p].area));
      }
    for (const SurfaceContact<dim> &contact : contacts)
      {
        const ContactPoint<dim> &point = contact.point;
        if (contact.joint == none || contact.is_ridge ||
            !laws[contact.joint]->has_memory() ||
            point.status != ContactStatus::sliding)
          continue;
        JointHistory &history = history_at(contact.slave, contact.joint);
        history               = laws[contact.joint]->advance(
          history,
          slip_of(relative_velocity<dim>(point, slot_velocity.data()),
                  point.normal),
          pressure_of(point.impulse, point.normal, area_of(contact)));
      }
  }

  template const JointHistory *
  Contact<2>::find_history(const unsigned int, const unsigned int) const;
  template const JointHistory *
  Contact<3>::find_history(const unsigned int, const unsigned int) const;
  template double Contact<2>::pressure_of(const Vector<2> &,
                                          const Vector<2> &,
                                          const double) const;
  template double Contact<3>::pressure_of(const Vector<3> &,
                                          const Vector<3> &,
                                          const double) const;
  template double Contact<2>::area_of(const SurfaceContact<2> &) const;
  template double Contact<3>::area_of(const SurfaceContact<3> &) const;
  template void Contact<2>::pass_on_history(const unsigned int);
  template void Contact<3>::pass_on_history(const unsigned int);
  template void Contact<2>::advance_histories(const ContactStep &);
  template void Contact<3>::advance_histories(const ContactStep &);
} // namespace Keyblock
