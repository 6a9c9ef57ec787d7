// SPDX-License-Identifier: LGPL-2.1-or-later
#include <keyblock/base/angle.h>
#include <keyblock/contact/strength.h>
#include <keyblock/law/friction.h>
#include <keyblock/law/joint_law.h>

#include <cmath>

namespace Keyblock
{
  namespace
  {
    /** Impulse that no step reaches [N s]. */
    constexpr double unbreakable = 1e100;
  } // namespace



  template <int dim>
  ContactStrength<dim>::ContactStrength(const PairTopology<dim> &topology,
                                        const ContactMemory<dim> &memory)
    : topology(topology)
    , memory(memory)
    , scene(topology.scene)
    , law_of_free_faces(make_friction_law(scene.contact.default_friction_angle))
  {
    const JointPointState slid{false, false, {}, 0.};
    for (const auto &joint : scene.joints)
      {
        laws.push_back(make_joint_law(*joint));
        has_memory     = has_memory || laws.back()->has_memory();
        needs_pressure = needs_pressure || laws.back()->depends_on_pressure();
        needs_areas.push_back(laws.back()->envelope(slid).cohesion > 0. ||
                              laws.back()->depends_on_pressure());
      }
  }



  template <int dim>
  bool
  ContactStrength<dim>::is_bonded(const unsigned int joint) const
  {
    return scene.contact.tie_all || scene.joints[joint]->cohesion > 0. ||
           scene.joints[joint]->tensile_strength > 0.;
  }


  template <int dim>
  void
  ContactStrength<dim>::override_friction(const double angle)
  {
    override_tangent = angle < 0. ? -1. : tangent_of(angle);
  }



  template <int dim>
  StrengthEnvelope
  ContactStrength<dim>::envelope_of(const unsigned int joint,
                                    const JointPointState &point) const
  {
    StrengthEnvelope strength =
      (joint == none ? law_of_free_faces : laws[joint])->envelope(point);
    if (override_tangent >= 0.)
      strength.static_tangent = strength.kinetic_tangent = override_tangent;
    return strength;
  }



  template <int dim>
  PointStrength
  ContactStrength<dim>::of_pair(const unsigned int pair,
                                const bool is_intact,
                                const double kick) const
  {
    const Pair<dim> &p = topology.interface.pairs[pair];
    double share       = reduction.share;
    if (share != 1.)
      {
        const auto sides = topology.blocks_of_pair(pair);
        share            = reduction.share_between(sides[0], sides[1], p.joint);
      }
    JointPointState point{is_intact, memory.state[pair].has_opened, {}, 0.};
    if (has_memory)
      point.history = memory.pair_histories[pair];
    if (needs_pressure)
      point.pressure = pressure_of_pair(pair);
    PointStrength strength =
      envelope_of(p.joint, point).of_point(share, p.area, kick);
    strength.cohesion += (memory.state[pair].bend_shear +
                          weld_share * memory.state[pair].weld_shear) *
                         kick;
    strength.tension += (memory.state[pair].bend_tension +
                         weld_share * memory.state[pair].weld_tension) *
                        kick;
    if (scene.contact.tie_all || memory.state[pair].is_welded || is_tied)
      strength.cohesion = strength.tension = unbreakable;
    return strength;
  }



  template <int dim>
  PointStrength
  ContactStrength<dim>::of_surface(const SurfaceContact<dim> &contact,
                                   const double area,
                                   const JointHistory &history,
                                   const double pressure,
                                   const double kick) const
  {
    const double share =
      reduction.share_between(topology.surface.block_of_node[contact.slave],
                              contact.master_block,
                              contact.joint);
    const bool has_area = !std::isnan(area);
    // surfaces lie on each other where pairs have slid
    JointPointState point{false, false, {}, 0.};
    point.history                   = history;
    point.pressure                  = pressure;
    const StrengthEnvelope envelope = envelope_of(contact.joint, point);
    if (has_area && !contact.is_ridge)
      return envelope.of_point(share, area, kick);
    PointStrength strength = envelope.of_point(share, 0., kick);
    strength.cohesion      = contact.point.strength.cohesion;
    return strength;
  }


  template <int dim>
  std::array<double, 2>
  ContactStrength<dim>::beyond(const unsigned int pair,
                               const PairState<dim> &now) const
  {
    const double kick   = memory.present_kick();
    const Excess excess = excess_over_strength<dim>(
      now.impulse,
      memory.normal[pair],
      of_pair(pair, memory.state[pair].is_intact, kick));
    return {
      {std::max(0., excess.tension) / kick, std::max(0., excess.shear) / kick}};
  }



  template <int dim>
  double
  ContactStrength<dim>::pressure_of_pair(const unsigned int pair) const
  {
    const double area = topology.interface.pairs[pair].area;
    return area > 0.
             ? dot<dim>(memory.state[pair].impulse, memory.normal[pair]) /
                 (area * memory.present_kick())
             : 0.;
  }

  template class ContactStrength<2>;
  template class ContactStrength<3>;
} // namespace Keyblock
